#include "core/base/files.h"
#include "tests/support/program.h"
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

// What happens to a study when disk, processes or files fail: nothing that is finished is lost or doubled.
namespace {
namespace fs = std::filesystem;

void expect_done(const std::string &arguments)
{
  const Outcome outcome = millstand(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.err;
}

std::string new_study(const std::string &folder, const int rows)
{
  expect_done(
      "study new cases/published-1400.toml --set 'given.K4=0 N/m' --model quick --method monte-carlo --samples " +
      std::to_string(rows) +
      " --vary 'given.K1~normal(10 %)' --vary 'given.K7~normal(10 %)' --watch f1 --watch f2 -q -o " + folder);
  return folder;
}

std::string dump(const std::string &folder)
{
  expect_done("study merge " + folder);
  return mill::read_text(folder + "/results.csv");
}

std::vector<std::string> parts_in(const std::string &folder)
{
  std::vector<std::string> names;
  for (const auto &file : fs::directory_iterator(folder))
    if (file.path().filename().string().find(".part") != std::string::npos)
      names.push_back(file.path().filename());
  return names;
}

TEST(StudyFaults, TwoRunsAtOnceGiveTheSameBytes)
{
  const std::string folder = scratch("study-two-runs");
  new_study(folder + "/one", 400);
  fs::copy(folder + "/one", folder + "/two", fs::copy_options::recursive);
  expect_done("study run " + folder + "/one -q");
  const std::string run = "'" MILLSTAND_PROGRAM "' study run '" + folder + "/two' -q";
  const Outcome both =
      shell(run + " & first=$!; " + run + "; second=$?; wait $first && exit $second", MILLSTAND_SOURCE_DIR);
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_EQ(dump(folder + "/two"), dump(folder + "/one"));
  EXPECT_TRUE(parts_in(folder + "/two").empty());
}

TEST(StudyFaults, AFullDiskKeepsWhatIsFinished)
{
  const std::string folder = scratch("study-full-disk");
  new_study(folder + "/whole", 1500);
  fs::create_directories(folder + "/small");
  // A file system of 176 kB in a name space of this shell: the design fits, its rows do not.
  const Outcome cut =
      shell("unshare -m sh -c 'mount -t tmpfs -o size=176k none small || exit 77; cp -r whole/. small; "
            "\"" MILLSTAND_PROGRAM "\" study work small --shard 1/1 -q; code=$?; cp -r small/. after; "
            "exit $code'",
            folder);
  if (cut.exit_code == 77 || cut.err.find("unshare") != std::string::npos)
    GTEST_SKIP() << "a small file system cannot be mounted here: " << cut.err;
  EXPECT_EQ(cut.exit_code, 3) << cut.err;
  EXPECT_NE(cut.err.find("what was finished before is kept: make room and run the same command again"),
            std::string::npos)
      << cut.err;
  const Outcome status = millstand("study status " + folder + "/after");
  EXPECT_EQ(status.out.find("\n0 of 1500"), std::string::npos) << "some rows were finished\n" << status.out;
  EXPECT_EQ(status.out.find("\n1500 of 1500"), std::string::npos) << status.out;
  expect_done("study run " + folder + "/after -q");
  expect_done("study run " + folder + "/whole -q");
  EXPECT_EQ(dump(folder + "/after"), dump(folder + "/whole"));
}

TEST(StudyFaults, ADamagedMergedRowIsComputedOnceMoreAndThenRight)
{
  const std::string folder = scratch("study-damaged") + "/study";
  new_study(folder, 200);
  expect_done("study run " + folder + " -q");
  const std::string whole = dump(folder);
  // One bit of a result in finished.db; the file of the worker is gone.
  fs::remove_all(folder + "/rows");
  std::string bytes = mill::read_text(folder + "/finished.db");
  const auto line   = whole.find("\n1,");  // 1,key,K1,K7,f1,f2,failure
  std::size_t cell  = line;
  for (int i = 0; i < 4; ++i)
    cell = whole.find(',', cell + 1);
  const double f1  = std::stod(whole.substr(cell + 1));
  const auto place = bytes.find(std::string(reinterpret_cast<const char *>(&f1), sizeof f1));
  ASSERT_NE(place, std::string::npos);
  bytes[place] ^= 1;
  mill::write_atomically(folder + "/finished.db", bytes);
  const Outcome resumed = millstand("study run " + folder + " -q");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_NE(resumed.err.find("with a wrong checksum"), std::string::npos) << resumed.err;
  EXPECT_EQ(dump(folder), whole);
  const Outcome again = millstand("study run " + folder);
  EXPECT_NE(again.out.find("all rows are finished"), std::string::npos) << again.out << again.err;
  EXPECT_EQ(again.err, "") << "the file was mended";
}

TEST(StudyFaults, WhatAKilledMergeLeavesIsRemovedByTheNext)
{
  const std::string folder = scratch("study-merge-part") + "/study";
  new_study(folder, 20);
  expect_done("study run " + folder + " -q");
  mill::write_atomically(folder + "/copy", "half a file");
  fs::rename(folder + "/copy", folder + "/finished.db.0123456789abcdef.part");
  expect_done("study merge " + folder);
  EXPECT_TRUE(parts_in(folder).empty());
}

TEST(StudyFaults, WorkersEndWithTheirCommand)
{
  const std::string folder = scratch("study-orphans") + "/study";
  new_study(folder, 3000);
  // The command is killed; its workers end what is under way and no more.
  const Outcome ended =
      shell("'" MILLSTAND_PROGRAM "' study run '" + folder +
                "' --jobs 2 -q & run=$!; sleep 0.3; kill -9 $run; for i in $(seq 100); do pgrep -f "
                "\"study wor[k] " +  // not this shell itself
                folder +
                " \" > /dev/null || exit 0; sleep 0.1; done; exit 1",
            "/");
  EXPECT_EQ(ended.exit_code, 0) << "a worker goes on";
  const Outcome status = millstand("study status " + folder);
  EXPECT_EQ(status.out.find("\n3000 of 3000"), std::string::npos) << status.out;
  EXPECT_NE(status.out.find(", 0 of them begun"), std::string::npos) << "nothing was cut\n" << status.out;
}

TEST(StudyFaults, AFolderThatCannotBeWrittenIsNamed)
{
  const std::string folder = scratch("study-unwritable");
  mill::write_atomically(folder + "/file", "text");
  const Outcome outcome = millstand("study new cases/published-1400.toml --model quick --samples 4 --vary "
                                    "'given.K1~normal(1 %)' --watch f1 -q -o " +
                                    folder + "/file/study");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find(folder + "/file/study"), std::string::npos) << outcome.err;
}
}  // namespace
