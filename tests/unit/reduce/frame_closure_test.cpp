// A frame on a measured mill modulus, theory 30.3: by hand for springs in series, by stands made again for errors.
#include "core/base/short_number.h"
#include "core/case/stand_rows.h"
#include "reduce/chain/frame_closure.h"
#include "reduce/stand/stand_errors.h"
#include "tests/support/beam_demo.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <cmath>

using namespace mill;
using namespace mill::reduce;

namespace {
constexpr double touching = 4.3e10;  // N/m

Parameter spring_with(const double value, const double error)
{
  Parameter p;
  p.value          = value;
  p.unit           = "N/m";
  p.error_estimate = error;
  return p;
}

ChainInputs springs(const double K3 = 4.02e10)
{
  ChainInputs in;
  in.K3         = spring_with(K3, 0);
  in.K5         = spring_with(4.02e10, 0);
  in.K4         = spring_with(0, 0);
  in.K_Zy_upper = in.K_Zy_lower = spring_with(1.023e11, 0);
  in.Kzc  = {spring_with(5.1e10, 0), spring_with(1.9e10, 0), spring_with(1.9e10, 0), spring_with(5.1e10, 0)};
  in.K_ww = spring_with(touching, 0);
  in.at   = "976.2 kN";
  return in;
}

// The demo stand whose frame follows a modulus, all else exact.
FourHigh measured(const double modulus)
{
  FourHigh stand = demo_drawing();
  for (const Field<Frame> &row : frame_rows()) {
    stand.frame.tolerance[row.key] = 0;
    if (std::string(row.key).find("_stiffness") != std::string::npos &&
        std::isfinite(stand.frame.*std::get<double Frame::*>(row.member)))
      stand.frame.closing.insert(row.key);
  }
  stand.frame.modulus           = modulus;
  stand.given["K_ZW"].parameter = spring_with(6.2e10, 0);
  return stand;
}

double modulus_of(const LumpedStand &chain)
{
  double compliance = 1 / touching;
  for (const std::size_t i : {0, 1, 2, 4, 5, 6})
    compliance += 1 / chain.model.K[i].value;
  return 1 / compliance;
}

FourHigh closed(FourHigh stand, const ChainInputs &in)
{
  stand.frame = frame_on_modulus(stand, in);
  return stand;
}

double lowest_frequency(const FourHigh &stand, const ChainInputs &in)
{
  const LumpedStand chain = lumped_stand(stand, in, StatedErrors::none);
  return stand_modes(beam_stand(stand, stand_springs(stand, chain), 8), 200).frequency[0];
}
}  // namespace

TEST(FrameClosure, TheChainHasTheMeasuredModulus)
{
  for (const double M : {1.2e9, 2.06e9, 4.6e9, 5.2e9, 5.5e9, 7e9}) {
    const FourHigh open = measured(M), stand = closed(open, springs());
    EXPECT_TRUE(near(modulus_of(lumped_stand(stand, springs())), M, within(1e-9, "springs in series")));
    EXPECT_TRUE(near(stand.frame.upper_beam_stiffness / open.frame.upper_beam_stiffness,
                     stand.frame.lower_chock_stiffness / open.frame.lower_chock_stiffness,
                     within(1e-12, "the proportion stays")));
  }
}

TEST(FrameClosure, WhatIsGivenStays)
{
  FourHigh stand      = measured(1.9e9);
  stand.frame.closing = {"upper_beam_stiffness", "lower_beam_stiffness"};
  const FourHigh made = closed(stand, springs());
  EXPECT_EQ(made.frame.oil_column_stiffness, stand.frame.oil_column_stiffness);
  EXPECT_TRUE(near(modulus_of(lumped_stand(made, springs())), 1.9e9, within(1e-9, "springs in series")));
}

