#include "core/records/files.h"
#include "tests/support/program.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

// Stages run side by side; results must not know of it, and what is given or kept is not solved.
namespace fs = std::filesystem;

namespace {
// Quick to condense: coarse contacts, slab bite, bearings by the standard.
const std::string coarse =
    " -q --set contact.upper.elements_per_half_width=2 --set contact.lower.elements_per_half_width=2 "
    "--set contact.upper.samples=7 --set contact.lower.samples=7 --set bite.method=slab "
    "--set dynamics.output_rate='5 kHz' --set bearing.trb.roller_law=iso --set bearing.trb.rings=rigid ";

std::string folder_of(const std::string &verb, const std::string &name, const std::string &more)
{
  const std::string folder = scratch(name);
  const auto outcome =
      millstand(verb + " cases/four-high-1400.toml -o " + folder + coarse + more + " --cache " + shared_cache());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return folder;
}

nlohmann::json stages_of(const std::string &folder)
{
  return nlohmann::json::parse(mill::read_text(folder + "/run.json")).at("timings");
}

std::string stages_that_begin(const std::string &folder, const std::string &beginning)
{
  std::string found;
  for (const auto &stage : stages_of(folder))
    if (const auto name = stage.at("stage").get<std::string>(); name.rfind(beginning, 0) == 0)
      found += name + "; ";
  return found;
}

// The demo stand on two threads, once for all tests of this file; from the cache what other tests have left there.
const std::string &first_run()
{
  static const std::string folder = folder_of("run", "first", "--threads 2");
  return folder;
}

// Its stiffnesses, which have all kinds of stages but the components, whose sums are not the same to the bit
// anyway: on two threads from the cache, and on one thread with nothing from the cache.
const std::string &kept_stiffness()
{
  static const std::string folder = folder_of("stiffness", "kept", "--threads 2");
  return folder;
}
const std::string &fresh_stiffness()
{
  static const std::string folder = folder_of("stiffness", "fresh", "--fresh --threads 1");
  return folder;
}

// Modes of components come from a Lanczos iteration that sums over memory whose alignment follows the schedule:
// their frequencies differ by some 1e-12.  The record of the run, its log and the page show times.
bool shows_times_or_component_modes(const std::string &name)
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

// Files of two runs that differ to the bit, and results that differ by more than rounding.
std::string different(const std::string &a, const std::string &b)
{
  std::string different;
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
}  // namespace

TEST(Schedule, TheSameCaseAgainIsTakenFromTheCacheAndSaysTheSame)
{
  const auto &first = first_run();
  const auto again  = folder_of("run", "again", "");
  EXPECT_EQ(different(first, again), "");
  for (const auto &stage : stages_of(again)) {
    const auto name = stage.at("stage").get<std::string>();
    for (const char *kept : {"condensation", "contact upper", "bearing", "bite, section", "components"})
      if (name.rfind(kept, 0) == 0)
        EXPECT_TRUE(stage.at("cached").get<bool>()) << name;
  }
  EXPECT_EQ(stages_that_begin(again, "Fourier"), "")
      << "the Fourier solver's curve is kept, its rolls are not asked for";
}

// One run says both: with --fresh nothing is taken from the cache, and one thread computes what more did.
TEST(Schedule, ResultsAreTheSameFreshAndWithAnyNumberOfThreads)
{
  const auto &fresh = fresh_stiffness();
  EXPECT_EQ(different(kept_stiffness(), fresh), "");
  for (const auto &stage : stages_of(fresh))
    if (stage.at("stage").get<std::string>().rfind("contact", 0) == 0)
      EXPECT_FALSE(stage.at("cached").get<bool>());
}

TEST(Schedule, AGivenStiffnessIsNotSolved)
{
  first_run();  // what is not given comes from the cache
  const std::string K3 = " --set 'given.K3=4e4 kN/mm'", K5 = " --set 'given.K5=4e4 kN/mm'";
  const auto one_contact = folder_of("stiffness", "given-k3", K3 + " --set bite.arc=rigid");
  EXPECT_EQ(stages_that_begin(one_contact, "contact upper"), "");
  EXPECT_NE(stages_that_begin(one_contact, "contact lower"), "");
  const std::string Kzc = " --set 'given.Kzc1=2e4 kN/mm' --set 'given.Kzc2=2e4 kN/mm' --set 'given.Kzc3=2e4 kN/mm'"
                          " --set 'given.Kzc4=2e4 kN/mm'";
  const auto all        = folder_of("stiffness", "given-all", K3 + K5 + Kzc + " --set 'given.K4=5e3 kN/mm'");
  for (const char *stage : {"contact", "condensation", "Fourier", "bearing", "roller", "rings", "bite"})
    EXPECT_EQ(stages_that_begin(all, stage), "");
  const auto values = nlohmann::json::parse(mill::read_text(all + "/results.json")).at("values");
  EXPECT_DOUBLE_EQ(values.at("K_Zy").at("value").get<double>(), 4e10) << "both bearings of a backup roll";
}

TEST(Schedule, AStageSaysWhatItFactorised)
{
  int factorised = 0;
  for (const auto &stage : stages_of(fresh_stiffness())) {
    EXPECT_GE(stage.at("processor_seconds").get<double>(), 0);
    if (stage.at("stage").get<std::string>().rfind("condensation", 0) != 0)
      continue;
    for (const auto &f : stage.at("factorisations")) {
      factorised += f.at("times").get<int>();
      EXPECT_GT(f.at("nonzeros").get<double>(), f.at("order").get<double>());
      EXPECT_GT(f.at("flops").get<double>(), f.at("nonzeros").get<double>());
    }
  }
  EXPECT_EQ(factorised, 14) << "two rolls: three parities on the fine mesh, four on the coarse one";
}
