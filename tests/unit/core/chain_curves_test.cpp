// dynamics.contact = "curve": the curves of a lumped model, and what is refused where there is none.
#include "core/case/chain_curves.h"
#include "core/case/input_reference.h"
#include "core/model/case.h"
#include "core/model/lumped.h"
#include "tests/support/case_folder.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"

using namespace mill;

namespace {
const std::string two_curves =
    "\n[curve]\nK3 = [[\"100 kN\", \"3.2 um\"], [\"1000 kN\", \"27 um\"]]\n"
    "K5 = [[\"100 kN\", \"3.2 um\"], [\"500 kN\", \"14 um\"], [\"1000 kN\", \"27 um\"]]\n";
const std::string wanted = "dynamics.contact=curve";

class ChainCurvesFile : public CaseFolder {
protected:
  Case read(const std::string &name, const std::string &more, const std::vector<std::string> &sets) const
  {
    return read_case(file(name, template_of("lumped") + more), sets);
  }
  std::string refused(const std::string &more, const std::vector<std::string> &sets) const
  {
    return refusals([&] { read("chain.toml", more, sets); });
  }
};
}  // namespace

TEST_F(ChainCurvesFile, CurvesAreReadAndWrittenUnchanged)
{
  const Case once          = read("once.toml", two_curves, {wanted});
  const ChainCurves &first = std::get<Lumped>(once.spec).curves;
  ASSERT_EQ(first.K3.size(), 2u);
  ASSERT_EQ(first.K5.size(), 3u);
  EXPECT_TRUE(first.K2.empty());
  EXPECT_TRUE(near(first.K5[1][0], 500e3, within(1e-15, "unit")));
  EXPECT_TRUE(near(first.K5[1][1], 14e-6, within(1e-15, "unit")));
  const Case twice          = read("twice.toml", chain_curves_toml(first), {wanted});
  const ChainCurves &second = std::get<Lumped>(twice.spec).curves;
  EXPECT_EQ(second.K3, first.K3);
  EXPECT_EQ(second.K5, first.K5);
  EXPECT_EQ(chain_curves_toml({}), "");
}

TEST_F(ChainCurvesFile, WithoutACurveTheKeyAndTheRemedyAreNamed)
{
  EXPECT_EQ(refused("", {}), "accepted");
  EXPECT_EQ(refused(two_curves, {}), "accepted");  // curves that nothing asks for do no harm
  const std::string message = refused("", {wanted});
  EXPECT_NE(message.find("dynamics.contact = \"curve\""), std::string::npos) << message;
  EXPECT_NE(message.find("needs curves, and given.K2 to given.K6 are numbers; add [curve] with K3 = "),
            std::string::npos)
      << message;
}

TEST_F(ChainCurvesFile, CurvesThatDoNotRiseAreRefusedWithTheirPlace)
{
  EXPECT_EQ(refused("\n[curve]\nK3 = [[\"100 kN\", \"3 um\"], [\"200 kN\", \"2 um\"]]\n", {wanted}),
            "curve.K3[1]: force 200 kN, compression 2 um: both must be above zero and rise from pair to pair");
  EXPECT_EQ(refused("\n[curve]\nK3 = [[\"0 kN\", \"3 um\"], [\"200 kN\", \"5 um\"]]\n", {wanted}),
            "curve.K3[0]: force 0 kN, compression 3 um: both must be above zero and rise from pair to pair");
}

TEST_F(ChainCurvesFile, ThePublishedReadingHasNoLoadAtRest)
{
  const std::string message =
      refused(two_curves, {wanted, "dynamics.force_meaning=published", "given.C=1e5 N s/m"});
  EXPECT_NE(message.find("needs the load of every contact at rest"), std::string::npos) << message;
}

TEST(ContactCurvesOfAStand, AGivenStiffnessIsNamed)
{
  const std::string stand = MILLSTAND_SOURCE_DIR "/cases/four-high-1400.toml";
  EXPECT_EQ(refusals([&] { read_case(stand, {wanted}); }), "accepted");
  for (const char *key : {"K3", "K5", "K2", "K6", "K_Zy"}) {
    const std::string message = refusals([&] {
      read_case(stand, {wanted, std::string("given.") + key + "=4e4 kN/mm"});
    });
    EXPECT_NE(message.find(std::string("given.") + key), std::string::npos) << message;
    EXPECT_NE(message.find("is one number and has no curve; leave it out, so that the curve is computed, or set "
                           "dynamics.contact = \"linear\""),
              std::string::npos)
        << message;
  }
}
