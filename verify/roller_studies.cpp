#include "verify/roller_studies.h"
#include "bearing/roller_law.h"
#include "fem/roller_contact.h"
#include "fem/roller_slices.h"
#include "meshes/roller.h"
#include "verify/roller_sections.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace mill::verify {
namespace {
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double mm = 1e-3, um = 1e-6, MPa = 1e6, kN = 1e3, N_per_mm = 1e3, mrad = 1e-3;
constexpr double length = 33.4 * mm, diameter = 21.5 * mm;

RollerSetup demo_roller()
{
  RollerSetup s;
  s.diameter     = diameter;
  s.length       = length;
  s.inner_radius = 144.8 * mm;
  s.outer_radius = 166.3 * mm;
  s.inner_depth = s.outer_depth = 12 * mm;
  s.material                    = {206e9, 0.3, 7850};
  s.largest_load                = 60 * kN;
  s.finest_load                 = 4 * kN;
  return s;
}

fem::CondensedRoller condensed(const RollerSetup &setup)
{
  const auto meshes = meshes::mesh_roller(setup, std::filesystem::temp_directory_path().string(),
                                          fmt::format("millstand-verify-{}", ::getpid()));
  auto roller       = fem::condense_roller(setup, meshes);
  meshes::remove_meshes(meshes);
  return roller;
}

// One condensation for the three cases.
const fem::CondensedRoller &roller()
{
  static const fem::CondensedRoller made = [] {
    RollerSetup s             = demo_roller();
    s.elements_per_half_width = 1.6;
    s.largest_element         = 2.8 * mm;
    s.end_element             = 0.3 * mm;
    return condensed(s);
  }();
  return made;
}

double iso_drop(const double x)
{
  return 0.00045 * diameter * -std::log(1 - std::pow(2 * x / length, 2));
}

Check within(const std::string &quantity, const double result, const double low, const double high)
{
  return {quantity, "-", result, 0.5 * (low + high), 0.5 * (high - low), Judged::absolute};
}
}  // namespace

std::vector<Check> fe_roller_3d()
{
  const double Q = 10 * kN, q = Q / length;
  fem::RollerContact contact(roller());
  const auto state    = contact.solve_load(Q);
  const double secant = state.load / state.approach, iso = std::pow(Q / 813048, 0.9) * mm;
  const double plane = plane_approach(144.8 * mm, q) + plane_approach(-166.3 * mm, q);
  const auto middle  = state.inner.line_load.size() / 2;
  return {
      within("secant FE / ISO", secant * iso / Q, 1.00, 1.25),
      within("secant FE / ISO, narrower", secant * iso / Q, 1.05, 1.20),
      within("secant / Palmgren's 5.415e5 N/mm", secant / N_per_mm / 5.415e5, 0.95, 1.25),
      relative("approach / that of the plane sections", "-", state.approach / plane, 1, 0.01),
      reported("approach, beside closed-form elasticity", "um", state.approach / um, 16.08),
      reported("tangent, beside ISO", "N/mm", state.tangent(0, 0) / N_per_mm, 5.82e5),
      reported("line load at mid-roller, beside the mean", "N/mm", state.inner.line_load[middle] / N_per_mm,
               q / N_per_mm),
      reported("largest line load, at the end of the roller", "N/mm", state.inner.line_load.maxCoeff() / N_per_mm,
               q / N_per_mm),
  };
}

std::vector<Check> roller_slice_law()
{
  const int slices = 41;
  std::vector<Check> checks;
  for (const bool crowned : {false, true}) {
    const std::function<double(double)> drop = crowned ? iso_drop : std::function<double(double)>();
    fem::RollerContact contact(roller(), drop);
    const bearing::RollerLaw law = fem::fe_roller_law(roller(), slices, drop);
    MatrixXd directions(slices, 2);
    directions << VectorXd::Ones(slices), law.position;
    // Below 5 kN the half width is about one element and less: there it is the mesh that is seen.
    struct Worst {
      double load = 0, moment = 0;
    } resolved, coarse;
    for (const double load : {1 * kN, 2 * kN, 5 * kN, 10 * kN, 20 * kN, 50 * kN, 100 * kN}) {
      const double approach = contact.solve_load(load).approach;
      Worst &worst          = load < 5 * kN ? coarse : resolved;
      for (const double tilt : {0., 0.25 * mrad, 0.5 * mrad, 1 * mrad, 2 * mrad}) {
        const auto fe    = contact.solve(approach, tilt);
        const VectorXd d = approach + tilt * law.position.array();
        const VectorXd q = bearing::slice_loads(law, d, directions).load;
        const double arm = 0.5 * length * fe.load;
        worst.load       = std::max(worst.load, std::abs(q.sum() / fe.load - 1));
        worst.moment     = std::max(worst.moment, std::abs(q.dot(law.position) - fe.moment) / arm);
      }
    }
    const std::string name = crowned ? ", ISO crown" : ", no crown";
    checks.push_back(
        {"largest deviation of the load, 5..100 kN" + name, "%", 100 * resolved.load, 0.3, 0, Judged::at_most});
    checks.push_back({"largest deviation of the moment / (Q L/2), 5..100 kN" + name, "%", 100 * resolved.moment,
                      0.3, 0, Judged::at_most});
    checks.push_back(
        {"largest deviation of the load, 1 and 2 kN" + name, "%", 100 * coarse.load, 1, 0, Judged::at_most});
  }
  return checks;
}

