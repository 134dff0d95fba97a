#include "tests/support/program.h"
#include <cstdlib>
#include <gtest/gtest.h>

// The manual as a user runs it, where the program it compares with is not installed.
namespace {
// No program can be started while this object exists.
class EmptyPath {
public:
  EmptyPath() : before_(std::getenv("PATH"))
  {
    ::setenv("PATH", "/nonexistent", 1);
  }
  ~EmptyPath()
  {
    ::setenv("PATH", before_.c_str(), 1);
  }
  EmptyPath(const EmptyPath &) = delete;

private:
  std::string before_;
};
}  // namespace

TEST(VerifyCommand, AMissingPeerProgramIsReported)
{
  const EmptyPath nothing;
  const auto outcome = millstand("verify -q peer-line love-patch");
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_NE(outcome.out.find("skipped: needs CalculiX: apt-get install calculix-ccx\n"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("1 of 1 cases pass, 4 of 4 judged checks; skipped: peer-line (needs CalculiX: "),
            std::string::npos)
      << outcome.out;
}

TEST(VerifyCommand, AnUnfinishedManualIsNotWritten)
{
  const EmptyPath nothing;
  const auto outcome = millstand("verify --markdown page.md", scratch("page"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("needs CalculiX: apt-get install calculix-ccx"), std::string::npos) << outcome.err;
}

TEST(VerifyCommand, TheSummaryCountsJudgedChecks)
{
  const auto outcome = millstand("verify -q film-slab-equation");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find(
                "1 of 1 cases pass, 8 of 8 judged checks; 2 values compared with a reference, not judged\n"),
            std::string::npos)
      << outcome.out;
}
