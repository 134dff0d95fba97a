#include "core/case/lumped_model_toml.h"
#include "core/model/case.h"
#include "tests/support/played_record.h"
#include "tests/support/program.h"
#include "twin/live/recording/npy_header.h"
#include "twin/records/raw_record.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace mill;
namespace fs = std::filesystem;

namespace {
const std::string stand = "cases/published-1400.toml";

std::string sidecar_of(const std::string &npy)
{
  return npy.substr(0, npy.size() - 4) + ".json";
}

// The program as a child that is killed.
class Child {
public:
  Child(const std::vector<std::string> &arguments, const std::string &log)
  {
    pid_ = fork();
    if (pid_ == 0) {
      const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
      dup2(file, 1);
      dup2(file, 2);
      std::vector<char *> words{const_cast<char *>(MILLSTAND_PROGRAM)};
      for (const std::string &word : arguments)
        words.push_back(const_cast<char *>(word.c_str()));
      words.push_back(nullptr);
      execv(MILLSTAND_PROGRAM, words.data());
      _exit(127);
    }
  }
  // True when it ended by itself before.
  bool kill_after(const double seconds)
  {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) == pid_)
      return true;
    kill(pid_, SIGKILL);
    waitpid(pid_, &status, 0);
    return false;
  }
  int end()
  {
    int status = 0;
    waitpid(pid_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  }

private:
  pid_t pid_;
};

// Numbers of all samples in the files of an ending; each file is one that the reader of records takes.
std::vector<std::int64_t> recorded(const std::string &folder, const std::string &ending)
{
  std::vector<std::int64_t> numbers;
  std::error_code not_made_yet;
  for (const auto &entry : fs::directory_iterator(folder, not_made_yet)) {
    const std::string path = entry.path().string();
    if (path.size() < ending.size() || path.compare(path.size() - ending.size(), ending.size(), ending) != 0)
      continue;
    if (entry.path().filename().string().find(".json.") != std::string::npos)
      continue;  // killed while the state or the description of a recording was written aside
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    live::NpyHeader header;
    if (bytes.empty() && ending != ".npy")
      continue;  // killed between its creation and the header
    EXPECT_TRUE(live::read_npy_header(bytes, header)) << path;
    EXPECT_GE(bytes.size(), header.bytes + std::size_t(header.rows) * header.row_bytes()) << path;
    if (ending == ".npy") {
      EXPECT_EQ(bytes.size(), header.bytes + std::size_t(header.rows) * header.row_bytes()) << path;
      EXPECT_EQ(twin::read_npy_record(path, {}).n_samples(), header.rows);
    }
    for (std::int64_t i = 0; i < header.rows; ++i) {
      std::uint64_t s = 0;
      for (std::size_t b = 0; b < 8; ++b)
        s |= std::uint64_t((unsigned char)bytes[header.bytes + std::size_t(i + 1) * header.row_bytes() - 8 + b])
             << 8 * b;
      numbers.push_back(std::int64_t(s));
    }
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}
}  // namespace

// A record through the verb: account, accelerations as a table, a recording that analyse reads.
TEST(LiveCommand, PlaysARecordAndRecordsIt)
{
  const std::string folder = scratch("live-plays"), file = played_record(folder, 4000), out = folder + "/rec";
  const Outcome outcome = millstand("live " + stand + " --input " + file + " --speed max --listen none --record " +
                                    out + " --response " + folder + "/twin.csv");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find(
                "force                            4000         4000            0            0            0"),
            std::string::npos)
      << outcome.out;
  std::ifstream table(folder + "/twin.csv");
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(table), {}, '\n'), 4001);
  const auto numbers = recorded(out, ".npy");
  ASSERT_EQ(numbers.size(), 4000u);
  EXPECT_EQ(numbers.back(), 3999);
  std::string npy;
  for (const auto &entry : fs::directory_iterator(out))
    if (entry.path().extension() == ".npy")
      npy = entry.path().string();
  EXPECT_TRUE(fs::exists(sidecar_of(npy)));
  const Outcome analysed = millstand("analyse " + npy + " -o " + folder + "/analysis");
  EXPECT_EQ(analysed.exit_code, 0) << analysed.err;
  const Outcome again =
      millstand("live " + stand + " --input " + file + " --speed max --listen none --record " + out);
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.out.find("goes on at s = 4000 of source \"" + file + "\"\n"), std::string::npos) << again.out;
  EXPECT_EQ(recorded(out, ".npy").size(), 4000u) << "nothing is there twice";
}