TEST(FrameClosure, AModulusThatLeavesNothingIsRefusedWithBothNumbers)
{
  const double rest = 2 / 4.02e10 + 1 / touching + 2 / 1.023e11 + 2 / 6.2e10;  // contacts, bearings, bending
  const auto text   = refusals([&] { frame_on_modulus(measured(9e9), springs()); });
  EXPECT_NE(text.find("frame.modulus = 9 MN/mm leaves nothing for the frame"), std::string::npos) << text;
  EXPECT_NE(text.find("have " + short_number(1 / rest / 1e9) + " MN/mm together"), std::string::npos) << text;
}

TEST(FrameClosure, TheErrorOfTheModulusReachesTheFrame)
{
  FourHigh stand            = closed(measured(2.06e9), springs());
  stand.frame.modulus_error = 0.02;
  const LumpedStand chain   = lumped_stand(stand, springs());
  const double C            = closing_compliance(stand.frame);
  const auto slopes         = within(1e-6, "central differences");
  EXPECT_TRUE(near(chain.model.K[0].error_estimate, 0.02 / 2.06e9 / C, slopes))
      << "d ln K1 / d ln M = 1 / (M C_f)";
  EXPECT_TRUE(near(chain.model.K[6].error_estimate, 0.02 / 2.06e9 / C, slopes));
  // A contact that is softer makes the frame stiffer.
  ChainInputs in            = springs();
  in.K3.error_estimate      = 0.1;
  stand.frame.modulus_error = 0;
  EXPECT_TRUE(near(lumped_stand(stand, in).model.K[0].error_estimate, 0.1 / 4.02e10 / C, slopes));
}

TEST(FrameClosure, FrequenciesFollowTheModulusAndKeepIt)
{
  FourHigh stand            = closed(measured(2.06e9), springs());
  stand.frame.modulus_error = 0.001;
  const auto error          = [&](const ChainInputs &in) {
    const LumpedStand chain = lumped_stand(stand, in);
    const auto beams        = [](const FourHigh &s, const StandSprings &k) { return beam_stand(s, k, 8); };
    const StandSprings k    = stand_springs(stand, chain);
    StandWithModes s{beams(stand, k), {}};
    s.modes = stand_modes(s.model, 200);
    return frequency_errors(s, stand, k, chain, beams).error[0];
  };
  const auto small = within(0.01, "first order in a change of 0.1 %");
  const double f   = lowest_frequency(stand, springs());
  EXPECT_TRUE(near(error(springs()),
                   lowest_frequency(closed(measured(2.06e9 * 1.001), springs()), springs()) / f - 1, small));
  stand.frame.modulus_error = 0;
  ChainInputs in            = springs();
  in.K3.error_estimate      = 0.001;
  const ChainInputs stiffer = springs(4.02e10 * 1.001);
  EXPECT_TRUE(
      near(error(in), std::abs(lowest_frequency(closed(measured(2.06e9), stiffer), stiffer) / f - 1), small));
}

TEST(FrameClosure, ASharedSourceAddsUpWithSignsAndOthersBySquares)
{
  FourHigh stand = measured(2.06e9);
  stand.frame.closing.clear();
  const auto error_of_K1 = [&] { return lumped_stand(stand, springs()).model.K[0].error_estimate; };
  for (const char *key : {"upper_post_stiffness", "upper_beam_stiffness"}) {
    stand.frame.tolerance[key] = 0.3;
    stand.frame.source[key]    = "section of the posts";
  }
  const double K1    = lumped_stand(stand, springs()).model.K[0].value;
  const double posts = K1 / stand.frame.upper_post_stiffness, beam = K1 / stand.frame.upper_beam_stiffness;
  const auto slopes = within(1e-6, "central differences");
  EXPECT_TRUE(near(error_of_K1(), 0.3 * (posts + beam), slopes));
  stand.frame.source["upper_beam_stiffness"] = "another";
  EXPECT_TRUE(near(error_of_K1(), 0.3 * std::hypot(posts, beam), slopes));
}
