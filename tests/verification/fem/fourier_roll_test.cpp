#include "core/base/errors.h"
#include "fem/roll/fourier_contact.h"
#include "meshes/bearing/meridian.h"
#include "tests/support/closed_form.h"
#include "tests/support/near.h"
#include "tests/support/roll_pair.h"
#include <filesystem>
#include <optional>
#include <unistd.h>

// The Fourier engine alone, and against the three-dimensional one: work roll 420 and backup roll 1450 x 700 mm,
// half as long as in the manual (engine-agreement), which looks at no crown and no strip as wide as the barrel.
using namespace mill;
using fem::RollSupport;

namespace {
const Material steel{210e9, 0.28, 7700};
const RollGeometry backup{0.725, 0.35, 0.475, 0.95, 0.875, 0}, work{0.210, 0.35, 0.13335, 0.46, 0.65, 0};
constexpr double barrel = 0.7;                  // m
constexpr double F1     = 488108.75;            // N
constexpr double q1     = F1 / barrel;          // N/m
constexpr double inner  = 0.5 * barrel - 0.01;  // m, without the sharp end

double half_width(const double F)
{
  return closed_form::line_contact(F / barrel, 0.420, 1.450, 210e9, 0.28).half_width;
}

fem::FourierRoll condensed(const RollGeometry &geometry, const meshes::MeridianSize &size,
                           const fem::FourierOptions &options, const Eigen::VectorXd &edge = {})
{
  const auto path =
      (std::filesystem::temp_directory_path() / ("millstand-meridian-" + std::to_string(getpid()) + ".msh"))
          .string();
  const MeshFile mesh = meshes::mesh_meridian("roll", geometry, size, path);
  const fem::SectionBody body(mesh, steel, 2, fem::Section::axisymmetric);
  std::filesystem::remove(path);
  return fem::fourier_roll(body, geometry, steel, edge.size() > 0 ? edge : fem::stations_of(body), options);
}

struct Rolls {
  fem::FourierRoll first, second;
  Eigen::VectorXd centre() const
  {
    return fem::station_centres(first.edge);
  }
};

Rolls rolls(const meshes::MeridianSize &size, const fem::FourierOptions &options)
{
  Rolls r{condensed(backup, size, options), {}};
  r.second = condensed(work, size, options, r.first.edge);
  return r;
}

fem::FourierOptions options_at(const double load, const bool both_sides = false)
{
  fem::FourierOptions options;
  options.half_width = half_width(load);
  options.both_sides = both_sides;
  return options;
}

const Rolls &stand_rolls()
{
  static const Rolls made = rolls(meshes::meridian_size(half_width(F1)), options_at(F1, true));
  return made;
}

// A coarse pair for what does not depend on accuracy.
meshes::MeridianSize coarse_size()
{
  auto size          = meshes::meridian_size(half_width(F1));
  size.largest_share = 0.1;
  size.core_share    = 0.4;
  size.radial_growth = 2.5;
  return size;
}

const Rolls &coarse_rolls()
{
  static const Rolls made = rolls(coarse_size(), options_at(F1, true));
  return made;
}

// Both sides of the solid engine.  2.7 F1: load and concentration by the crown must not push the contact to the
// edge of the patch.
const std::pair<MeshedBody, MeshedBody> &solid_rolls()
{
  static const auto made = [] {
    auto size          = meshes::roll_contact_size(half_width(2.7 * F1), 5);
    size.largest_layer = 0.05;
    fem::CondenseOptions both;
    both.both_sides = true;
    return std::pair(meshed_roll("backup", backup, size, steel, both),
                     meshed_roll("work", work, size, steel, both));
  }();
  return made;
}

enum class Held { mirrored, in_stand };

Eigen::VectorXd parabola(const Eigen::VectorXd &z, const double crown)
{
  return 0.5 * crown * (z / (0.5 * barrel)).array().square();
}

fem::FourierPair pair_of(const Rolls &r, const Held held, const double strip, const double crown,
                         const bool whole = false)
{
  Eigen::VectorXd drop = parabola(r.centre(), crown);
  if (whole) {
    Eigen::VectorXd both(2 * drop.size());
    both << drop.reverse(), drop;
    drop = both;
  }
  if (held == Held::mirrored)
    return fem::fourier_pair("upper", r.first, {}, r.second, {}, drop);
  return fem::fourier_pair("upper", r.first, {RollSupport::necks, 0}, r.second, {RollSupport::strip, strip}, drop);
}

// Slope of load over approach between loads so far apart that the half width changes by several nodes of the solid
// engine: free of the steps of one active set.
template <class Pair> double slope(const Pair &pair, const double F)
{
  return F * (1.6 - 1 / 1.6) / (fem::solve_load(pair, 1.6 * F).approach - fem::solve_load(pair, F / 1.6).approach);
}

double interpolated(const Eigen::VectorXd &z, const Eigen::VectorXd &value, const double position)
{
  Eigen::Index i = 0;
  while (i + 2 < z.size() && z[i + 1] < position)
    ++i;
  return value[i] + (position - z[i]) / (z[i + 1] - z[i]) * (value[i + 1] - value[i]);
}
}  // namespace

