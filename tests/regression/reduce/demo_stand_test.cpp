// The demo stand as the reference file describes it.  Its masses and frame springs were tuned to published values,
// so agreement with those proves nothing; what is tested is that the same drawing gives the same numbers as the
// independent program behind the reference.
#include "core/case/moving_keys.h"
#include "reduce/bearing/rigid_rings.h"
#include "reduce/chain/beam_shapes.h"
#include "reduce/chain/line_contact.h"
#include "reduce/stand/lumped_stand.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include <algorithm>
#include <cmath>

using namespace mill;
using namespace mill::reduce;
using mill::bearing::solve_bearing;

namespace {
FourHigh demo_stand()
{
  const auto in = reference("demo.inputs");
  FourHigh s;
  s.steel                        = {2.1e11, 0.28, in.at("rho")};
  s.work_roll.barrel_diameter    = in.at("D1");
  s.work_roll.barrel_length      = in.at("Lw");
  s.work_roll.neck_diameter      = in.at("d1");
  s.work_roll.neck_length        = (double(in.at("lw")) - double(in.at("Lw"))) / 2;
  s.work_roll.bearing_span       = in.at("l1");
  s.work_roll.bearing_mass       = in.at("m_zc");
  s.work_roll.chock_mass_upper   = in.at("m_chock_w_upper");
  s.work_roll.chock_mass_lower   = in.at("m_chock_w_lower");
  s.backup_roll.barrel_diameter  = in.at("D2");
  s.backup_roll.barrel_length    = in.at("Lb");
  s.backup_roll.neck_diameter    = in.at("d2");
  s.backup_roll.neck_length      = in.at("neck2_each");
  s.backup_roll.bearing_span     = in.at("lb");
  s.backup_roll.bearing_mass     = in.at("m_r");
  s.backup_roll.chock_mass_upper = in.at("m_Zt");
  s.backup_roll.chock_mass_lower = in.at("m_Zd");
  s.strip.width                  = in.at("strip_B");
  Frame &f                       = s.frame;
  f.upper_post_mass              = in.at("M_LZ");
  f.upper_beam_mass              = in.at("M_L");
  f.upper_packing_mass           = in.at("M_DKt");
  f.piston_mass                  = in.at("M_hs");
  f.cylinder_mass                = in.at("m_yg");
  f.balance_mass                 = in.at("m_ph_total");
  f.lower_post_mass              = in.at("M_LZd");
  f.lower_beam_mass              = in.at("M_Ld");
  f.load_cell_mass               = in.at("M_cy");
  f.lower_packing_mass           = in.at("M_DKd");
  f.upper_post_stiffness         = in.at("K_LZ");
  f.upper_beam_stiffness         = in.at("K_L");
  f.piston_stiffness             = in.at("K_HS");
  f.upper_packing_stiffness      = in.at("K_DKt");
  f.lower_post_stiffness         = in.at("K_LZd");
  f.lower_beam_stiffness         = in.at("K_Ld");
  f.lower_packing_stiffness      = in.at("K_DKd");
  f.oil_column_stiffness         = in.at("K_y");
  f.cylinder_body_stiffness      = in.at("K_gt");
  f.upper_chock_stiffness        = in.at("K_Zt");
  f.lower_chock_stiffness        = in.at("K_Zd");
  return s;
}

Parameter spring(const double value, const double error = not_given)
{
  Parameter p;
  p.value          = value;
  p.unit           = "N/m";
  p.error_estimate = error;
  return p;
}

RollerBearing backup_bearing()
{
  RollerBearing b;
  b.name            = "crb";
  b.type            = BearingType::four_row_cylindrical;
  b.rollers_per_row = 32;
  b.roller_length   = 0.110;
  b.roller_diameter = 0.075;
  b.roller_law      = OneRollerLaw::palmgren;
  return b;
}

/// Tangent of both bearings of one backup roll at a rolling force.
double K_Zy(const double force)
{
  return 2 * solve_bearing(backup_bearing(), force / 2).tangent;
}

double K3(const double force)
{
  return line_contact({0.420, 1.450, 1.4, {2.1e11, 0.28, 7700}}, force).tangent;
}

ChainInputs inputs_at(const double force, const double K3_error = not_given,
                      const double bearing_error = not_given)
{
  ChainInputs in;
  in.K3 = in.K5 = spring(K3(force), K3_error);
  in.K4         = spring(0);
  in.K_Zy_upper = in.K_Zy_lower = spring(K_Zy(force), bearing_error);
  in.K3.inputs                  = {"work_roll.barrel_diameter", "backup_roll.barrel_diameter"};
  in.at                         = "976.2 kN";
  return in;
}

constexpr double working_load = 976217.5;
const auto closed =
    within(1e-8, "closed forms; the reference integrates across the strip edge, which costs 1e-10");

bool contains(const std::vector<std::string> &keys, const std::string &key)
{
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}
}  // namespace

