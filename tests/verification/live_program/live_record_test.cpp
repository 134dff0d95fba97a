#include "tests/support/live_chain.h"
#include "tests/support/program.h"
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

namespace {
std::string written(const std::string &path, const std::string &text)
{
  std::ofstream(path) << text;
  return path;
}

// Columns of a table by their heads.
std::map<std::string, std::vector<double>> columns_of(const std::string &path)
{
  std::ifstream file(path);
  std::string line, cell;
  std::getline(file, line);
  std::vector<std::string> names;
  for (std::istringstream head(line); std::getline(head, cell, ',');)
    names.push_back(cell);
  std::map<std::string, std::vector<double>> columns;
  while (std::getline(file, line)) {
    std::istringstream row(line);
    for (const std::string &name : names) {
      std::getline(row, cell, ',');
      columns[name].push_back(std::stod(cell));
    }
  }
  return columns;
}
}  // namespace

// TW-26 by the verbs: one case and one record of force, once beside the mill and once simulated; held against each
// other are the files that both write.
TEST(LiveRecord, LiveAndSimulateWriteTheSameAccelerations)
{
  constexpr double rate = 4000, gravity = 9.80665;  // Hz, m/s2
  const std::string folder = scratch("live-record");
  const auto force         = comb_force(4096, 1500, 976217.5, 200);
  std::string record       = "time [s],force [N]\n";
  for (Eigen::Index k = 0; k < 6000; ++k)
    record += fmt::format("{},{}\n", double(k) / rate, force[k % force.size()]);
  written(folder + "/force.csv", record);
  const std::string the_case =
      written(folder + "/chain.toml",
              chain_case("output_rate = \"4 kHz\"\n[[pass]]\nname = \"p\"\nforce = \"force.csv\"\n"));
  const Outcome simulated = millstand("simulate " + the_case + " -q -o " + folder + "/out");
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  const Outcome lived = millstand("live " + the_case + " --input " + folder +
                                  "/force.csv --speed max --listen none -q --response " + folder + "/twin.csv");
  ASSERT_EQ(lived.exit_code, 0) << lived.err;

  auto batch = columns_of(folder + "/out/response/p.csv"), twin = columns_of(folder + "/twin.csv");
  for (const std::string place : {"upper_frame", "upper_backup_roll", "upper_work_roll", "lower_work_roll",
                                  "lower_backup_roll", "lower_frame"}) {
    const auto &a = twin[place + " [m/s2]"], &b = batch[place + " [g]"];
    ASSERT_EQ(a.size(), 6000u) << place;
    ASSERT_EQ(b.size(), 6000u) << place;
    double peak = 0, largest = 0;
    for (std::size_t k = 0; k < b.size(); ++k) {
      peak    = std::max(peak, std::abs(b[k] * gravity));
      largest = std::max(largest, std::abs(a[k] - b[k] * gravity));
    }
    EXPECT_GT(peak, 1e-3) << place;
    EXPECT_LT(largest, 1e-12 * peak) << place;
    RecordProperty(place, fmt::format("{:.2g} of the peak", largest / peak));
  }
}