TEST(MeridianMesh, NamesItsBoundariesAndFillsTheRoll)
{
  const auto path =
      (std::filesystem::temp_directory_path() / ("millstand-meridian-" + std::to_string(getpid()) + "-groups.msh"))
          .string();
  RollGeometry shorter{0.725, 0.7, 0.475, 0.95, 1.225, 0};
  shorter.contact_half_length = 0.6;
  const auto size             = meshes::meridian_size(1e-3);
  const MeshFile mesh         = meshes::mesh_meridian("backup", shorter, size, path);
  const fem::SectionBody body(mesh, steel, 2, fem::Section::axisymmetric);
  const MeshFile fine = meshes::mesh_meridian("backup", shorter, meshes::refined(size), path);
  std::filesystem::remove(path);
  EXPECT_TRUE(near(body.measure(), M_PI * (0.725 * 0.725 * 0.7 + 0.475 * 0.475 * 0.95),
                   within(1e-12, "straight elements, polynomial measure")));
  const auto span = [&](const char *group, const int direction) {
    double low = 1e9, high = -1e9;
    for (const int node : body.group(group)) {
      low  = std::min(low, body.nodes()(node, direction));
      high = std::max(high, body.nodes()(node, direction));
    }
    return Eigen::Vector2d(low, high);
  };
  for (const auto &[group, direction, low, high] : {std::tuple{"contact", 1, 0., 0.6},
                                                    {"barrel", 1, 0.6, 0.7},
                                                    {"neck", 1, 0.7, 1.65},
                                                    {"axis", 1, 0., 1.65},
                                                    {"shoulder", 0, 0.475, 0.725},
                                                    {"end", 0, 0., 0.475},
                                                    {"symmetry.z", 0, 0., 0.725}}) {
    EXPECT_TRUE(
        near(span(group, direction)[0], low, within_absolute(1e-12, "m, nodes of the group end there, rounding")))
        << group;
    EXPECT_TRUE(
        near(span(group, direction)[1], high, within_absolute(1e-12, "m, nodes of the group end there, rounding")))
        << group;
  }
  EXPECT_GT(fine.n_cells, 3 * mesh.n_cells);
  EXPECT_LT(fine.n_cells, 6 * mesh.n_cells);
}

TEST(FourierRoll, LongCylindersMeetTheClosedForm)
{
  // Plane strain: a slice with both faces held.
  const RollGeometry big{0.725, 0.01, 0, 0, 0, 0}, small{0.210, 0.01, 0, 0, 0, 0};
  auto size          = meshes::refined(meshes::meridian_size(half_width(F1)));
  size.end_layer     = 0.005;
  size.largest_share = 0.5;
  size.layer_growth  = 1;
  auto options       = options_at(F1);
  options.slab       = true;
  Rolls r{condensed(big, size, options), {}};
  r.second        = condensed(small, size, options, r.first.edge);
  const auto pair = pair_of(r, Held::mirrored, 0, 0);
  for (const double q : {2e5, 697.29e3, 2e6}) {
    const auto state = fem::solve_load(pair, 0.02 * q);
    const auto exact = closed_form::line_contact(q, 0.420, 1.450, 210e9, 0.28);
    EXPECT_TRUE(near(state.approach, exact.approach,
                     within(5e-4, "the closed form neglects the half width against the radius, 0.1 to 0.9 %")));
    EXPECT_TRUE(near(state.tangent, 0.02 * exact.tangent, within(1e-3, "the same")));
    for (int k = 0; k < pair.z.size(); ++k) {
      EXPECT_TRUE(near(state.line_load[k], q, within(1e-9, "nothing varies along the slice")));
      EXPECT_TRUE(near(state.half_width[k], exact.half_width, within(1e-9, "Hertz")));
    }
  }
}

