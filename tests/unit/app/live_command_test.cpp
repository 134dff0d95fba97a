#include "app/twin/live/live_command.h"
#include "core/case/lumped_model_toml.h"
#include "core/model/case.h"
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
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <random>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace mill;
namespace fs = std::filesystem;

namespace {
const std::string stand = "cases/published-1400.toml";

// A record of force and one roll, 1 kHz.
std::string record(const std::string &folder, const int samples, const std::string &head = "force [kN]")
{
  const std::string path = folder + "/mill.csv";
  std::ofstream file(path);
  file << "time [s]," << head << ",upper_work_roll [g]\n";
  for (int k = 0; k < samples; ++k)
    file << fmt::format("{:.3f},{:.3f},{:.4f}\n", k * 1e-3, 976 + 5 * std::sin(0.3 * k), 0.1 * std::sin(0.2 * k));
  return path;
}

// Errors of a case and its options are reported before anything runs.
std::string refused(const LiveOptions &options, const std::string &case_file = stand,
                    const std::vector<std::string> &sets = {}, const std::string &limit = "")
{
  CommandLine command;
  command.target = case_file;
  command.sets   = sets;
  command.quiet  = true;
  command.live   = options;
  command.limit  = limit;
  if (command.live.listen.empty())
    command.live.listen = "none";
  try {
    const Case the_case = read_case(case_file, sets);
    return "it ran to " + std::to_string(live_command(command, the_case));
  } catch (const InputError &error) {
    const Problem &problem = error.problems.front();
    return problem.place.line > 0 ? fmt::format("{}:{}:{}: {}", problem.place.file, problem.place.line,
                                                problem.place.column, problem.message)
                                  : problem.message;
  }
}

LiveOptions input(const std::string &text)
{
  LiveOptions options;
  options.input = text;
  return options;
}

std::string sidecar_of(const std::string &npy)
{
  return npy.substr(0, npy.size() - 4) + ".json";
}

// A port of this machine at which something else listens.
class TakenPort {
public:
  TakenPort() : file_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0))
  {
    sockaddr_in address{};
    address.sin_family      = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size          = sizeof address;
    auto *const place       = reinterpret_cast<sockaddr *>(&address);
    EXPECT_EQ(bind(file_, place, size), 0);
    EXPECT_EQ(listen(file_, 1), 0);
    EXPECT_EQ(getsockname(file_, place, &size), 0);
    port = std::to_string(ntohs(address.sin_port));
  }
  ~TakenPort()
  {
    close(file_);
  }
  TakenPort(const TakenPort &)            = delete;
  TakenPort &operator=(const TakenPort &) = delete;
  std::string port;

private:
  int file_;
};

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

TEST(LiveCommand, RefusesWhatCannotBeRun)
{
  const std::string folder = scratch("live-refused"), file = record(folder, 100);
  EXPECT_EQ(refused(input(file), "cases/cold-strip.toml"), "millstand live: the case cases/cold-strip.toml has no "
                                                           "chain of six masses; name a case of kind four-high or "
                                                           "chatter, or of kind lumped with [given]");
  EXPECT_EQ(refused(input(file), "cases/four-high-1400.toml", {"dynamics.modal_damping=0 %"}),
            "millstand live: the case has no damping, so that the twin would never forget how it started; give "
            "dynamics.modal_damping, for example --set dynamics.modal_damping=\"1 %\"");
  EXPECT_EQ(
      refused(input("opc:mill")),
      "--input \"opc:mill\": a record (FILE.csv), a growing one (tail:FILE.csv), - for lines on standard input, "
      "tcp:127.0.0.1:8461 or mqtt:127.0.0.1:1883/STAND is needed");
  EXPECT_EQ(refused(input("nowhere.csv")), "the file nowhere.csv does not exist");
  EXPECT_EQ(refused(input("tcp:8461")),
            "--input \"8461\": an address and a port are needed, for example --input tcp:127.0.0.1:8461");
  EXPECT_EQ(refused(input("tcp:0.0.0.0:0")),
            "--input tcp:0.0.0.0:0: this address is reached from other machines, so a "
            "token is needed that the senders know: --token-file FILE");
  LiveOptions options = input(file);
  options.speed       = "fast";
  EXPECT_EQ(refused(options), "--speed \"fast\": a number above zero (1 is real time) or max is needed");
  options       = input("-");
  options.speed = "2";
  EXPECT_EQ(refused(options),
            "--speed belongs to a record that is played (--input FILE.csv); other sources set their own pace");
  options      = input(file);
  options.keep = "24h";
  EXPECT_EQ(refused(options),
            "--keep sets how much of a recording is kept; name the folder of the recording with --record");
  EXPECT_EQ(refused(input(file), stand, {}, "2 mm/s"),
            "--limit \"2 mm/s\": an acceleration above zero is needed, for example --limit \"2 g\"");
  options          = input(file);
  options.response = file;
  EXPECT_EQ(refused(options),
            "the file " + file + " exists; choose another with --response, or give --force-overwrite");
  const std::string wrong = record(scratch("live-unit"), 100, "force [furlong]");
  EXPECT_EQ(refused(input(wrong)),
            wrong + ":1:1: channel \"force\" has the unit \"furlong\"; a force (N, kN, MN) is needed");
}

