#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/laws/friction_law.h"
#include "fem/strip/elastic_plastic/strip_elastic.h"
#include "fem/strip/rigid_plastic/strip_flow.h"
#include "meshes/strip/strip_flow.h"
#include "reduce/bite/arc/half_plane.h"
#include "reduce/bite/slab/karman.h"
#include "tests/support/near.h"
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <iterator>
#include <sstream>
#include <unistd.h>
#include <vector>

using namespace mill;

namespace {
bite::RollBite demo()
{
  bite::RollBite b;
  b.roll_radius                = 0.21;
  b.roll.youngs_modulus        = 2.1e11;
  b.roll.poisson_ratio         = 0.28;
  b.strip.width                = 1;
  b.strip.entry_thickness      = 8e-3;
  b.strip.exit_thickness       = 5e-3;
  b.strip.flow_stress.k        = 28e6;
  b.strip.friction.coefficient = 0.2;
  return b;
}

std::string scratch(const std::string &name)
{
  return (std::filesystem::temp_directory_path() / (name + "-" + std::to_string(::getpid()))).string();
}

StripLines lines_of(const bite::RollBite &b, const int along = 12)
{
  return meshes::strip_lines(meshes::strip_block(b.strip, b.roll_radius, along, along / 4));
}

fem::StripFlowModel quick()
{
  fem::StripFlowModel model;
  model.derivatives = false;
  return model;
}

fem::StripFlow solve(const bite::RollBite &b, const fem::StripFlowModel &model = quick())
{
  return fem::solve_strip_flow(lines_of(b), b, model);
}

std::string refusal(const bite::RollBite &b)
{
  bite::RollBite meshed        = demo();
  meshed.strip.entry_thickness = 8e-3;
  try {
    fem::solve_strip_flow(lines_of(meshed), b, quick());
  } catch (const InputError &error) {
    return error.problems[0].message;
  }
  return "accepted";
}
}  // namespace

// Friction 1.2 to 1.5 times the least that draws the strip in, rolls flattened or not.
TEST(StripFlow, BitesNextToSkiddingConverge)
{
  struct {
    double radius, entry, exit, k, mu, entry_tension, exit_tension;
  } const passes[] = {
      {0.0934, 0.243e-3, 0.2126e-3, 583e6, 0.0238, 111e6, 15e6},
      {0.5432, 181.3e-3, 106.6e-3, 130e6, 0.2505, 11e6, 7e6},
      {0.0644, 0.465e-3, 0.386e-3, 356e6, 0.0326, 80e6, 60e6},
      {0.0770, 0.710e-3, 0.693e-3, 945e6, 0.1085, 2e6, 314e6},  // a rigid roll would skid
  };
  for (const auto &p : passes) {
    bite::RollBite b             = demo();
    b.roll_radius                = p.radius;
    b.strip.entry_thickness      = p.entry;
    b.strip.exit_thickness       = p.exit;
    b.strip.entry_tension        = p.entry_tension;
    b.strip.exit_tension         = p.exit_tension;
    b.strip.flow_stress.k        = p.k;
    b.strip.friction.coefficient = p.mu;
    fem::StripFlowModel model;
    model.arc          = bite::Arc::hitchcock;
    model.derivatives  = false;
    const auto flow    = fem::solve_strip_flow(lines_of(b), b, model);
    const double force = bite::solve_karman(b, bite::Theory::karman, bite::Arc::hitchcock).force;
    EXPECT_TRUE(near(flow.state.force / force, 1, within(0.08, "slab against finite elements, 12 x 3 elements")))
        << p.radius;  // slab against finite elements, 12 x 3 elements
    EXPECT_LT(std::abs(flow.balance.power), 0.02) << p.radius;
    EXPECT_LT(flow.work, 2e5) << p.radius;
  }
}

