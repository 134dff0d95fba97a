// Modes of whole stands as a run names them: with the strip between the work rolls and without it.
#include "core/base/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <vector>

namespace {
struct FrequencyAndShare {
  double hertz, percent;
};

nlohmann::json stored(const std::string &folder)
{
  return nlohmann::json::parse(mill::read_text(scratch(folder) + "/results.json"));
}

// Frequency and share of the gap of every mode in a table of a run.
std::vector<FrequencyAndShare> modes_in(const std::string &folder, const std::string &table)
{
  std::istringstream lines(mill::read_text(scratch(folder) + "/curves/" + table + ".csv"));
  std::vector<FrequencyAndShare> modes;
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line.rfind("mode,frequency [Hz],gap_share", 0), 0u) << line;
  while (std::getline(lines, line)) {
    FrequencyAndShare mode{};
    EXPECT_EQ(std::sscanf(line.c_str(), "%*[^,],%lf,%lf", &mode.hertz, &mode.percent), 2) << line;
    mode.percent *= 100;
    modes.push_back(mode);
  }
  return modes;
}

// All modes with at least 4 % of the gap, against the table of the specification.
void expect_modes(const std::string &table, const std::vector<FrequencyAndShare> &expected)
{
  SCOPED_TRACE(table);
  std::vector<FrequencyAndShare> large;
  for (const FrequencyAndShare &mode : modes_in("gap-tandem", table))
    if (mode.percent >= 4)
      large.push_back(mode);
  ASSERT_EQ(large.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_TRUE(near(large[i].hertz, expected[i].hertz, within_absolute(0.2, "Hz, of the specification")));
    EXPECT_TRUE(near(large[i].percent, expected[i].percent, within_absolute(0.2, "points, of the specification")));
  }
}

void run_tandem()
{
  static const Outcome outcome =
      millstand("modes cases/cold-tandem-2030.toml -q -o " + scratch("gap-tandem") + " --cache " + shared_cache());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
}
}  // namespace

// Expected: table of the specification of this state, from the matrices of this case with K4 b b^T added.
TEST(GapModes, OfAColdTandemStandAreThoseOfItsMatrices)
{
  run_tandem();
  EXPECT_TRUE(near(stored("gap-tandem").at("values").at("K4.combined").at("value").get<double>(), 17.095e9,
                   within(1e-4, "printed with five digits")));
  expect_modes("modes-open", {{58.7, 60.4}, {116.8, 26.3}, {513.5, 6.6}, {588.8, 5.8}});
  expect_modes("modes", {{75.6, 16.8}, {150.9, 36.3}, {167.5, 7.4}, {538.4, 4.9}, {662.0, 34.0}});
  expect_modes("modes-craig-bampton-open",
               {{53.9, 39.6}, {67.2, 19.0}, {108.9, 11.2}, {137.4, 6.3}, {219.3, 5.4}, {666.4, 6.4}});
  expect_modes("modes-craig-bampton", {{77.9, 14.3},
                                       {117.5, 7.8},
                                       {145.8, 7.5},
                                       {155.1, 4.8},
                                       {234.4, 12.2},
                                       {261.8, 6.4},
                                       {720.7, 6.4},
                                       {819.8, 16.5},
                                       {849.4, 10.2},
                                       {928.2, 4.7}});
}

TEST(GapModes, TheResultsOfBothStatesAreThoseOfTheTables)
{
  run_tandem();
  const auto values = stored("gap-tandem").at("values");
  for (const std::string state : {"", "open."}) {
    const auto of = modes_in("gap-tandem", state.empty() ? "modes-craig-bampton" : "modes-craig-bampton-open");
    int results   = 0;
    for (const auto &[name, value] : values.items()) {
      if (name.rfind(state + "mode.", 0) != 0 || name.find(".gap_share") == std::string::npos)
        continue;
      ++results;
      const std::string of_frequency = name.substr(0, name.rfind('.')) + ".frequency";
      const double hertz             = values.at(of_frequency).at("value");
      const auto row                 = std::find_if(of.begin(), of.end(), [&](const FrequencyAndShare &mode) {
        return std::abs(mode.hertz / hertz - 1) < 1e-9;
      });
      ASSERT_NE(row, of.end()) << of_frequency;
      EXPECT_TRUE(near(100 * value.at("value").get<double>(), row->percent, within(1e-9, "printed digits")));
    }
    EXPECT_GE(results, 10);
    EXPECT_LT(results, int(of.size())) << "what neither gap nor sensors see is no result";
  }
}

// Every name that a run writes, of whatever model and kind.
TEST(GapModes, NoNameIsMixedOrBeyondTheThirdOrder)
{
  const std::regex beyond("order ([4-9]|[1-9][0-9])");
  for (const std::string stand :
       {"cold-tandem-2030", "hot-strip-2050", "plate-4300", "four-high-1400", "z-mill", "twenty-high"}) {
    SCOPED_TRACE(stand);
    const std::string folder = scratch("gap-" + stand);
    const Outcome outcome =
        millstand((stand == "z-mill" || stand == "twenty-high" ? "run" : "modes") + (" cases/" + stand) +
                  ".toml -q -o " + folder + " --cache " + shared_cache());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    int frequencies   = 0;
    const auto values = stored("gap-" + stand).at("values");  // outlives the loop, which keeps a reference
    for (const auto &[name, value] : values.items()) {
      if (name.find("mode") == std::string::npos && !std::regex_search(name, std::regex("(^|\\.)f[0-9]+$")))
        continue;
      ++frequencies;
      const std::string source = value.at("source");
      EXPECT_EQ(name.find("mixed"), std::string::npos) << name;
      EXPECT_EQ(source.find("mixed"), std::string::npos) << name << ": " << source;
      EXPECT_FALSE(std::regex_search(source, beyond)) << name << ": " << source;
      EXPECT_FALSE(std::regex_search(name, std::regex("mode\\..*_([4-9]|[1-9][0-9])\\."))) << name;
    }
    EXPECT_GE(frequencies, 6);
    if (stand == "z-mill" || stand == "twenty-high")
      continue;
    const auto compared = nlohmann::json::parse(mill::read_text(folder + "/curves/models.json"));
    for (const auto &model : compared.at("models"))
      for (const auto &mode : model.at("modes")) {
        const std::string name = mode.at("name");
        EXPECT_EQ(name.find("mixed"), std::string::npos) << name;
        EXPECT_FALSE(std::regex_search(name, beyond)) << model.at("name") << ": " << name;
      }
  }
}