// Numbers of our own writing and of others: a sidecar whose start is a number does not end the program.
TEST(LiveCommand, IgnoresASidecarWhoseStartIsNotAText)
{
  const std::string folder = scratch("live-sidecar"), file = played_record(folder, 4000), out = folder + "/rec";
  const std::string command =
      "live " + stand + " --input " + file + " --speed max --listen none -q --record " + out;
  ASSERT_EQ(millstand(command).exit_code, 0);
  for (const auto &entry : fs::directory_iterator(out))
    if (entry.path().extension() == ".npy") {
      std::ifstream before(sidecar_of(entry.path().string()));
      nlohmann::json sidecar = nlohmann::json::parse(before);
      sidecar["start"]       = 1767607200;
      std::ofstream(sidecar_of(entry.path().string())) << sidecar.dump();
    }
  const Outcome again = millstand(command);
  EXPECT_EQ(again.exit_code, 0) << again.err;
}

TEST(LiveCommand, RefusesAFolderIntoWhichAnotherProgramRecords)
{
  const std::string folder = scratch("live-two"), file = played_record(folder, 4000), out = folder + "/rec";
  fs::create_directories(out);
  Child first({"live", stand, "--input", "tail:" + file, "--listen", "none", "--record", out},
              folder + "/log.txt");
  for (int i = 0; i < 200 && !fs::exists(out + "/state.json"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ASSERT_TRUE(fs::exists(out + "/state.json")) << "the first one records";
  const Outcome second =
      millstand("live " + stand + " --input " + file + " --speed max --listen none -q --record " + out);
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.err.find("the folder " + out +
                            " is in use: another millstand live records into it; choose another with --record"),
            std::string::npos)
      << second.err;
  first.kill_after(0);
  EXPECT_EQ(
      millstand("live " + stand + " --input " + file + " --speed max --listen none -q --record " + out).exit_code,
      0)
      << "a program that was killed holds nothing";
}

// The bands of [monitoring], for a stand of any kind: 400 Hz is not a mode of this stand and not in one of the
// usual bands.
TEST(LiveCommand, WatchesTheBandsOfMonitoring)
{
  const std::string folder = scratch("live-bands"), path = folder + "/mill.csv";
  {
    std::ofstream csv(path);
    csv << "time [s],upper_work_roll [g]\n";
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, 0.01);
    for (int k = 0; k < 72000; ++k) {
      const double t = k / 2000.0, level = t < 30 ? 0 : std::min(2.0, 0.005 * std::exp(4 * (t - 30)));
      csv << fmt::format("{:.4f},{:.5f}\n", t, noise(random) + level * std::sin(2 * M_PI * 411 * t));
    }
  }
  const auto alarms = [&](const std::string &set) {
    const Outcome outcome =
        millstand("live " + stand + " --input " + path + " --speed max --listen none " + set, ".");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    int n = 0;
    for (std::size_t position = 0;
         (position = outcome.out.find("alarm: chatter at 41", position)) != std::string::npos; ++position)
      ++n;
    return n;
  };
  EXPECT_EQ(alarms("--set 'monitoring.fifth_octave=[\"380 Hz\", \"440 Hz\"]'"), 1);
}

// What an earlier program left: springs that were adopted, an alarm that is open, or a file that is damaged.
TEST(LiveCommand, GoesOnFromItsStateOrSaysWhyNot)
{
  const std::string folder = scratch("live-state"), file = played_record(folder, 4000), out = folder + "/rec";
  const std::string command =
      "live " + stand + " --input " + file + " --speed max --listen none --limit \"0.01 m/s2\" --record " + out;
  const Outcome first = millstand(command);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_NE(first.out.find(" is above the limit of 0.01 m/s2 that is set for this mill"), std::string::npos)
      << first.out;
  const auto read = [&] {
    std::ifstream state(out + "/state.json");
    return nlohmann::json::parse(state);
  };
  const auto write = [&](const std::string &text) {
    std::ofstream state(out + "/state.json");
    state << text;
  };
  auto state = read();
  EXPECT_EQ(state["format"], 2);
  const auto open = state["comparison"]["book"]["open"];
  ASSERT_FALSE(open.empty());
  ASSERT_EQ(state["run"]["alarms"].size(), open.size());
  state["run"]["alarms"][0]["acknowledged"] = true;
  nlohmann::json springs                    = nlohmann::json::array();
  for (const Parameter &K : lumped_model_of(read_case(stand)).K)
    springs.push_back(
        {{"value", K.value}, {"error", 0.01}, {"measured", true}, {"method", "made"}, {"at", "976.2 kN"}});
  state["adopted"] = {{"file", "calibrated-20260105T100000Z.toml"},
                      {"source", "six masses of calibrated-20260105T100000Z.toml"},
                      {"damping", 0.02},
                      {"springs", springs}};
  write(state.dump());
  const Outcome again = millstand(command + " --set \"monitoring.limit=3 g\"");  // the same twin
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(
      again.out.find("springs and damping as adopted in calibrated-20260105T100000Z.toml; --fresh goes back to "
                     "those of the case\ngoes on at s = 4000 of source \"" +
                     file + "\"\n"),
      std::string::npos)
      << again.out;
  EXPECT_NE(again.out.find("(six masses of calibrated-20260105T100000Z.toml)\n"), std::string::npos) << again.out;
  EXPECT_EQ(read()["adopted"]["file"], "calibrated-20260105T100000Z.toml") << "and the next one too";
  EXPECT_EQ(read()["comparison"]["book"]["open"], open) << "the same alarms, with their numbers";
  EXPECT_EQ(read()["run"]["alarms"][0]["acknowledged"], true);

  state           = read();
  state["format"] = 1;
  write(state.dump());
  const Outcome older = millstand(command);
  EXPECT_EQ(older.exit_code, 0);
  EXPECT_NE(older.out.find("the stored state is of another version of this program; the twin starts without it\n"),
            std::string::npos)
      << older.out;
  write("{\"format\": 2, \"case_ha");
  const Outcome damaged = millstand(command);
  EXPECT_EQ(damaged.exit_code, 0);
  const std::string path = out + "/state.json";
  EXPECT_NE(damaged.out.find("the stored state " + path +
                             " is damaged and cannot be read; the twin starts without it, it is kept as " + path +
                             ".damaged"),
            std::string::npos)
      << damaged.out;
  EXPECT_TRUE(fs::exists(path + ".damaged"));
}

