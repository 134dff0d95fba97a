#include "core/base/files.h"
#include "tests/support/program.h"
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>

// The same rows by every engine, with the real GNU parallel and a real Slurm of one node.
namespace {
const std::string one_node_slurm = MILLSTAND_SOURCE_DIR "/tests/support/one-node-slurm";

void expect_done(const std::string &arguments, const std::string &before = "true")
{
  const Outcome outcome = millstand(arguments, MILLSTAND_SOURCE_DIR, before);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.err;
}

// A study of chains in a folder of its own, not run yet.
std::string new_study(const std::string &folder)
{
  expect_done(
      "study new cases/published-1400.toml --set 'given.K4=0 N/m' --model quick --method monte-carlo --samples "
      "800 --vary 'given.K1~normal(10 %)' --vary 'given.K7~normal(10 %)' --watch f1 --watch f2 -q -o " +
      folder);
  return folder;
}

std::string dump(const std::string &folder)
{
  expect_done("study merge " + folder);
  return mill::read_text(folder + "/results.csv");
}

std::string dump_of_here()
{
  static const std::string text = [] {
    const std::string folder = new_study(scratch("engine-here") + "/study");
    expect_done("study run " + folder + " -q --jobs 2");
    return dump(folder);
  }();
  return text;
}

TEST(StudyEngines, HereComputesEveryRow)
{
  const std::string rows = dump_of_here();
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 801);
}

TEST(StudyEngines, ParallelGivesTheSameBytes)
{
  if (shell("command -v parallel", "/").exit_code != 0)
    GTEST_SKIP() << "GNU parallel is not installed (scripts/install-deps tests)";
  const std::string folder = new_study(scratch("engine-parallel") + "/study");
  const Outcome outcome    = millstand("study run \"" + folder + "\" --engine parallel --jobs 2 -q");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(dump(folder), dump_of_here());
}

TEST(StudyEnginesLong, SlurmGivesTheSameBytesAfterKillsOfItsDaemons)
{
  const std::string cluster = scratch("one-node-slurm");
  const Outcome started     = shell(one_node_slurm + " start " + cluster, "/");
  if (started.exit_code == 77)
    GTEST_SKIP() << started.out;
  ASSERT_EQ(started.exit_code, 0) << started.out << started.err;
  const std::string conf   = "export SLURM_CONF=" + cluster + "/slurm.conf";
  const std::string folder = new_study(scratch("engine-slurm") + "/study");
  expect_done("study run " + folder + " --engine slurm --jobs 3 -q", conf);
  // Controller, node daemon and a worker are killed; the daemons come back and the array goes on.
  shell(conf + "; sleep 1; kill -9 $(cat " + cluster + "/slurmctld.pid) $(cat " + cluster +
            "/slurmd.pid); pgrep -f 'study work " + folder +
            "' | head -1 | xargs -r kill -9; slurmctld -f $SLURM_CONF; "
            "slurmd -f $SLURM_CONF; for i in $(seq 60); do sleep 0.5; [ -z \"$(squeue -h)\" ] && break; done",
        "/");
  expect_done("study run " + folder + " -q");
  EXPECT_EQ(dump(folder), dump_of_here());
  shell(one_node_slurm + " stop " + cluster, "/");
}

TEST(StudyEngines, DryRunPrintsAShortScript)
{
  const std::string folder = new_study(scratch("engine-dry") + "/study");
  for (const char *engine : {"parallel", "slurm"}) {
    const Outcome outcome = millstand("study run " + folder + " --dry-run --engine " + engine);
    EXPECT_EQ(outcome.exit_code, 0);
    const auto lines = std::count(outcome.out.begin(), outcome.out.end(), '\n');
    EXPECT_GE(lines, 3) << outcome.out;
    EXPECT_LE(lines, 10) << outcome.out;
    EXPECT_NE(outcome.out.find("study work"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("given.K1"), std::string::npos) << "no parameter passes a shell";
  }
}

TEST(StudyEngines, AnEngineThatIsNotInstalledIsNamed)
{
  const std::string folder = new_study(scratch("engine-absent") + "/study");
  const std::pair<const char *, const char *> absent[]{
      {"slurm",
       "--engine slurm needs sbatch, which is not installed on this machine: apt-get install slurm-client; "
       "--engine here works without it"},
      {"parallel",
       "--engine parallel needs GNU parallel, which is not installed: apt-get install parallel; --engine "
       "here works without it"}};
  for (const auto &[engine, message] : absent) {
    const Outcome outcome = millstand("study run " + folder + " --engine " + engine, MILLSTAND_SOURCE_DIR,
                                      "export PATH=/bin-not-there");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  }
}
}  // namespace