TEST(DemoStand, MassesAndSprings)
{
  const LumpedStand result = lumped_stand(demo_stand(), inputs_at(working_load));
  const auto masses = reference("demo.masses"), springs = reference("demo.stiffness");
  for (int i = 0; i < 6; ++i)
    EXPECT_TRUE(near(result.model.M[std::size_t(i)].value, masses.at("M" + std::to_string(i + 1)), closed))
        << "M" << i + 1;
  for (const int i : {1, 2, 3, 5, 6, 7})
    if (i != 4)
      EXPECT_TRUE(near(result.model.K[std::size_t(i - 1)].value, springs.at("K" + std::to_string(i)), closed))
          << "K" << i;
  EXPECT_TRUE(near(result.K_ZW.value, springs.at("K_ZW"), closed));
  EXPECT_TRUE(near(result.K_Zy_upper.value, springs.at("K_Zy"), closed));
}

TEST(DemoStand, Flexibilities)
{
  const Flexibilities u = lumped_stand(demo_stand(), inputs_at(working_load)).flexibility;
  const auto expected   = reference("demo.flexibilities");
  EXPECT_TRUE(near(u.cylinder, expected.at("u_yg"), closed));
  EXPECT_TRUE(near(u.chock_upper, expected.at("u_Zt"), closed));
  EXPECT_TRUE(near(u.bearing_upper, expected.at("u_r"), closed));
  EXPECT_TRUE(near(u.roll_upper, expected.at("u2"), closed));
  EXPECT_TRUE(near(u.bearing_lower, expected.at("u_r_lower"), closed));
  EXPECT_TRUE(near(u.roll_lower, expected.at("u2_lower"), closed));
}

TEST(DemoStand, Shapes)
{
  const LumpedStand result = lumped_stand(demo_stand(), inputs_at(working_load));
  const auto ratio         = reference("demo.f1_ratio");
  const auto at_bearing    = [](const RollShape &shape) {  // x = 1.0 m lies between two of the 101 stations
    for (Eigen::Index i = 1; i < shape.x.size(); ++i)
      if (shape.x[i] >= 1.0) {
           const double s = (1.0 - shape.x[i - 1]) / (shape.x[i] - shape.x[i - 1]);
           return ((1 - s) * shape.value[i - 1] + s * shape.value[i]) / shape.value[0];
      }
    return not_given;
  };
  const auto straight = within(1e-8, "the neck is straight, so linear interpolation is exact");
  EXPECT_TRUE(near(at_bearing(result.f1_upper), ratio[0], straight));
  EXPECT_TRUE(near(at_bearing(result.f1_lower), ratio[1], straight));
  EXPECT_TRUE(near(result.f2_upper.value[0], result.flexibility.roll_upper, within(1e-14, "mid-span reference")));
  EXPECT_TRUE(near(result.f2_lower.value[100], result.flexibility.bearing_lower, within(1e-14, "bearing centre")));
  EXPECT_TRUE(
      near(1 / (result.f1_upper.value[0] - result.flexibility.roll_upper), reference("demo.K3_midspan"), closed));
}

