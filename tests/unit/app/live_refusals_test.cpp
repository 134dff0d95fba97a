#include "app/twin/live/live_command.h"
#include "core/model/case.h"
#include "tests/support/played_record.h"
#include "tests/support/program.h"
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

// What `millstand live` refuses to start with, and what it leaves as it was.
using namespace mill;
namespace fs = std::filesystem;

namespace {
const std::string stand = "cases/published-1400.toml";

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
}  // namespace

TEST(LiveRefusals, RefusesWhatCannotBeRun)
{
  const std::string folder = scratch("live-refused"), file = played_record(folder, 100);
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
  const std::string wrong = played_record(scratch("live-unit"), 100, "force [furlong]");
  EXPECT_EQ(refused(input(wrong)),
            wrong + ":1:1: channel \"force\" has the unit \"furlong\"; a force (N, kN, MN) is needed");
}

TEST(LiveRefusals, RefusesAPortThatIsTaken)
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
TEST(LiveRefusals, AFailedStartLeavesTheResponse)
{
  const TakenPort taken;
  const std::string folder = scratch("live-response"), file = played_record(folder, 4000), out = folder + "/rec",
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

TEST(LiveRefusals, DoesNotWriteThroughALink)
{
  const std::string folder = scratch("live-link"), file = played_record(folder, 4000), link = folder + "/twin.csv";
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