// Without what the comparison had learned its alarms have numbers from 1 again: a new one was not seen by anyone.
TEST(LiveCommand, AlarmsOfALostComparisonGoWithIt)
{
  const std::string folder = scratch("live-lost"), file = played_record(folder, 4000), out = folder + "/rec",
                    path = out + "/state.json";
  const std::string command =
      "live " + stand + " --input " + file + " --speed max --listen none --limit \"0.01 m/s2\" --record " + out;
  ASSERT_EQ(millstand(command).exit_code, 0);
  const auto read = [&] {
    std::ifstream state(path);
    return nlohmann::json::parse(state);
  };
  auto state = read();
  ASSERT_EQ(state["run"]["alarms"][0]["id"], 1);
  state["run"]["alarms"][0]["acknowledged"] = true;
  state["comparison"]["book"]["next"]       = "two";
  std::ofstream(path) << state.dump();
  const std::string longer = played_record(scratch("live-lost-longer"), 8000);
  fs::copy_file(longer, file, fs::copy_options::overwrite_existing);
  const Outcome again = millstand(command);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.out.find("what was learned of the mill cannot be used"), std::string::npos) << again.out;
  const auto alarms = read()["run"]["alarms"];
  ASSERT_FALSE(alarms.empty());
  EXPECT_EQ(alarms[0]["id"], 1);
  EXPECT_EQ(alarms[0]["acknowledged"], false);
}

// TW-29, short form: MILLSTAND_PASSES = 10 kills it fifty times.  Whenever it is killed the files of full minutes
// are whole and the part is readable; it goes on where its state was, and in the end every sample is recorded
// once.
TEST(LiveCommand, LosesNothingWhenItIsKilled)
{
  const char *const passes = std::getenv("MILLSTAND_PASSES");
  const int kills          = 5 * (passes ? std::max(1, std::atoi(passes)) : 1);
  const int samples        = 80000 + 20000 * kills;
  const std::string folder = scratch("live-killed"), file = played_record(folder, samples), out = folder + "/rec";
  const std::vector<std::string> command{
      "live", fs::absolute(stand).string(), "--input", file, "--speed", "20", "--listen", "none", "--record", out,
      "-q"};
  std::mt19937 random(29);
  std::int64_t before = 0;
  int killed          = 0;
  for (int k = 0; k < kills; ++k) {
    Child child(command, folder + "/log");
    const double after = 0.2 + 1.2 * double(random() % 1000) / 1000;
    if (child.kill_after(after))
      break;
    ++killed;
    const auto whole = recorded(out, ".npy");
    recorded(out, ".part");  // readable
    if (!whole.empty())
      EXPECT_GE(whole.back(), before) << "a finished file went";
    before = whole.empty() ? 0 : whole.back();
  }
  EXPECT_EQ(killed, kills);
  auto last = command;
  last[5]   = "max";
  Child child(last, folder + "/log");
  ASSERT_EQ(child.end(), 0);
  const auto numbers = recorded(out, ".npy");
  ASSERT_EQ(numbers.size(), std::size_t(samples));
  for (std::size_t i = 0; i < numbers.size(); ++i)
    ASSERT_EQ(numbers[i], std::int64_t(i));
  for (const auto &entry : fs::directory_iterator(out))
    EXPECT_NE(entry.path().extension(), ".part");
}