TEST(DemoStand, MeanReference)
{
  FourHigh stand                = demo_stand();
  stand.dynamics.mass_reference = MassReference::mean;
  const LumpedStand result      = lumped_stand(stand, inputs_at(working_load));
  const auto expected           = reference("demo.mean_reference");
  EXPECT_TRUE(near(result.K_ZW.value, expected.at("K_ZW"), closed));
  for (int i = 2; i <= 5; ++i)
    EXPECT_TRUE(near(result.model.M[std::size_t(i - 1)].value, expected.at("M" + std::to_string(i)), closed))
        << "M" << i;
  EXPECT_TRUE(near(result.model.M[1].checks.at(0).value, reference("demo.masses").at("M2"), closed));
}

TEST(DemoStand, MovingMasses)
{
  const FourHigh s    = demo_stand();
  const auto expected = reference("demo.moving_masses");
  const double roll   = s.steel.density * M_PI / 4 *
                      (std::pow(s.work_roll.barrel_diameter, 2) * s.work_roll.barrel_length +
                       2 * std::pow(s.work_roll.neck_diameter, 2) * s.work_roll.neck_length);
  EXPECT_TRUE(near(roll, expected.at("m_wr"), within(1e-12, "density times volume")));
  // A roll on a very stiff elastic foundation under the whole barrel, on a backup roll that does not bend: every
  // part moves alike.
  FourHigh stiff                    = s;
  stiff.strip.width                 = 2;
  stiff.backup_roll.barrel_diameter = 1e3;
  ChainInputs in                    = inputs_at(working_load);
  in.K3 = in.K5           = spring(1e18);
  const LumpedModel model = lumped_model(stiff, in);
  EXPECT_TRUE(
      near(model.M[2].value, expected.at("M3_total"), within(1e-5, "the thick barrel still bends by 1e-6")));
  EXPECT_TRUE(near(model.M[3].value, expected.at("M4_total"), within(1e-5, "as M3")));
}

// One input changed, K1, K7, K_Zy and K3 kept.
TEST(DemoStand, Sensitivities)
{
  const auto expected = reference("demo.sensitivity");
  const auto check    = [&](const FourHigh &stand, const std::string &name) {
    const LumpedModel model = lumped_model(stand, inputs_at(working_load));
    for (int i = 0; i < 4; ++i)
      EXPECT_TRUE(near(model.M[std::size_t(i + 1)].value, expected.at(name)[i], closed)) << name << " M" << i + 2;
  };
  FourHigh stand                   = demo_stand();
  stand.work_roll.chock_mass_upper = 880;
  check(stand, "same_chocks");
  stand             = demo_stand();
  stand.strip.width = 1.4;
  check(stand, "strip_1.4");
  stand               = demo_stand();
  stand.steel.density = 7850;
  check(stand, "rho_7850");
  stand                             = demo_stand();
  stand.backup_roll.barrel_diameter = 1.30;
  check(stand, "D2_1.30");
}

// K2 and K6 of the reference are the published springs with the change of the backup bearing's tangent between the
// loads.
TEST(DemoStand, LoadDependentSprings)
{
  RollerBearing work;
  work.name              = "trb";
  work.type              = BearingType::four_row_tapered;
  work.rollers_per_row   = 39;
  work.roller_length     = 0.0334;
  work.cup_angle         = 19.66 * M_PI / 180;
  work.roller_law        = OneRollerLaw::palmgren;
  const LumpedModel base = lumped_model(demo_stand(), inputs_at(working_load));
  for (const auto &row : reference("load.table")) {
    const double force      = row[0];
    const LumpedModel model = lumped_model(demo_stand(), inputs_at(force));
    EXPECT_TRUE(near(model.K[2].value, row[1], closed));
    EXPECT_TRUE(near(1 / (1 / model.K[1].value - 1 / base.K[1].value + 1 / 1.0233e10), row[2], closed));
    EXPECT_TRUE(near(1 / (1 / model.K[5].value - 1 / base.K[5].value + 1 / 2.9301e10), row[3], closed));
    EXPECT_TRUE(near(solve_bearing(work, force / 20).tangent, row[10], closed));
  }
  const Eigen::VectorXd K_Zy_reference = reference_vector("bearing.backup.K_Zy");
  EXPECT_TRUE(near(K_Zy(737992.5), K_Zy_reference[0], closed));
  EXPECT_TRUE(near(K_Zy(10e6), K_Zy_reference[2], closed));
}

