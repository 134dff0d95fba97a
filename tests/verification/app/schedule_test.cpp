#include "core/base/files.h"
#include "tests/support/coarse_run.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

// Stages run side by side; results must not know of it, and what is given or kept is not solved.
namespace {
nlohmann::json stages_of(const std::string &folder)
{
  return nlohmann::json::parse(mill::read_text(folder + "/run.json")).at("timings");
}

std::string stages_that_begin(const std::string &folder, const std::string &beginning)
{
  std::string lines;
  for (const auto &stage : stages_of(folder))
    if (const auto name = stage.at("stage").get<std::string>(); name.rfind(beginning, 0) == 0)
      lines += name + "; ";
  return lines;
}

// The demo stand on two threads, once for all tests of this file; from the cache what other tests have left there.
const std::string &first_run()
{
  static const std::string folder = coarse_run("run", "first", "--threads 2");
  return folder;
}

// Its stiffnesses, which have all kinds of stages but the components, whose sums are not the same to the bit
// anyway: on two threads from the cache, and on one thread with nothing from the cache.
const std::string &kept_stiffness()
{
  static const std::string folder = coarse_run("stiffness", "kept", "--threads 2");
  return folder;
}
const std::string &fresh_stiffness()
{
  static const std::string folder = coarse_run("stiffness", "fresh", "--fresh --threads 1");
  return folder;
}
}  // namespace

TEST(Schedule, TheSameCaseAgainIsTakenFromTheCacheWithTheSameResults)
{
  const auto &first = first_run();
  const auto again  = coarse_run("run", "again", "");
  EXPECT_EQ(difference_of_runs(first, again), "");
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
TEST(ScheduleLong, ResultsAreTheSameFreshAndWithAnyNumberOfThreads)
{
  const auto &fresh = fresh_stiffness();
  EXPECT_EQ(difference_of_runs(kept_stiffness(), fresh), "");
  for (const auto &stage : stages_of(fresh))
    if (stage.at("stage").get<std::string>().rfind("contact", 0) == 0)
      EXPECT_FALSE(stage.at("cached").get<bool>());
}

TEST(Schedule, AGivenStiffnessIsNotSolved)
{
  first_run();  // what is not given comes from the cache
  const std::string K3 = " --set 'given.K3=4e4 kN/mm'", K5 = " --set 'given.K5=4e4 kN/mm'";
  const auto one_contact = coarse_run("stiffness", "given-k3", K3 + " --set bite.arc=rigid");
  EXPECT_EQ(stages_that_begin(one_contact, "contact upper"), "");
  EXPECT_NE(stages_that_begin(one_contact, "contact lower"), "");
  const std::string Kzc = " --set 'given.Kzc1=2e4 kN/mm' --set 'given.Kzc2=2e4 kN/mm' --set 'given.Kzc3=2e4 kN/mm'"
                          " --set 'given.Kzc4=2e4 kN/mm'";
  const auto all        = coarse_run("stiffness", "given-all", K3 + K5 + Kzc + " --set 'given.K4=5e3 kN/mm'");
  for (const char *stage : {"contact", "condensation", "Fourier", "bearing", "roller", "rings", "bite"})
    EXPECT_EQ(stages_that_begin(all, stage), "");
  const auto values = nlohmann::json::parse(mill::read_text(all + "/results.json")).at("values");
  EXPECT_DOUBLE_EQ(values.at("K_Zy").at("value").get<double>(), 4e10) << "both bearings of a backup roll";
}

TEST(Schedule, TheLogOfAStageNamesItsFactorisations)
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
