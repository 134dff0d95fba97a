#pragma once
#include "core/base/files.h"
#include "tests/support/program.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

// Runs of the demo stand that are quick to condense, with the arc of the bite kept rigid too (coarse_run.h does
// not).
namespace quick_stand {
/// Coarse contacts, slab bite, bearings by the standard.
inline const std::string quick =
    " -q --cache " + shared_cache() +
    " --set contact.upper.elements_per_half_width=2 --set contact.lower.elements_per_half_width=2 "
    "--set contact.upper.samples=7 --set contact.lower.samples=7 --set bite.method=slab --set bite.arc=rigid "
    "--set dynamics.output_rate='5 kHz' --set bearing.trb.roller_law=iso --set bearing.trb.rings=rigid ";

inline const std::string demo = "cases/four-high-1400.toml";

/// Into scratch(name).
inline Outcome run(const std::string &verb, const std::string &file, const std::string &name,
                   const std::string &more = "")
{
  return millstand(verb + " " + file + " -o " + scratch(name) + quick + more);
}

/// The same with what the console says.
inline Outcome loud_run(const std::string &verb, const std::string &file, const std::string &name)
{
  std::string command = verb + " " + file + " -o " + scratch(name) + quick;
  command.erase(command.find(" -q"), 3);
  return millstand(command);
}

inline nlohmann::json json_of(const std::string &path)
{
  return nlohmann::json::parse(mill::read_text(path));
}

/// Of a run into scratch(name).
inline double quick_value(const std::string &name, const std::string &result)
{
  return json_of(scratch(name) + "/results.json").at("values").at(result).at("value").get<double>();
}

/// Whether a result names the key among those that its error needs.
inline bool lacks(const nlohmann::json &result, const std::string &key)
{
  const auto entry = result.find("error_lacks");
  return entry != result.end() && std::find(entry->begin(), entry->end(), key) != entry->end();
}

/// The demo stand as it is, run once: its folder.
inline const std::string &demo_masses()
{
  static const std::string folder = [] {
    const auto outcome = run("masses", demo, "demo");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return scratch("demo");
  }();
  return folder;
}
}  // namespace quick_stand
