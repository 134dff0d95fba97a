// millstand simulate --stream: any length of record, cut at a signal.
#include "app/command/linked_subjects.h"
#include "app/export/stream_command.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/model/case.h"
#include "core/records/csv.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/refusal.h"
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace fs = std::filesystem;
using namespace mill;

namespace {
std::string stream_folder()
{
  static const std::string made = [] {
    const std::string path = scratch("stream");
    EXPECT_EQ(millstand("new lumped -o " + path + "/stand.toml").exit_code, 0);
    return path;
  }();
  return made;
}

void write_record(const std::string &name, const int n, const bool gaps)
{
  std::ofstream file(stream_folder() + "/" + name);
  file << "time [s],force [kN]\n" << std::setprecision(17);
  for (int i = 0; i < n; ++i)
    if (!gaps || i % 1000 > 3)
      file << i * 1e-4 << "," << 976 + std::sin(0.02 * i) + 0.3 * std::sin(0.37 * i) << "\n";
}

nlohmann::json summary_in(const std::string &folder)
{
  return nlohmann::json::parse(read_text(stream_folder() + "/" + folder + "/summary.json"));
}
}  // namespace

TEST(StreamCommand, GivesTheRowsLevelsAndSpectraOfSimulate)
{
  for (const bool gaps : {false, true}) {
    write_record("force.csv", 6000, gaps);
    const auto whole = millstand("simulate stand.toml -q --force force.csv -o whole", stream_folder());
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    const auto streamed =
        millstand("simulate stand.toml -q --force force.csv --stream -o streamed", stream_folder());
    ASSERT_EQ(streamed.exit_code, 0) << streamed.err;
    for (const auto &[one, other] : {std::pair{"whole/response/pass-1.csv", "streamed/response.csv"},
                                     std::pair{"whole/response/pass-1-spectrum.csv", "streamed/spectrum.csv"}}) {
      const Table wanted = read_table(stream_folder() + "/" + one),
                  found  = read_table(stream_folder() + "/" + other);
      ASSERT_EQ(found.names, wanted.names);
      EXPECT_EQ(found.units, wanted.units);
      // Spectra take away the mean of the record or of the rows: the window carries it into the two lowest lines.
      const Eigen::Index skip = std::string(other) == "streamed/spectrum.csv" ? 3 : 0;
      for (std::size_t c = 0; c < wanted.columns.size(); ++c)
        EXPECT_TRUE(near(found.columns[c].tail(found.columns[c].size() - skip),
                         wanted.columns[c].tail(wanted.columns[c].size() - skip),
                         within(1e-6, "digits of the means", wanted.columns[c].cwiseAbs().maxCoeff())))
            << one << wanted.names[c];
    }
    const auto summary = summary_in("streamed");
    const auto results = nlohmann::json::parse(read_text(stream_folder() + "/whole/results.json")).at("values");
    EXPECT_TRUE(near(summary.at("peak_g").at("upper_work_roll").get<double>(),
                     results.at("pass 1.peak_g.upper_work_roll").at("value").get<double>(),
                     within_absolute(1e-9, "sums in another order, digits of the file")));
    EXPECT_TRUE(near(summary.at("rms_g").at("lower_work_roll").get<double>(),
                     results.at("pass 1.rms_g.lower_work_roll").at("value").get<double>(),
                     within_absolute(1e-9, "sums in another order, digits of the file")));
    EXPECT_EQ(summary.at("cut_by_signal"), 0);
  }
  for (const auto &file : fs::directory_iterator(stream_folder() + "/streamed"))
    EXPECT_EQ(file.path().string().find(".part"), std::string::npos) << file.path();
}

TEST(StreamCommand, ASignalLeavesAWholeShorterRecord)
{
  write_record("long.csv", 1000000, false);
  const std::string output = stream_folder() + "/cut";
  const pid_t child        = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    if (chdir(stream_folder().c_str()) == 0)
      execl(MILLSTAND_PROGRAM, "millstand", "simulate", "stand.toml", "-q", "--force", "long.csv", "--stream",
            "-o", "cut", static_cast<char *>(nullptr));
    _exit(99);
  }
  // As soon as the first rows stand in the file aside.
  const auto has_rows = [&] {
    std::error_code error;
    for (const auto &file : fs::directory_iterator(output, error))
      if (file.path().string().find("response.csv") != std::string::npos &&
          fs::file_size(file.path(), error) > 100000)
        return true;
    return false;
  };
  for (int i = 0; i < 3000 && !has_rows(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGTERM);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGTERM);
  const auto summary = summary_in("cut");
  EXPECT_EQ(summary.at("cut_by_signal"), SIGTERM);
  const double reached = summary.at("reached_s").get<double>();
  EXPECT_GT(reached, 0);
  EXPECT_LT(reached, 99);
  std::ifstream file(output + "/response.csv");
  std::string line, last;
  long long rows = -1;  // of the header
  while (std::getline(file, line)) {
    ++rows;
    last = line;
  }
  EXPECT_EQ(rows, summary.at("rows").get<long long>());
  EXPECT_EQ(std::count(last.begin(), last.end(), ','), 8);
  EXPECT_TRUE(
      near(std::stod(last), reached, within_absolute(1e-9, "time is printed with nine digits after the point")));
  EXPECT_EQ(read_text(output + "/response.csv").back(), '\n');
}

TEST(StreamCommand, SaysWhatItCannotDo)
{
  const std::string folder = stream_folder() + "/";
  const Case the_case      = read_case(folder + "stand.toml");
  CommandLine command;
  command.verb       = mill::Verb::simulate;
  command.quiet      = true;
  command.output     = folder + "refused";
  const auto refused = [&] { return refusal([&] { stream_command(command, the_case); }); };
  EXPECT_FALSE(is_streamed(command));
  command.stream = true;
  EXPECT_TRUE(is_streamed(command));
  EXPECT_EQ(refused(), "millstand simulate --stream needs the record: --force FILE");
  std::ofstream(folder + "bad.csv") << "time [s],force [kN]\n0,976\n1,nothing\n2,976\n";
  command.force = folder + "bad.csv";
  try {
    stream_command(command, the_case);
    ADD_FAILURE();
  } catch (const InputError &e) {
    EXPECT_EQ(e.problems.front().place.line, 3);
    EXPECT_EQ(e.problems.front().place.column, 3);
  }
  EXPECT_FALSE(fs::exists(command.output)) << "nothing is left";
  write_record("short.csv", 100, false);
  command.force = folder + "short.csv";
  command.pass  = "pass 9";
  EXPECT_EQ(refused(), "--pass \"pass 9\": the case has no pass of this name; it has \"pass 1\", \"pass 2\"");
  fs::create_directories(folder + "mine");
  std::ofstream(folder + "mine/letter") << "a";
  command.output = folder + "mine";
  EXPECT_EQ(refused(), folder +
                           "mine exists and holds no streamed response of this case; choose another with -o, or "
                           "give --force-overwrite");
}