TEST(FourierRoll, NeitherOrdersNorMeshMatter)
{
  const auto solved = [](const Rolls &r) { return fem::solve_load(pair_of(r, Held::in_stand, 0.5, 0), F1); };
  const auto coarse = solved(coarse_rolls());
  for (const int all : {12, 32}) {
    auto options       = options_at(F1);
    options.all_orders = all;
    options.ratio      = all == 12 ? 1.7 : 1.3;
    const auto other   = solved(rolls(coarse_size(), options));
    EXPECT_TRUE(
        near(other.approach, coarse.approach, within(5e-5, "smooth in the order: cubic in its logarithm")));
    EXPECT_TRUE(near(other.tangent, coarse.tangent, within(5e-5, "the same")));
    EXPECT_TRUE(near(other.line_load, coarse.line_load,
                     within(1e-3, "of the mean; the last stations are shorter than b", q1)));
  }
  const auto fine = solved(stand_rolls());
  auto size       = meshes::meridian_size(half_width(F1));
  size.surface_element *= 1.5;
  size.radial_growth = 2;
  size.layer_growth  = 2.2;
  size.largest_share = 0.045;
  const auto larger  = solved(rolls(size, options_at(F1)));
  EXPECT_TRUE(near(larger.approach, fine.approach, within(1e-3, "elements half as large again")));
  EXPECT_TRUE(near(larger.tangent, fine.tangent, within(1e-3, "the same")));
}

TEST(FourierRollLong, AgreesWithTheThreeDimensionalEngine)
{
  const auto &[A, B] = solid_rolls();
  for (const double crown : {0., 60e-6})
    for (const double strip : {0., 0.5, barrel}) {
      const Held held          = strip > 0 ? Held::in_stand : Held::mirrored;
      const auto fourier       = pair_of(stand_rolls(), held, strip, crown);
      const Eigen::VectorXd dz = parabola(A.roll.grid.z, crown);
      const auto solid = held == Held::mirrored ? fem::make_pair("upper", A.roll, fem::held_by_mirror(A.roll),
                                                                 B.roll, fem::held_by_mirror(B.roll), dz)
                                                : fem::make_pair("upper", A.roll, fem::held_by_necks(A.roll),
                                                                 B.roll, fem::held_by_strip(B.roll, strip), dz);
      const auto one   = fem::solve_load(fourier, F1);
      const auto two   = fem::solve_load(solid, F1);
      const std::string where = "crown " + std::to_string(1e6 * crown) + " um, strip " + std::to_string(strip) +
                                ", discretisation of both engines";
      EXPECT_TRUE(near(one.approach, two.approach, within(2e-3, where)));
      EXPECT_TRUE(near(slope(fourier, F1), slope(solid, F1), within(2e-3, where)));
      if (crown == 0)  // no station, only nodes of the solid engine change status: the exact tangents compare
        EXPECT_TRUE(near(one.tangent, two.tangent, within(1e-2, where + ", one active set of the solid engine")));
      const auto profile = fem::barrel_profile(solid, two);
      // The last 10 mm, nine half widths, belong to the sharp end, where the pressure is singular; where the crown
      // ends the contact, what is compared stops two stations before.
      double end = inner;
      for (int k = 0; k < fourier.z.size(); ++k)
        if (one.line_load[k] == 0) {
          end = std::min(end, fourier.z[std::max(0, k - 3)]);
          break;
        }
      EXPECT_GT(end, 0.25);
      for (double z = 0.02; z <= end; z += 0.01)
        EXPECT_TRUE(near(interpolated(fourier.z, one.line_load, z), interpolated(profile.z, profile.line_load, z),
                         within(1e-2, where + ", of the mean line load", q1)))
            << "z = " << z;
    }
}

