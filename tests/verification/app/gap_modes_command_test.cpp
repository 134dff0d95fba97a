// Names of modes in both states of the gap, as a run writes them; all stands of cases/ in the long form
// (tests/campaign/app/gap_modes_of_stands_test.cpp).
#include "tests/support/coarse_run.h"
#include <regex>

TEST(GapModeNames, NoNameIsMixedOrBeyondTheThirdOrder)
{
  const std::regex beyond("order ([4-9]|[1-9][0-9])");
  const std::string folder = coarse_run("modes", "gap-names", "");
  const auto values        = nlohmann::json::parse(mill::read_text(folder + "/results.json")).at("values");
  int rolling = 0, open = 0;
  for (const auto &[name, value] : values.items()) {
    rolling += name.rfind("mode.", 0) == 0;
    open += name.rfind("open.mode.", 0) == 0;
    if (name.find("mode.") == std::string::npos)
      continue;
    const std::string source = value.at("source");
    EXPECT_EQ((name + source).find("mixed"), std::string::npos) << name << ": " << source;
    EXPECT_FALSE(std::regex_search(source, beyond)) << name << ": " << source;
  }
  EXPECT_GE(rolling, 6);
  EXPECT_GE(open, 6);
  EXPECT_TRUE(values.contains("mode.gap_first_kind.frequency"));
  EXPECT_GT(values.at("mode.gap_first_kind.frequency").at("value").get<double>(),
            values.at("open.mode.gap_first_kind.frequency").at("value").get<double>())
      << "the strip is a spring in the gap";
}