TEST(StripFlow, MoreWorkThanAllowedIsRefused)
{
  fem::StripFlowModel model;
  model.work_limit = 1e4;
  try {
    fem::solve_strip_flow(lines_of(demo()), demo(), model);
    FAIL();
  } catch (const SolverError &e) {
    EXPECT_EQ(e.report.what, "roll bite by finite elements: no convergence within the work allowed");
  }
}

TEST(StripBlock, Lines)
{
  const StripLines lines = lines_of(demo(), 24);
  EXPECT_EQ(lines.arc.size(), 25);
  EXPECT_EQ(lines.inlet.size(), 7);
  EXPECT_EQ(lines.outlet.size(), 7);
  EXPECT_EQ(lines.rows.size(), 7);
  EXPECT_TRUE(near(lines.inlet[0], 8e-3, within_absolute(1e-12, "one entry thickness, rounding")));
  EXPECT_EQ(lines.arc[24], 1);
  // Ends and neutral point have the finest elements.
  const Eigen::VectorXd size = lines.arc.tail(24) - lines.arc.head(24);
  EXPECT_LT(size[0], 0.5 * size.maxCoeff());
  EXPECT_LT(size[23], 0.5 * size.maxCoeff());
}

TEST(StripBlock, RefusesWhatMakesNoMesh)
{
  meshes::StripBlock block = meshes::strip_block(demo().strip, 0.21, 10, 3);
  EXPECT_THROW(meshes::strip_lines(block), InputError);
  block                = meshes::strip_block(demo().strip, 0.21, 12, 3);
  block.exit_thickness = 9e-3;
  EXPECT_THROW(meshes::strip_lines(block), InputError);
}

TEST(StripFlow, RefusesInWords)
{
  bite::RollBite b       = demo();
  b.strip.exit_thickness = 9e-3;
  EXPECT_EQ(refusal(b), "strip.exit_thickness = 9 mm must be positive and below strip.entry_thickness = 8 mm");
  b                    = demo();
  b.strip.exit_tension = 30e6;
  EXPECT_EQ(refusal(b),
            "strip.exit_tension = 30 MPa reaches the flow stress 28 MPa at the exit: the strip yields behind "
            "the bite");
  b                            = demo();
  b.strip.friction.coefficient = 0.02;
  EXPECT_NE(refusal(b).find("the rolls cannot pull the strip through"), std::string::npos) << refusal(b);
  b = demo();
  fem::StripFlowModel model;
  model.arc = bite::Arc::elastic;
  EXPECT_THROW(fem::solve_strip_flow(lines_of(b), b, model), InputError);
}

TEST(StripFlow, ScalesWithStressAndLength)
{
  const bite::RollBite b = demo();
  bite::RollBite large   = b;
  large.roll_radius *= 3;
  large.strip.entry_thickness *= 3;
  large.strip.exit_thickness *= 3;
  large.strip.flow_stress.k *= 7;
  const double small_force = solve(b).state.force;
  EXPECT_TRUE(near(solve(large).state.force / (21 * small_force), 1, within(1e-9, "both converged to 1e-9")));
}

