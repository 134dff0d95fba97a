#include "app/twin/live/response_file.h"
#include "core/base/errors.h"
#include "tests/support/program.h"
#include <csignal>
#include <filesystem>
#include <gtest/gtest.h>
#include <sys/resource.h>

using namespace mill;

// A disk that is full, in the form of a limit on the size of files: said with the block that does not fit, not
// weeks later at the end of the program.
TEST(ResponseFile, SaysAtOnceThatTheDiskIsFull)
{
  const std::string path = scratch("response-full") + "/twin.csv";
  live::LiveSource source;
  source.rate   = 1000;
  source.places = {"upper_work_roll"};
  live::LiveBlock block;
  block.rate      = 1000;
  block.force     = Eigen::VectorXd::Constant(1000, 1e6);
  block.simulated = Eigen::MatrixXd::Constant(1000, 1, 0.125);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{30000, before.rlim_max};  // a block has 1000 rows of "123,0.123,1000000,0.125,0": some 25 kB
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  ResponseFile file(path, false, false);
  file.begin(source);
  file.take(block);
  EXPECT_EQ(file.problem(), "");
  block.first = 1000;
  file.take(block);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(file.problem(), path + " cannot be written: File too large; it ends there, the twin goes on");
  EXPECT_THROW(file.finish(), SystemError);
}