TEST(FourierRollLong, AgreesWithTheThreeDimensionalEngineUnderAnOffCentreLoad)
{
  const auto &A = solid_rolls().first.roll, &B = solid_rolls().second.roll;
  const auto a = fem::held_by_necks(A, fem::Extent::whole), b = fem::held_by_strip(B, 0.5, fem::Extent::whole);
  auto solid        = fem::make_pair("upper", A, a, B, b, Eigen::VectorXd::Zero(a.grid.n_z));
  solid.load_offset = 0.025;
  const auto two    = fem::solve_load(solid, F1);
  const auto pair   = pair_of(stand_rolls(), Held::in_stand, 0.5, 0, true);
  const auto one    = fem::solve_load(pair, F1, {0, 0.025});
  // The solid engine measures the approach where the force acts.
  const auto at_force = [&](const double load) {
    const auto point = fem::solve_load(pair, load, {0, 0.025});
    return point.approach + 0.025 * point.tilt;
  };
  EXPECT_TRUE(near(at_force(F1), two.approach, within(3e-3, "meshes of both engines")));
  EXPECT_TRUE(near(one.tilt, two.tilt, within(5e-3, "meshes of both engines")));
  EXPECT_TRUE(near(2e-3 * F1 / (at_force(1.001 * F1) - at_force(0.999 * F1)), two.tangent,
                   within(1e-2, "one active set of the solid engine")));
  const auto profile = fem::barrel_profile(solid, two);
  for (double z = -inner; z <= inner; z += 0.01)
    EXPECT_TRUE(near(interpolated(pair.z, one.line_load, z), interpolated(profile.z, profile.line_load, z),
                     within(1e-2, "of the mean line load; the last 10 mm are the sharp end's", q1)))
        << "z = " << z;
}

TEST(FourierContact, BothSidesWithoutMomentAreTheOneSide)
{
  for (const Held held : {Held::mirrored, Held::in_stand})
    for (const double crown : {0., 100e-6}) {
      const auto one = fem::solve_load(pair_of(coarse_rolls(), held, 0.5, crown), F1);
      const auto two = fem::solve_load(pair_of(coarse_rolls(), held, 0.5, crown, true), F1);
      EXPECT_TRUE(near(two.approach, one.approach, within(1e-10, "the same numbers in another order")));
      EXPECT_TRUE(near(two.tangent, one.tangent, within(1e-10, "the same numbers in another order")));
      EXPECT_TRUE(
          near(two.tilt, 0,
               within_absolute(1e-12 * one.approach / barrel,
                               "without a moment there is no tilt: rounding of the approach over the barrel")));
      const Eigen::VectorXd side = two.line_load.tail(one.line_load.size());
      EXPECT_TRUE(near(side, one.line_load, within(1e-9, "the same numbers", q1)));
    }
}

TEST(FourierContact, TiltAndOffCentreLoadAreTheSameState)
{
  const auto pair  = pair_of(coarse_rolls(), Held::in_stand, 0.5, 0, true);
  const auto moved = fem::solve_load(pair, F1, {0, 0.05});
  EXPECT_GT(moved.tilt, 0);
  EXPECT_GT(moved.line_load.tail(5).minCoeff(), moved.line_load.head(5).maxCoeff());
  EXPECT_TRUE(
      near(moved.line_load.cwiseProduct(pair.length).dot(pair.z), 0.05 * F1, within(1e-12, "equilibrium")));
  const auto tilted = fem::solve_load(pair, F1, {moved.tilt});
  EXPECT_TRUE(near(tilted.moment, 0.05 * F1, within(1e-9, "two sides of one relation")));
  EXPECT_TRUE(near(tilted.approach, moved.approach, within(1e-10, "two sides of one relation")));
}

TEST(FourierContact, TangentIsTheSlopeAndForcesBalance)
{
  for (const Held held : {Held::mirrored, Held::in_stand})
    for (const double crown : {0., -30e-6}) {
      const auto pair   = pair_of(coarse_rolls(), held, 0.6, crown);
      const auto state  = fem::solve_load(pair, F1);
      const double step = 1e-4;
      const auto above  = fem::solve_load(pair, F1 * (1 + step), {}, state.line_load),
                 below  = fem::solve_load(pair, F1 * (1 - step), {}, state.line_load);
      EXPECT_TRUE(
          near(state.tangent, 2 * step * F1 / (above.approach - below.approach),
               within(1e-6, "central difference inside one set: curvature 1e-8, convergence 1e-12 / 1e-4")));
      EXPECT_TRUE(near(2 * state.line_load.dot(pair.length), F1, within(1e-12, "equilibrium")));
      EXPECT_LE(state.residual, 1e-11) << "Newton stops at a change of 1e-12";
      EXPECT_LE(state.iterations, 10);
    }
}