namespace {
// Largest relative difference of the exact tangent from a central difference.  The curves have a corner where a
// node joins or leaves: the widest step whose two sides agree has none.
double tangent_error(fem::RollerContact &contact, const fem::RollerContactState &at)
{
  const Eigen::Vector2d unit(1, 1 / (0.5 * length));  // both motions move the end of the roller alike
  double worst = 0;
  for (const int motion : {0, 1}) {
    double error = 1;
    for (double step = 1e-4 * at.approach; step > 1e-9 * at.approach; step /= 10) {
      const Eigen::Vector2d by = Eigen::Vector2d::Unit(motion).cwiseProduct(unit) * step;
      const auto high          = contact.solve(at.approach + by[0], at.tilt + by[1]),
                 low           = contact.solve(at.approach - by[0], at.tilt - by[1]);
      const auto difference    = [&](const fem::RollerContactState &a, const fem::RollerContactState &b) {
        return Eigen::Vector2d(a.load - b.load, (a.moment - b.moment) * unit[1]);
      };
      const Eigen::Vector2d exact =
          2 * at.tangent.col(motion).cwiseProduct(Eigen::Vector2d(1, unit[1])) * by[motion];
      const double corner = (difference(high, at) - difference(at, low)).norm() / exact.norm();
      error               = (difference(high, low) - exact).norm() / exact.norm();
      if (corner < 1e-7)
        break;
    }
    worst = std::max(worst, error);
  }
  return worst;
}
}  // namespace

std::vector<Check> roller_tilt()
{
  const VectorXd station_length = fem::axial_weights(roller().grid.z, 0.5 * length, roller().grid.degree);
  double tangent = 0, asymmetry = 0, mirror = 0, balance = 0, residual = 0;
  for (const bool crowned : {false, true}) {
    fem::RollerContact contact(roller(), crowned ? iso_drop : std::function<double(double)>());
    for (const double load : {2 * kN, 20 * kN})
      for (const double tilt : {0., 0.4 * mrad, 1.5 * mrad}) {
        const auto at = contact.solve(contact.solve_load(load).approach, tilt);
        tangent       = std::max(tangent, tangent_error(contact, at));
        asymmetry =
            std::max(asymmetry, std::abs(at.tangent(0, 1) - at.tangent(1, 0)) / (at.tangent(0, 0) * length));
        const auto other = contact.solve(at.approach, -tilt);
        mirror           = std::max(mirror, std::abs(other.load / at.load - 1) +
                                                std::abs(other.moment + at.moment) / (at.load * length));
        for (const fem::RollerSide *side : {&at.inner, &at.outer}) {
          const VectorXd force = side->line_load.cwiseProduct(station_length);
          const double moment  = force.dot(roller().grid.z);
          balance              = std::max(
                           {balance, std::abs(force.sum() / at.load - 1), std::abs(moment - at.moment) / (at.load * length)});
        }
        residual = std::max({residual, at.residual, other.residual});
      }
  }
  fem::RollerContact contact(roller(), iso_drop);
  const auto tilted   = contact.solve(contact.solve_load(20 * kN).approach, 1 * mrad);
  const auto identity = [](const std::string &quantity, const double worst, const double limit) {
    return Check{quantity, "-", worst, limit, 0, Judged::at_most};
  };
  return {
      identity("tangent against central difference", tangent, 1e-6),
      identity("asymmetry of the tangent", asymmetry, 1e-9),
      identity("mirrored tilt: the same load, the opposite moment", mirror, 1e-9),
      identity("load and moment of each raceway against the roller's", balance, 1e-9),
      identity("complementarity residual", residual, 1e-12),
      reported("roller's own tilt / tilt of the raceways, 20 kN, ISO crown", "-", tilted.roller_tilt / tilted.tilt,
               0.5),
  };
}
}  // namespace mill::verify
