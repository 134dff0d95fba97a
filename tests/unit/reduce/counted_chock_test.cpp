// A chock is counted once in the chain: inside the bearing that was computed with it, or as the spring of [frame].
#include "core/case/moving_keys.h"
#include "core/model/case.h"
#include "reduce/stand/lumped_stand.h"
#include "tests/support/near.h"
#include <algorithm>
#include <utility>

using namespace mill;

namespace {
// The demo stand with a drawn backup bearing, whose chock stiffnesses of [frame] are given all the same.
LumpedModel chain_with(const std::string &more)
{
  const auto the_case =
      read_case("cases/four-high-1400.toml",
                {"bearing.crb.bore=950 mm", "bearing.crb.outside_diameter=1200 mm", "bearing.crb.width=520 mm",
                 "bearing.crb.roller_law=iso", "frame.upper_chock_stiffness=1.03e5 kN/mm",
                 "frame.lower_chock_stiffness=0.9e5 kN/mm", more});
  const auto spring = [](const double value) {
    Parameter p;
    p.value = value;
    p.unit  = "N/m";
    return p;
  };
  reduce::ChainInputs in;
  in.K3 = in.K5 = spring(4e10);
  in.K4         = spring(2.3e8);
  in.K_Zy_upper = in.K_Zy_lower = spring(2.4e10);  // the chock is in it, or not: the chain cannot tell
  in.Kzc                        = {spring(1.2e10), spring(7e9), spring(7e9), spring(1.2e10)};
  in.at                         = "976.0 kN";
  MovingKeys keys(the_case.spec);
  return reduce::lumped_stand(std::get<FourHigh>(the_case.spec), in, reduce::StatedErrors::propagated, &keys)
      .model;
}
}  // namespace

TEST(CountedChock, IsNoSpringOfTheChainWhereTheBearingHasIt)
{
  const LumpedModel elastic = chain_with("bearing.crb.rings=elastic"),
                    rigid   = chain_with("bearing.crb.rings=rigid");
  const auto softer         = [&](const std::size_t i) { return 1 / rigid.K[i].value - 1 / elastic.K[i].value; };
  EXPECT_TRUE(near(softer(1), 1 / 1.03e11, within(1e-9, "one spring in series more or less")));
  EXPECT_TRUE(near(softer(5), 1 / 0.9e11, within(1e-9, "one spring in series more or less")));
  for (const std::size_t i : {0, 6})
    EXPECT_EQ(elastic.K[i].value, rigid.K[i].value) << "K" << i + 1 << " has no chock";
  for (const auto &chock :
       {std::pair(1, "frame.upper_chock_stiffness"), std::pair(5, "frame.lower_chock_stiffness")}) {
    const char *key          = chock.second;
    const auto chock_springs = [&](const LumpedModel &model) {
      const auto &inputs = model.K[std::size_t(chock.first)].inputs;
      return std::count(inputs.begin(), inputs.end(), key);
    };
    EXPECT_EQ(chock_springs(elastic), 0) << key;
    EXPECT_EQ(chock_springs(rigid), 1) << key;
  }
  // The masses follow: with the chock as a spring of its own less of the cylinder moves with the roll.
  EXPECT_NE(elastic.M[1].value, rigid.M[1].value);
}

TEST(CountedChock, ARigidChockOfElasticRingsLeavesItToTheFrame)
{
  const LumpedModel apart = chain_with("bearing.crb.chock=rigid"), rigid = chain_with("bearing.crb.rings=rigid");
  for (const std::size_t i : {1, 5})
    EXPECT_EQ(apart.K[i].value, rigid.K[i].value) << i;
}
