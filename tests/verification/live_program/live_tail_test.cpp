#include "tests/support/live_chain.h"
#include "tests/support/live_program.h"
#include "tests/support/program.h"
#include "tests/support/raw_client.h"
#include <chrono>
#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <thread>

namespace {
constexpr double samples_per_second = 4000;

// A recorder that appends rows of time and force to a file.
class Recorder {
public:
  explicit Recorder(std::string path) : path_(std::move(path)), force_(comb_force(4096, 1500, 976217.5, 200)) {}
  void append(const std::string &line)
  {
    std::ofstream(path_, std::ios::app) << line << '\n';
  }
  void rows(const int n)
  {
    std::string text;
    for (int i = 0; i < n; ++i, ++next)
      text += fmt::format("{:.5f},{:.3f}\n", next / samples_per_second, force_[next % force_.size()]);
    std::ofstream(path_, std::ios::app) << text;
  }
  int next = 0;

private:
  std::string path_;
  Eigen::VectorXd force_;
};

bool has_processed(const LiveProgram &program, const long samples)
{
  for (const double end = steady_seconds() + 15; steady_seconds() < end;) {
    if (program.counter("samples_processed_total{channel=\"force\"}") == samples)
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}
}  // namespace

// Faults in the middle of a file that grows, through the built program: said, counted, gone on behind.
TEST(LiveTail, FaultsAreSaidAndCountedAndTheTwinGoesOn)
{
  const std::string folder = scratch("live-tail"), file = folder + "/daq.csv";
  std::ofstream(folder + "/chain.toml") << chain_case();
  Recorder recorder(file);
  recorder.append("time [s],force [N]");
  recorder.rows(8000);
  LiveProgram program(live_words({folder + "/chain.toml", "--input", "tail:" + file}), folder);
  ASSERT_TRUE(has_processed(program, 8000)) << program.printed();

  recorder.append("2.00000,976x17.5");
  ++recorder.next;
  recorder.rows(999);
  recorder.append("2.25000");
  ++recorder.next;
  recorder.rows(999);
  recorder.append("9000.0,976217.5");
  recorder.rows(1000);
  ASSERT_TRUE(has_processed(program, 10998)) << program.printed();
  recorder.append("time [s],force [N],speed [m/s]");
  for (int k = 0; k < 400; ++k)
    recorder.append(fmt::format("{:.5f},976217.5,2.5", k / samples_per_second));
  ASSERT_TRUE(has_processed(program, 400)) << program.printed();
  EXPECT_EQ(program.counter("lines_refused_total"), 3);
  EXPECT_EQ(program.end(SIGTERM), 128 + SIGTERM);

  const std::string printed = program.printed();
  for (const std::string &sentence : std::vector<std::string>{
           "refused: " + file +
               ":8002:9: '976x17.5' in column 'force' is not a number; leave the cell empty where there is no "
               "value\n",
           "refused: " + file +
               ":9002:1: this line has 1 cells, the columns are 2; a decimal comma needs ';' or tab between "
               "the columns\n",
           "refused: " + file +
               ":10002: the time is 8997.5 s ahead of that of the line before, and the next line does not "
               "follow it\n",
           "note: " + file + ":11003: other columns from here on; it is read as a new record\n"})
    EXPECT_NE(printed.find(sentence), std::string::npos) << sentence << printed;
}