TEST(LumpedStand, GivenValuesReplaceAndKeepTheirSource)
{
  FourHigh stand  = demo_stand();
  const auto give = [&](const std::string &name, const double value, const Source source) {
    Parameter p       = spring(value);
    p.source          = source;
    stand.given[name] = {p, {}};
  };
  give("K3", 7.53399e11, Source::published);
  give("M2", 6e4, Source::given);
  give("K_ZW", 1e11, Source::measured);
  give("Kzc2", 2.01e10, Source::published);
  give("C", 1.9e5, Source::published);
  const LumpedStand result = lumped_stand(stand, inputs_at(working_load));
  EXPECT_EQ(result.model.K[2].value, 7.53399e11);
  EXPECT_EQ(result.model.K[2].source, Source::published);
  EXPECT_EQ(result.model.M[1].value, 6e4);
  EXPECT_EQ(result.model.M[1].source, Source::given);
  EXPECT_EQ(result.model.Kzc[1].value, 2.01e10);
  EXPECT_EQ(result.model.C.value, 1.9e5);
  EXPECT_EQ(result.K_ZW.value, 1e11);
  // K6 = 1 / (1/K_Zd + 1/K_Zy + 1/K_ZW) with the given roll stiffness
  EXPECT_TRUE(near(result.model.K[5].value, 1 / (1 / 1.03e11 + 1 / K_Zy(working_load) + 1e-11),
                   within(1e-12, "three springs in series")));
  // A stiffer contact pulls the work roll along: w1 vanishes, and the lower roll (K5 computed) does not notice.
  EXPECT_GT(result.model.M[2].value, lumped_model(demo_stand(), inputs_at(working_load)).M[2].value);
}

TEST(LumpedStand, EveryNumberCarriesItsProof)
{
  MovingKeys keys(demo_stand());
  const LumpedModel model =
      lumped_stand(demo_stand(), inputs_at(working_load, 0.02, 0.05), StatedErrors::propagated, &keys).model;
  for (const auto &mass : model.M) {
    EXPECT_EQ(mass.unit, "kg");
    EXPECT_EQ(mass.source, Source::computed);
    EXPECT_FALSE(mass.method.empty());
    EXPECT_FALSE(mass.inputs.empty());
  }
  EXPECT_TRUE(contains(model.M[1].inputs, "backup_roll.barrel_diameter"));
  EXPECT_TRUE(contains(model.M[2].inputs, "work_roll.barrel_diameter"));
  EXPECT_TRUE(contains(model.K[1].inputs, "frame.oil_column_stiffness"));
  EXPECT_FALSE(contains(model.K[0].inputs, "backup_roll.barrel_diameter"));
  EXPECT_EQ(model.at.text(), "976.2 kN");
  EXPECT_EQ(model.C.source, Source::assumed);
}

// Every mass and stiffness of the frame within 3 %, K_ZW within 4 %.
namespace {
FourHigh with_tolerances(FourHigh stand)
{
  for (const FrameValue &part : frame_values(stand.frame)) {
    const std::string key = part.tolerance_key.substr(std::string("frame.").size());
    stand.frame.tolerance[key.substr(0, key.size() - std::string("_tolerance").size())] = 0.03;
  }
  stand.given["K_ZW"].parameter = spring(68123188538.0, 0.04);
  return stand;
}
}  // namespace

