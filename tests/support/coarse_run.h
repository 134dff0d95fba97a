#pragma once
#include "core/base/files.h"
#include "tests/support/program.h"
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

// Runs of the demo stand on coarse meshes, and what two of them differ by.

/// The demo stand, quick to condense: coarse contacts, slab bite, bearings by the standard.
inline const std::string coarse_demo =
    " -q --set contact.upper.elements_per_half_width=2 --set contact.lower.elements_per_half_width=2 "
    "--set contact.upper.samples=7 --set contact.lower.samples=7 --set bite.method=slab "
    "--set dynamics.output_rate='5 kHz' --set bearing.trb.roller_law=iso --set bearing.trb.rings=rigid ";

/// Folder of a run of it into scratch(name), with the cache that all tests share.
inline std::string coarse_run(const std::string &verb, const std::string &name, const std::string &more)
{
  const std::string folder = scratch(name);
  const auto outcome       = millstand(verb + " cases/four-high-1400.toml -o " + folder + coarse_demo + more +
                                       " --cache " + shared_cache());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return folder;
}

// Modes of components come from a Lanczos iteration that sums over memory whose alignment follows the schedule:
// their frequencies differ by some 1e-12.  The record of the run, its log and the page show times.
inline bool shows_times_or_component_modes(const std::string &name)
{
  // Matrices and shapes of the components, and what is drawn over their frequencies; results hold the same
  // numbers.
  for (const char *part : {"craig-bampton", "curves/frf-", "campbell"})
    if (name.find(part) != std::string::npos)
      return true;
  static const std::set<std::string> names{"run.json",     "report.html",        "millstand.log",
                                           "results.json", "curves/models.json", "curves/modes-craig-bampton.csv"};
  return names.count(name) > 0;
}

/// Files of two runs that differ to the bit, and results that differ by more than rounding.
inline std::string difference_of_runs(const std::string &a, const std::string &b)
{
  std::string different;
  namespace fs = std::filesystem;
  for (const auto &entry : fs::recursive_directory_iterator(a)) {
    const std::string name = fs::relative(entry.path(), a).string();
    if (!entry.is_regular_file() || shows_times_or_component_modes(name))
      continue;
    if (!fs::exists(b + "/" + name) || mill::read_text(entry.path().string()) != mill::read_text(b + "/" + name))
      different += name + " ";
  }
  const auto values = [](const std::string &folder) {
    return nlohmann::json::parse(mill::read_text(folder + "/results.json")).at("values");
  };
  const auto one = values(a), two = values(b);
  EXPECT_EQ(one.size(), two.size());
  for (const auto &[name, result] : one.items()) {
    const double x = result.at("value"), y = two.at(name).at("value");
    const bool of_components = name.rfind("craig-bampton", 0) == 0 || name.rfind("mode.", 0) == 0 ||
                               name.rfind("frf.", 0) == 0 || name.rfind("campbell.", 0) == 0;
    // A maximum is flat: its place moves with the square root of rounding, 3e-12 here.
    const bool place_of_maximum = name.rfind("frf.", 0) == 0 && name.find(".frequency") != std::string::npos;
    const double tolerance      = place_of_maximum ? 1e-6 : 1e-10;
    if (of_components ? std::abs(x - y) > tolerance * std::abs(x) : x != y)
      different += name + " ";
  }
  return different;
}
