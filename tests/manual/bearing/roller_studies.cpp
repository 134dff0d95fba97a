#include "tests/manual/bearing/roller_studies.h"
#include "core/base/parameter.h"
#include "fem/bearing/ring_flexibility.h"
#include "fem/bearing/roller_contact.h"
#include "fem/bearing/roller_slices.h"
#include "meshes/bearing/bearing_rings.h"
#include "reduce/bearing/ring_flexibility.h"
#include "reduce/bearing/ring_sections.h"
#include "reduce/bearing/roller_law.h"
#include "tests/manual/bearing/roller_models.h"
#include "tests/manual/bearing/roller_sections.h"
#include "tests/manual/check/units.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace mill::verify {
namespace {
using Eigen::MatrixXd;
using Eigen::VectorXd;

// One condensation for the three cases.
const fem::CondensedRoller &roller()
{
  static const fem::CondensedRoller made = condensed(fine_demo_roller());
  return made;
}

}  // namespace

std::vector<Check> fe_roller_3d()
{
  const double Q = 10 * kN, q = Q / roller_length;
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
      reported("approach, compared with closed-form elasticity", "um", state.approach / um, 16.08),
      reported("tangent, compared with ISO", "N/mm", state.tangent(0, 0) / N_per_mm, 5.82e5),
      reported("line load at mid-roller, compared with the mean", "N/mm", state.inner.line_load[middle] / N_per_mm,
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
    const std::function<double(double)> drop = crowned ? demo_roller_drop : std::function<double(double)>();
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
        const double arm = 0.5 * roller_length * fe.load;
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
double tangent_error(fem::RollerContact &contact, const fem::RollerContactState &state)
{
  const Eigen::Vector2d unit(1, 1 / (0.5 * roller_length));  // both motions move the end of the roller alike
  double worst = 0;
  for (const int motion : {0, 1}) {
    double error = 1;
    for (double step = 1e-4 * state.approach; step > 1e-9 * state.approach; step /= 10) {
      const Eigen::Vector2d by = Eigen::Vector2d::Unit(motion).cwiseProduct(unit) * step;
      const auto high          = contact.solve(state.approach + by[0], state.tilt + by[1]),
                 low           = contact.solve(state.approach - by[0], state.tilt - by[1]);
      const auto difference    = [&](const fem::RollerContactState &a, const fem::RollerContactState &b) {
        return Eigen::Vector2d(a.load - b.load, (a.moment - b.moment) * unit[1]);
      };
      const Eigen::Vector2d exact =
          2 * state.tangent.col(motion).cwiseProduct(Eigen::Vector2d(1, unit[1])) * by[motion];
      const double corner = (difference(high, state) - difference(state, low)).norm() / exact.norm();
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
  const VectorXd station_length = fem::axial_weights(roller().grid.z, 0.5 * roller_length, roller().grid.degree);
  double tangent = 0, asymmetry = 0, mirror = 0, balance = 0, residual = 0;
  for (const bool crowned : {false, true}) {
    fem::RollerContact contact(roller(), crowned ? demo_roller_drop : std::function<double(double)>());
    for (const double load : {2 * kN, 20 * kN})
      for (const double tilt : {0., 0.4 * mrad, 1.5 * mrad}) {
        const auto state = contact.solve(contact.solve_load(load).approach, tilt);
        tangent          = std::max(tangent, tangent_error(contact, state));
        asymmetry        = std::max(asymmetry, std::abs(state.tangent(0, 1) - state.tangent(1, 0)) /
                                                   (state.tangent(0, 0) * roller_length));
        const auto other = contact.solve(state.approach, -tilt);
        mirror           = std::max(mirror, std::abs(other.load / state.load - 1) +
                                                std::abs(other.moment + state.moment) / (state.load * roller_length));
        for (const fem::RollerSide *side : {&state.inner, &state.outer}) {
          const VectorXd force = side->line_load.cwiseProduct(station_length);
          const double moment  = force.dot(roller().grid.z);
          balance              = std::max({balance, std::abs(force.sum() / state.load - 1),
                                           std::abs(moment - state.moment) / (state.load * roller_length)});
        }
        residual = std::max({residual, state.residual, other.residual});
      }
  }
  fem::RollerContact contact(roller(), demo_roller_drop);
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

// Published per-roller stiffnesses of the demo bearing, and what links them with the published total.
std::vector<Check> published_rollers()
{
  const double rows[] = {6.78395e5, 6.37958e5, 6.23286e5, 6.47685e5}, total = 2.01e7, Z = 39,
               alpha = 19.66 * M_PI / 180;
  double sum         = 0;
  for (const double row : rows)
    sum += row;
  std::vector<Check> checks{reported("published per-roller values times Z/5", "N/mm", sum * Z / 5, total),
                            reported("the same times Z cos^2(alpha)/4.0847", "N/mm",
                                     sum * Z * std::pow(std::cos(alpha), 2) / 4.0847, total)};
  const auto law       = fem::fe_roller_law(roller(), 41, demo_roller_drop);
  const double loads[] = {10 * kN, 20 * kN, 50 * kN};
  for (const double Q : loads) {
    const double approach = bearing::roller_approach(law, Q);
    const double tangent  = bearing::roller_load(law, approach, 0).stiffness;
    checks.push_back(
        reported(fmt::format("one roller's tangent at {:.0f} kN, compared with the mean of the rows", Q / kN),
                 "N/mm", tangent / N_per_mm, sum / 4));
    checks.push_back(
        reported(fmt::format("one roller's secant at {:.0f} kN, compared with the mean of the rows", Q / kN),
                 "N/mm", Q / approach / N_per_mm, sum / 4));
  }
  return checks;
}

// The superposition of the assembled bearing on one roller: a cup of 24 mm held on its outside, once meshed as
// such behind the roller, once as the law with 12 mm and how far the ring deflects beyond.
std::vector<Check> roller_on_ring()
{
  RollerSetup thin             = demo_roller();
  thin.elements_per_half_width = 0.8;
  thin.land                    = 5 * mm;
  RollerSetup thick            = thin;
  thick.outer_depth            = 24 * mm;
  const auto law_roller = condensed(thin), whole_roller = condensed(thick);
  fem::RollerContact on_12(law_roller), on_24(whole_roller);

  RollerBearing ring;
  ring.name             = "ring";
  ring.type             = BearingType::four_row_cylindrical;
  ring.rows             = 1;
  ring.rollers_per_row  = 39;
  ring.bore             = 2 * (thin.inner_radius - thick.outer_depth);
  ring.outside_diameter = 2 * (thin.outer_radius + thick.outer_depth);
  ring.width            = roller_length + 11.2 * mm;  // room for the land
  ring.pitch_diameter   = thin.inner_radius + thin.outer_radius;
  ring.roller_length    = roller_length;
  ring.roller_diameter  = roller_diameter;
  ring.cup_angle        = 0;
  ring.chock            = ChockForm::rigid;
  const auto sections   = bearing::ring_sections(ring, {12 * mm, 12 * mm, 5 * mm});
  const auto meshes     = meshes::mesh_rings(sections, {}, std::filesystem::temp_directory_path().string(),
                                             fmt::format("millstand-verify-{}-ring", ::getpid()));
  const auto rings      = fem::ring_flexibility(sections, meshes, nullptr).flexibility;
  meshes::remove_meshes(meshes);
  MatrixXd beyond = MatrixXd::Zero(rings.modes, rings.modes);
  for (const MatrixXd &harmonic : rings.outer)
    beyond += harmonic;  // one roller, at its own place
  const auto law      = fem::fe_roller_law(law_roller, 41);
  const MatrixXd even = bearing::line_modes(law.position, roller_length, rings.modes);

  std::vector<Check> checks;
  for (const double Q : {10 * kN, 50 * kN}) {
    const double alone = on_12.solve_load(Q).approach, whole = on_24.solve_load(Q).approach;
    const VectorXd q =
        bearing::slice_loads(law, VectorXd::Constant(law.position.size(), bearing::roller_approach(law, Q)),
                             MatrixXd::Zero(law.position.size(), 0))
            .load;
    const VectorXd N   = even.transpose() * q;
    const double added = N.dot(beyond * N) / Q;
    checks.push_back(relative(fmt::format("approach at {:.0f} kN, law and ring", Q / kN), "um",
                              (alone + added) / um, whole / um, 0.003));
    checks.push_back(relative(fmt::format("part of the ring at {:.0f} kN", Q / kN), "um", added / um,
                              (whole - alone) / um, 0.05));
  }
  return checks;
}
}  // namespace mill::verify