TEST(StripFlow, FieldsAreOnTheirGrid)
{
  const bite::RollBite b    = demo();
  const fem::StripFlow flow = solve(b);
  EXPECT_EQ(flow.x.rows(), 2 * 18 + 1);
  EXPECT_EQ(flow.x.cols(), 2 * 3 + 1);
  for (Eigen::Index i = 1; i < flow.x.rows(); ++i)
    EXPECT_GT(flow.x(i, 0), flow.x(i - 1, 0));
  EXPECT_LT(flow.vx.maxCoeff(), 0);  // against x
  EXPECT_TRUE(near(flow.y(flow.y.rows() - 1, 6), 4e-3, within_absolute(1e-15, "m, rounding of the thickness")));
  const auto n = flow.last_contact - flow.first_contact + 1;
  EXPECT_EQ(flow.state.position.size(), n);
  EXPECT_EQ(flow.nodal_force.size(), n);
  EXPECT_TRUE(near(flow.state.position[n - 1], flow.entry_position,
                   within_absolute(1e-15, "m, the last contact node is the entry")));
  EXPECT_TRUE(near(flow.state.position[0], flow.state.exit_position,
                   within_absolute(1e-15, "m, the first contact node is the exit")));
  // The roller's surface is a circle through the gap.
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x = flow.state.position[i];
    EXPECT_TRUE(near(flow.roll_surface[i], 2.5e-3 + 0.21 - std::sqrt(0.21 * 0.21 - x * x),
                     within_absolute(1e-13, "m, a circle through the gap, rounding")));
  }
  // Pressure and friction make up the force to the angle of the arc (0.12 rad, squared).
  EXPECT_TRUE(
      near(flow.nodal_force.sum() / flow.state.force, 1,
           within(0.015, "pressure and friction make up the force to the angle of the arc, 0.12 rad squared")));
  // Shear drives the strip at the entry and holds it at the exit.
  EXPECT_GT(flow.state.shear[n - 2], 0);
  EXPECT_LT(flow.state.shear[1], 0);
  EXPECT_LT(flow.state.slip[n - 2], 0);
  EXPECT_GT(flow.state.neutral_position, 0);
  EXPECT_LT(flow.state.neutral_position, flow.entry_position);
  // Strain comes from nothing and is that of the reduction, or more, behind the bite.
  EXPECT_TRUE(
      near(flow.strain(flow.strain.rows() - 1, 3), 0, within_absolute(1e-12, "no strain at the entry, rounding")));
  EXPECT_GT(flow.strain.row(0).minCoeff(), 0.99 * std::log(8. / 5));
}

TEST(StripFlow, RowsAreStreamlines)
{
  const fem::StripFlow flow = fem::solve_strip_flow(lines_of(demo(), 24), demo(), quick());
  // Volume between the mid plane and each row, the same on all corner spines.
  const auto through = [&](const Eigen::Index i, const Eigen::Index row) {
    double sum = 0;
    for (Eigen::Index j = 0; j < row; j += 2)
      sum -= (flow.y(i, j + 2) - flow.y(i, j)) / 6 * (flow.vx(i, j) + 4 * flow.vx(i, j + 1) + flow.vx(i, j + 2));
    return sum;
  };
  for (Eigen::Index row = 2; row < flow.y.cols(); row += 2)
    for (Eigen::Index i = 0; i < flow.y.rows(); i += 2)
      EXPECT_TRUE(
          near(through(i, row) / through(0, row), 1, within(4e-3, "error of the mesh; exact for the last row")))
          << i << ' ' << row;  // mesh; exact for the last row
}

TEST(StripFlow, AnotherStateAsStartLeadsToTheSame)
{
  const bite::RollBite b = demo();
  bite::RollBite thicker = b;
  thicker.strip.exit_thickness *= 1.02;
  const StripLines mesh     = lines_of(b);
  const fem::StripFlow from = fem::solve_strip_flow(mesh, thicker, quick());
  const fem::StripFlow warm = fem::solve_strip_flow(mesh, b, quick(), nullptr, &from);
  const fem::StripFlow cold = fem::solve_strip_flow(mesh, b, quick());
  EXPECT_TRUE(near(warm.state.force / cold.state.force, 1, within(1e-8, "both end at residuals of 1e-9")));
  EXPECT_LT(warm.history.size(), cold.history.size());
}

TEST(StripFlow, MovingGap)
{
  bite::RollBite b             = demo();
  b.roll_speed                 = 2;
  const StripLines mesh        = lines_of(b);
  const fem::StripFlow at_rest = fem::solve_strip_flow(mesh, b);
  b.gap_rate                   = 1e-4;
  const fem::StripFlow opens   = fem::solve_strip_flow(mesh, b, quick(), nullptr, &at_rest);
  EXPECT_TRUE(near(opens.balance.flux, 0,
                   within_absolute(1e-10, "volume is kept by the equations, end of the iteration")));
  EXPECT_TRUE(
      near(opens.balance.power, 0, within_absolute(1e-8, "power is kept by the equations, end of the iteration")));
  b.gap_rate                  = -1e-4;
  const fem::StripFlow closes = fem::solve_strip_flow(mesh, b, quick(), nullptr, &at_rest);
  const double difference     = (opens.state.force - closes.state.force) / 2e-4;
  // Truncation of the difference.
  EXPECT_TRUE(near(bite::by(at_rest.state.force_by, bite::Input::gap_rate) / difference, 1,
                   within(1e-4, "truncation of the difference")));
}