TEST(LiveCommand, RefusesAPortThatIsTaken)
{
  const TakenPort taken;
  EXPECT_EQ(refused(input("tcp:127.0.0.1:" + taken.port)),
            "--input tcp:127.0.0.1:" + taken.port +
                ": the port is taken, perhaps by another millstand live; choose another one");
  LiveOptions options = input("-");
  options.listen      = "127.0.0.1:" + taken.port;
  EXPECT_EQ(refused(options).rfind("--listen: port " + taken.port, 0), 0u);
}

// A start that fails leaves the file of --response as it was, also where the twin goes on from a state: its source
// begins before any port is open.
TEST(LiveCommand, AFailedStartLeavesTheResponse)
{
  const TakenPort taken;
  const std::string folder = scratch("live-response"), file = record(folder, 4000), out = folder + "/rec",
                    old = folder + "/old.csv", made = folder + "/made.csv";
  ASSERT_EQ(
      millstand("live " + stand + " --input " + file + " --speed max --listen none -q --record " + out).exit_code,
      0);
  std::ofstream(old) << "of last week";
  const std::string command = "live " + stand + " --input tcp:127.0.0.1:" + taken.port +
                              " --listen none -q --record " + out + " --response ";
  const Outcome again = millstand(command + old + " --force-overwrite");
  EXPECT_EQ(again.exit_code, 2) << again.err;
  EXPECT_NE(again.err.find(old + " is unchanged"), std::string::npos) << again.err;
  std::ifstream kept(old);
  EXPECT_EQ(std::string((std::istreambuf_iterator<char>(kept)), {}), "of last week");
  for (const char *more : {"", " --force-overwrite"}) {
    EXPECT_EQ(millstand(command + made + more).exit_code, 2);
    EXPECT_FALSE(fs::exists(made)) << "the next start would find a file that exists";
  }
}

// A record through the verb: account, accelerations as a table, a recording that analyse reads.
TEST(LiveCommand, PlaysARecordAndRecordsIt)
{
  const std::string folder = scratch("live-plays"), file = record(folder, 4000), out = folder + "/rec";
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
  const std::string folder = scratch("live-sidecar"), file = record(folder, 4000), out = folder + "/rec";
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
  const std::string folder = scratch("live-two"), file = record(folder, 4000), out = folder + "/rec";
  fs::create_directories(out);
  Child first({"live", stand, "--input", "tail:" + file, "--listen", "none", "--record", out},
              folder + "/log.txt");
  for (int i = 0; i < 200 && !fs::exists(out + "/state.json"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ASSERT_TRUE(fs::exists(out + "/state.json")) << "the first one records";
  LiveOptions second = input(file);
  second.record      = out;
  EXPECT_EQ(refused(second),
            "the folder " + out +
                " is in use: another millstand live records into it; choose another with --record");
  first.kill_after(0);
  EXPECT_EQ(
      millstand("live " + stand + " --input " + file + " --speed max --listen none -q --record " + out).exit_code,
      0)
      << "a program that was killed holds nothing";
}

TEST(LiveCommand, DoesNotWriteThroughALink)
{
  const std::string folder = scratch("live-link"), file = record(folder, 4000), link = folder + "/twin.csv";
  std::ofstream(folder + "/thesis.txt") << "mine";
  fs::create_symlink("thesis.txt", link);
  for (const char *more : {"", " --force-overwrite"}) {
    const Outcome outcome = millstand("live " + stand + " --input " + file +
                                      " --speed max --listen none -q --response " + link + more);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(link +
                               " is a symbolic link, and live does not write through it; name the file itself "
                               "with --response"),
              std::string::npos)
        << outcome.err;
  }
  std::ifstream target(folder + "/thesis.txt");
  EXPECT_EQ(std::string((std::istreambuf_iterator<char>(target)), {}), "mine");
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
  const std::string folder = scratch("live-state"), file = record(folder, 4000), out = folder + "/rec";
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
  const std::string folder = scratch("live-lost"), file = record(folder, 4000), out = folder + "/rec",
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
  const std::string longer = record(scratch("live-lost-longer"), 8000);
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
  const std::string folder = scratch("live-killed"), file = record(folder, samples), out = folder + "/rec";
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
