// The committed force records are what their generator writes.
#include "tests/support/near.h"
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

namespace fs = std::filesystem;

class ForceRecords : public testing::Test {
protected:
  void SetUp() override
  {
    folder = fs::temp_directory_path() / ("millstand-records-" + std::to_string(getpid()));
    fs::create_directories(folder);
    ASSERT_EQ(std::system(("\"" MAKE_RECORDS "\" \"" + folder.string() + "\"").c_str()), 0);
  }
  void TearDown() override
  {
    fs::remove_all(folder);
  }
  fs::path folder;
};

TEST_F(ForceRecords, CommittedRecordsEqualTheGeneratedOnes)
{
  const fs::path committed = MILLSTAND_SOURCE_DIR "/cases/data";
  for (const std::string name : {"pass-1.csv", "pass-2.csv"}) {
    std::ifstream now(folder / name), then(committed / name);
    std::string a, b;
    std::size_t n_lines = 0, rounded_other_way = 0;
    while (std::getline(then, b)) {
      ASSERT_TRUE(std::getline(now, a)) << name << " is longer than what is generated";
      ++n_lines;
      if (a == b)
        continue;
      // another compiler's FFT may round the last of seven digits the other way
      ASSERT_EQ(a.substr(0, a.find(',')), b.substr(0, b.find(','))) << name << " line " << n_lines;
      ASSERT_TRUE(near(std::stod(a.substr(a.find(',') + 1)), std::stod(b.substr(b.find(',') + 1)),
                       within_absolute(1.001e-4, "one unit of the last of seven digits")))
          << name << " line " << n_lines;
      ++rounded_other_way;
    }
    EXPECT_FALSE(std::getline(now, a)) << name << " is shorter than what is generated";
    EXPECT_EQ(n_lines, 100002u) << name;
    EXPECT_LE(rounded_other_way, 10u) << name << ": a tie of 1e-9 kN in 1e-4 kN, 1e5 lines: 1 expected";
  }
}

TEST_F(ForceRecords, HaveThePublishedRangesToTheLastDigit)
{
  const std::pair<const char *, std::pair<const char *, const char *>> passes[] = {
      {"pass-1.csv", {"972.8980", "979.5370"}}, {"pass-2.csv", {"733.7050", "742.2800"}}};
  for (const auto &[name, range] : passes) {
    std::ifstream file(std::string(MILLSTAND_SOURCE_DIR "/cases/data/") + name);
    std::string line, low = "999.9999", high = "000.0000";
    ASSERT_TRUE(std::getline(file, line));
    EXPECT_EQ(line, "time [s],force [kN]");
    while (std::getline(file, line)) {
      const std::string force =
          line.substr(line.find(',') + 1);  // three digits before the point: text order is order
      low  = std::min(low, force);
      high = std::max(high, force);
    }
    EXPECT_EQ(low, range.first);
    EXPECT_EQ(high, range.second);
  }
}