TEST(StripFlow, SpeedLawOfFriction)
{
  bite::RollBite b               = demo();
  b.strip.friction.law           = FrictionLaw::speed;
  b.strip.friction.at_unit_speed = 0.2;
  b.strip.friction.per_log_speed = -0.02;
  b.roll_speed                   = 2;
  const StripLines mesh          = lines_of(b);
  const fem::StripFlow flow      = fem::solve_strip_flow(mesh, b);
  EXPECT_TRUE(
      near(flow.state.friction, 0.2 - 0.02 * std::log(2.), within_absolute(1e-12, "the law itself, rounding")));
  // The speed acts through the friction alone.
  EXPECT_TRUE(near(bite::by(flow.state.force_by, bite::Input::roll_speed),
                   bite::by(flow.state.force_by, bite::Input::friction) * -0.02 / 2,
                   within_absolute(1e-6 * flow.state.force,
                                   "the speed acts through the friction alone, end of the iteration")));
}

TEST(StripFlow, FilmFrictionIsThatOfItsOwnSpeeds)
{
  bite::RollBite b          = demo();
  Friction &f               = b.strip.friction;
  f.law                     = FrictionLaw::film;
  f.mu0                     = 0.1;
  f.mu1                     = 0.15;
  f.decay                   = 1e6;
  f.viscosity               = 0.03;
  f.pressure_viscosity      = 1.5e-8;
  b.roll_speed              = 5;
  const fem::StripFlow flow = fem::solve_strip_flow(lines_of(b), b, quick());
  EXPECT_GT(flow.state.film_thickness, 0);
  EXPECT_TRUE(near(
      flow.state.friction, bite::film_friction(f, flow.state.film_thickness),
      within_absolute(1e-6, "the regularised ends still deform: speed of the mid plane there, mean speed here")));
}

TEST(StripFlow, ARollThatDoesNotYieldIsARigidOne)
{
  const bite::RollBite b = demo();
  bite::ArcFlexibility stiff =
      bite::half_plane_flexibility(Eigen::VectorXd::LinSpaced(50, -0.02, 0.05), b.roll, b.roll_radius);
  stiff.influence *= 1e-6;
  fem::StripFlowModel model = quick();
  model.arc                 = bite::Arc::elastic;
  const fem::StripFlow flow = fem::solve_strip_flow(lines_of(b), b, model, &stiff);
  EXPECT_TRUE(near(flow.state.force / solve(b).state.force, 1,
                   within(1e-4, "exit thickness of the strip there, of the gap here")));
  EXPECT_TRUE(
      near(flow.exit_thickness, b.strip.exit_thickness, within_absolute(1e-12, "m, the gap is given, rounding")));
}

TEST(StripFlow, ReportsAFlexibilityThatIsTooShort)
{
  const bite::RollBite b = demo();
  const auto shorter =
      bite::half_plane_flexibility(Eigen::VectorXd::LinSpaced(20, -0.005, 0.015), b.roll, b.roll_radius);
  fem::StripFlowModel model = quick();
  model.arc                 = bite::Arc::elastic;
  try {
    fem::solve_strip_flow(lines_of(b), b, model, &shorter);
    FAIL() << "accepted";
  } catch (const SolverError &error) {
    EXPECT_NE(error.report.remedy.find("the flexibility given reaches from -5 to 15 mm"), std::string::npos)
        << error.report.remedy;
    EXPECT_NE(error.report.kept.find("converged up to g0 = 0.001"), std::string::npos) << error.report.kept;
  }
}

