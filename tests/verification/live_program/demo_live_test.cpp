#include "tests/support/live_program.h"
#include "tests/support/program.h"
#include "tests/support/raw_client.h"
#include "tests/support/slowness.h"
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace fs = std::filesystem;

namespace {
const fs::path broker_program = fs::exists("/usr/sbin/mosquitto") ? "/usr/sbin/mosquitto" : "/usr/bin/mosquitto";

bool wait_until(const std::function<bool()> &holds, const double seconds)
{
  for (const double end = steady_seconds() + slowness() * seconds; steady_seconds() < end;) {
    if (holds())
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

long number_in(const fs::path &file)
{
  long number = 0;
  std::ifstream(file) >> number;
  return number;
}

int how_often(const std::string &text, const std::string &part)
{
  int n = 0;
  for (auto position = text.find(part); position != std::string::npos; position = text.find(part, position + 1))
    ++n;
  return n;
}
}  // namespace

// The demonstration through a private broker: what it sends is what arrives, and after the broker was started
// again the twin hears the next sender.
TEST(DemoLive, EverySampleComesThroughTheBroker)
{
  if (!fs::exists(broker_program) || std::system("command -v mosquitto_pub >/dev/null") != 0)
    GTEST_SKIP() << "mosquitto or mosquitto-clients is not installed; scripts/install-deps tests installs it";
  const std::string folder = scratch("demo-live"), port = std::to_string(20000 + getpid() % 20000);
  setenv("MILLSTAND", MILLSTAND_PROGRAM, 1);
  setenv("DEMO_SECONDS", "3", 1);
  setenv("DEMO_FOLDER", folder.c_str(), 1);
  setenv("DEMO_PORT", port.c_str(), 1);
  // A program built with a sanitizer does not keep up with real time: the mill is as much slower.
  setenv("DEMO_SLOWER", std::to_string(slowness()).c_str(), 1);
  LiveProgram demo({"/bin/bash", MILLSTAND_SOURCE_DIR "/scripts/demo-live", "--mqtt", "--listen", "127.0.0.1:0"},
                   folder);
  const std::string processed = "samples_processed_total{channel=\"force\"}";
  EXPECT_TRUE(wait_until([&] { return demo.counter(processed) >= 12000; }, 20)) << demo.printed();

  kill(pid_t(number_in(folder + "/broker.pid")), SIGTERM);
  ASSERT_TRUE(wait_until([&] { return how_often(demo.printed(), "connection to the broker lost") == 1; }, 10));
  const pid_t broker = fork();
  if (broker == 0) {
    std::freopen("/dev/null", "w", stderr);
    execl(broker_program.c_str(), "mosquitto", "-c", (folder + "/broker.conf").c_str(), nullptr);
    _exit(127);
  }
  EXPECT_TRUE(wait_until([&] { return how_often(demo.printed(), ": connected") == 2; }, 15)) << demo.printed();
  std::this_thread::sleep_for(std::chrono::milliseconds(300 * slowness()));  // its subscription
  std::ofstream lines(folder + "/more.jsonl");
  lines << "{\"millstand\":1,\"rate\":4000,\"units\":{\"force\":\"N\",\"upper_work_roll\":\"m/s2\","
           "\"lower_work_roll\":\"m/s2\"},\"source\":\"demo\"}\n";
  for (int s = 12000; s < 14000; s += 1000) {
    std::string force = "976200";
    for (int i = 1; i < 1000; ++i)
      force += ",976200";
    lines << fmt::format("{{\"s\":{},\"force\":[{}],\"upper_work_roll\":[0],\"lower_work_roll\":[0]}}\n", s,
                         force);
  }
  lines.close();
  EXPECT_EQ(std::system(("mosquitto_pub -h 127.0.0.1 -p " + port + " -t millstand/demo/in -q 1 -l <" + folder +
                         "/more.jsonl")
                            .c_str()),
            0);
  EXPECT_TRUE(wait_until([&] { return demo.counter(processed) >= 14000; }, 10)) << demo.printed();
  EXPECT_EQ(demo.end(SIGINT), 128 + SIGINT);
  kill(broker, SIGTERM);
  waitpid(broker, nullptr, 0);
  for (const char *channel : {"force", "upper_work_roll", "lower_work_roll"})
    EXPECT_NE(demo.printed().find(
                  fmt::format("{:<24} {:>12} {:>12} {:>12} {:>12} {:>12}\n", channel, 14000, 14000, 0, 0, 0)),
              std::string::npos)
        << demo.printed();
  EXPECT_NE(demo.printed().find("0 gaps, 0 samples doubled, 0 lines refused"), std::string::npos);
}