TEST(FourierContact, ACrownLeavesTheEndsFreeUntilTheLoadClosesThem)
{
  const auto pair  = pair_of(coarse_rolls(), Held::mirrored, 0, 300e-6);
  const auto curve = fem::sweep(pair, fem::log_spaced(5e4, 1e7, 12));
  for (int i = 1; i < 12; ++i) {
    EXPECT_GT(curve.approach[i], curve.approach[i - 1]);
    EXPECT_GT(curve.tangent[i], curve.tangent[i - 1]);
    EXPECT_GT(curve.half_width[i], curve.half_width[i - 1]);
  }
  const auto light = fem::barrel_profile(pair, fem::solve_load(pair, 5e4)),
             heavy = fem::barrel_profile(pair, fem::solve_load(pair, 1e7));
  const auto last  = light.z.size() - 1;
  EXPECT_EQ(light.line_load[last], 0);
  EXPECT_EQ(light.half_width[last], 0);
  EXPECT_GT(heavy.line_load[last], 0);
}

TEST(FourierContact, TenTimesTheSizeIsTheSameContact)
{
  const auto grown = [](RollGeometry g) {
    for (double *length : {&g.radius, &g.half_length, &g.neck_radius, &g.neck_length, &g.seat_centre})
      *length *= 10;
    return g;
  };
  auto size          = meshes::meridian_size(10 * half_width(F1));
  size.largest_share = 0.1;
  size.core_share    = 0.4;
  size.radial_growth = 2.5;
  auto options       = options_at(F1, true);
  options.half_width *= 10;
  Rolls r{condensed(grown(backup), size, options), {}};
  r.second         = condensed(grown(work), size, options, r.first.edge);
  const auto large = fem::solve_load(fem::fourier_pair("upper", r.first, {RollSupport::necks, 0}, r.second,
                                                       {RollSupport::strip, 5.}, parabola(0.1 * r.centre(), 1e-3)),
                                     100 * F1);
  const auto small = fem::solve_load(pair_of(coarse_rolls(), Held::in_stand, 0.5, 1e-4), F1);
  EXPECT_TRUE(
      near(large.approach, 10 * small.approach, within(1e-9, "mesh coordinates of 1e-16 on elements of 1e-3")));
  EXPECT_TRUE(near(large.tangent, 10 * small.tangent, within(1e-9, "the same")));
}

TEST(FourierContact, RefusesWhatMakesNoSense)
{
  const auto pair = pair_of(coarse_rolls(), Held::mirrored, 0, 0);
  EXPECT_THROW(fem::solve_load(pair, 0), InputError);
  EXPECT_THROW(
      fem::fourier_pair("upper", coarse_rolls().first, {}, coarse_rolls().second, {}, Eigen::VectorXd::Zero(3)),
      std::logic_error);
  EXPECT_THROW(fem::fourier_pair("upper", coarse_rolls().first, {}, stand_rolls().second, {},
                                 Eigen::VectorXd::Zero(coarse_rolls().centre().size())),
               std::logic_error);
  auto size          = meshes::meridian_size(half_width(F1));
  size.end_layer     = 0.1;
  size.largest_share = 0.5;
  EXPECT_THROW(condensed(work, size, {}), InputError) << "no half width given";
  EXPECT_THROW(condensed(work, size, options_at(F1), Eigen::VectorXd::LinSpaced(4, 0, 0.5)), InputError)
      << "stations that end before the contact";
  const RollGeometry plain{0.2, 0.5, 0, 0, 0, 0};
  const auto neckless = condensed(plain, size, options_at(F1));
  EXPECT_THROW(fem::fourier_pair("upper", neckless, {RollSupport::necks, 0}, neckless, {},
                                 Eigen::VectorXd::Zero(neckless.edge.size() - 1)),
               std::logic_error);
}