// An error that is not stated is not zero: the value has none and names what it lacks.
TEST(LumpedStand, AnUnknownErrorIsNotZero)
{
  const LumpedStand chain  = lumped_stand(demo_stand(), inputs_at(working_load, 0.02, 0.05));
  const LumpedModel &model = chain.model;
  for (const Parameter *p : {&model.K[0], &model.K[1], &model.K[5], &model.K[6], &model.M[0], &model.M[1],
                             &model.M[2], &model.M[3], &model.M[4], &model.M[5]}) {
    EXPECT_TRUE(std::isnan(p->error_estimate));
    EXPECT_FALSE(p->error_lacks.empty());
  }
  EXPECT_EQ(model.K[2].error_estimate, 0.02);
  EXPECT_TRUE(contains(model.K[0].error_lacks, "frame.upper_post_stiffness_tolerance"));
  EXPECT_FALSE(contains(model.K[0].error_lacks, "frame.oil_column_stiffness_tolerance"));
  EXPECT_TRUE(contains(model.K[1].error_lacks, "frame.oil_column_stiffness_tolerance"));
  EXPECT_TRUE(contains(model.K[1].error_lacks, "K_ZW")) << "a beam without a solid roll to compare with";
  EXPECT_FALSE(contains(model.M[4].error_lacks, "frame.oil_column_stiffness_tolerance")) << "the lower half";
}

// K2 takes K2/K_i of the error of each of its springs; what adds up has the error of its parts.
TEST(LumpedStand, ErrorEstimatesArePropagated)
{
  const FourHigh stand    = with_tolerances(demo_stand());
  const LumpedModel model = lumped_model(stand, inputs_at(working_load, 0.02, 0.05));
  const auto difference   = within(1e-6, "central difference of springs in series");
  EXPECT_TRUE(near(model.K[0].error_estimate, 0.03, difference));
  EXPECT_TRUE(near(model.M[0].error_estimate, 0.03, difference));
  const Frame &f    = stand.frame;
  const double flex = 0.03 / f.oil_column_stiffness + 0.03 / f.cylinder_body_stiffness +
                      0.03 / f.upper_chock_stiffness + 0.05 / K_Zy(working_load) + 0.04 / 68123188538.0;
  EXPECT_TRUE(near(model.K[1].error_estimate, flex * model.K[1].value, difference));
  EXPECT_TRUE(model.K[1].error_lacks.empty());
  EXPECT_GT(model.M[2].error_estimate, 0);
  EXPECT_TRUE(std::isnan(lumped_model(stand, inputs_at(working_load, 0.02)).K[1].error_estimate));
}

// A given K1 stands in the way of all masses of its half, and states its own error.
TEST(LumpedStand, TheErrorOfAGivenSpringReachesTheMasses)
{
  FourHigh stand         = with_tolerances(demo_stand());
  const auto error_of_M2 = [&] {
    return lumped_model(stand, inputs_at(working_load, 0.02, 0.05)).M[1].error_estimate;
  };
  stand.given["K1"].parameter = spring(6.3e9, 0);
  const double exact          = error_of_M2();
  stand.given["K1"].parameter = spring(6.3e9, 0.1);
  EXPECT_GT(error_of_M2(), exact);
  stand.given["K1"].parameter = spring(6.3e9);
  EXPECT_TRUE(std::isnan(error_of_M2()));
}

TEST(LumpedStand, RefusesAMissingSpring)
{
  FourHigh stand                   = demo_stand();
  stand.frame.oil_column_stiffness = 0;
  EXPECT_THROW(lumped_stand(stand, inputs_at(working_load)), InputError);
  ChainInputs in = inputs_at(working_load);
  in.K_Zy_lower  = spring(0);
  EXPECT_THROW(lumped_stand(demo_stand(), in), InputError);
}