namespace {
// Numbers of one array of a VTU file that is written as text.
std::vector<double> numbers_of(const std::string &text, const std::string &name)
{
  const auto tag = text.find("Name=\"" + name + "\"");
  if (tag == std::string::npos)
    return {};
  const auto begin = text.find('>', tag) + 1;
  std::istringstream in(text.substr(begin, text.find('<', begin) - begin));
  return {std::istream_iterator<double>(in), {}};
}
}  // namespace

TEST(StripFlow, FileHoldsVelocityAndStrainOfEveryNode)
{
  const std::string path    = scratch("strip_flow") + ".vtu";
  const fem::StripFlow flow = solve(demo());
  fem::write_strip_flow_vtu(path, flow);
  const std::string text = read_text(path);
  EXPECT_NE(text.find("NumberOfPoints=\"259\" NumberOfCells=\"54\""), std::string::npos);
  for (const char *field : {"velocity", "pressure_Pa", "strain", "strain_rate", "stress_Pa"})
    EXPECT_NE(text.find(std::string("Name=\"") + field + "\""), std::string::npos) << field;
  EXPECT_EQ(text.find("nan"), std::string::npos);
  const auto velocity = numbers_of(text, "velocity"), strain = numbers_of(text, "strain");
  ASSERT_EQ(velocity.size(), 3u * 259);
  ASSERT_EQ(strain.size(), 259u);
  const Tolerance printed = within(1e-8, "numbers of the file have nine digits", 1e-3);
  std::size_t node        = 0;
  for (Eigen::Index i = 0; i < flow.x.rows(); ++i)
    for (Eigen::Index j = 0; j < flow.x.cols(); ++j, ++node) {
      EXPECT_TRUE(near(velocity[3 * node], flow.vx(i, j), printed)) << i << ' ' << j;
      EXPECT_TRUE(near(velocity[3 * node + 1], flow.vy(i, j), printed)) << i << ' ' << j;
      EXPECT_TRUE(near(strain[node], flow.strain(i, j), printed)) << i << ' ' << j;
    }
  std::filesystem::remove(path);
}

// An unhardened strip of a power law, which rises from nothing: slab, rigid-plastic and elastic-plastic strip see
// one flow stress at the entry.
TEST(StripFlow, OneLawForSlabAndBothStrips)
{
  bite::RollBite b             = demo();
  b.roll_radius                = 0.25;
  b.strip.entry_thickness      = 2e-3;
  b.strip.exit_thickness       = 1.5e-3;
  b.strip.friction.coefficient = 0.06;
  b.strip.flow_stress          = {FlowStressLaw::power, 900e6, 0, 0.3, 0, {}};
  const bite::BiteState slab   = bite::solve_karman(b, bite::Theory::karman, bite::Arc::rigid);
  const fem::StripFlow rigid   = solve(b);
  fem::StripElasticModel model;
  model.elements_along            = 12;
  model.elements_through          = 2;
  model.derivatives               = false;
  const fem::StripElastic elastic = fem::solve_elastic_strip(b, model);
  const double entry              = 900e6 * std::pow(0.5e-4, 0.3);  // theory.md (8.1a) at zero
  for (const double stress :
       {slab.entry_flow_stress, rigid.state.entry_flow_stress, elastic.flow.state.entry_flow_stress})
    EXPECT_TRUE(near(stress / entry, 1, within(1e-12, "one law at one strain, rounding")));
  EXPECT_TRUE(near(rigid.state.force / slab.force, 1, within(0.03, "thin strip: shear and a mesh of 12 x 3")))
      << "thin strip: shear and a mesh of 12 x 3";
  EXPECT_TRUE(near(elastic.flow.state.force / slab.force, 1.06,
                   within_absolute(0.06, "its elastic ends carry some per cent more")))
      << "its elastic ends carry some per cent more";
}
