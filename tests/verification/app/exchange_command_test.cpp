// millstand export modelica, matlab and statespace as a user meets them.
#include "core/records/csv.h"
#include "core/records/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

namespace fs = std::filesystem;
using namespace mill;

namespace {
// A lumped case with half a second of synthetic force.
std::string exchange_folder()
{
  static const std::string made = [] {
    std::string path = scratch("exchange");
    EXPECT_EQ(millstand("new lumped -o " + path + "/stand.toml").exit_code, 0);
    std::string text = read_text(path + "/stand.toml");
    text = std::regex_replace(text, std::regex("synthetic_duration = \"10 s\""), "synthetic_duration = \"0.5 s\"");
    write_atomically(path + "/stand.toml", text);
    return path;
  }();
  return made;
}

Outcome exchanged_as(const std::string &format, const std::string &more)
{
  return millstand("export " + format + " stand.toml " + more, exchange_folder());
}

std::string written(const std::string &name)
{
  return read_text(exchange_folder() + "/" + name);
}
}  // namespace

TEST(ExchangeCommand, WritesTheSameFilesEachTime)
{
  const auto modelica = exchanged_as("modelica", "");
  EXPECT_EQ(modelica.exit_code, 0) << modelica.err;
  EXPECT_EQ(modelica.out, "out/stand.mo, out/stand_force.txt: chain of six masses, case stand, pass 1\n");
  const std::string package = written("out/stand.mo"), series = written("out/stand_force.txt");
  EXPECT_EQ(package.find("within ;\npackage stand \""), 0u);
  EXPECT_EQ(exchanged_as("modelica", "-q").out, "") << "an earlier export of the case is replaced";
  EXPECT_EQ(written("out/stand.mo"), package);
  EXPECT_EQ(written("out/stand_force.txt"), series);
  const auto matlab = exchanged_as("matlab", "-o mill.m");
  EXPECT_EQ(matlab.out, "mill.m, mill.mat: chain of six masses, case stand, pass 1\n") << matlab.err;
  const std::string data = written("mill.mat");
  EXPECT_EQ(written("mill.m").find("function [model, response] = mill(time, force)\n"), 0u);
  EXPECT_EQ(exchanged_as("matlab", "-q -o mill.m").exit_code, 0);
  EXPECT_EQ(written("mill.mat"), data);
  const auto matrices = exchanged_as("statespace", "");
  EXPECT_EQ(matrices.out, "out/stand-statespace: chain of six masses, case stand, pass 1\n") << matrices.err;
  EXPECT_EQ(exchanged_as("statespace", "-q").exit_code, 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(exchange_folder() + "/out/stand-statespace"), {}), 10);
}

TEST(ExchangeCommand, OtherPassesFramesAndForcesPassTheCheckOfTheProgram)
{
  for (const char *choice : {"--set dynamics.force_meaning=disturbance --set dynamics.frame=closed",
                             "--set dynamics.force_meaning=published --pass 'pass 2'"}) {
    const auto outcome =
        exchanged_as("modelica", "-o other.mo -q --set given.C='1.9e5 N s/m' " + std::string(choice));
    EXPECT_EQ(outcome.exit_code, 0) << choice << outcome.err;
  }
}

TEST(ExchangeCommand, SaysWhatItCannotWrite)
{
  EXPECT_EQ(
      exchanged_as("modelica", "-o my-stand.mo").err,
      "error: -o my-stand.mo: a package of Modelica is called as its file, and \"my-stand\" is no name there; "
      "take my_stand.mo\n");
  EXPECT_EQ(exchanged_as("matlab", "-o end.m").err,
            "error: -o end.m: a function of MATLAB is called as its file, and "
            "\"end\" is no name there; take end_stand.m\n");
  EXPECT_EQ(exchanged_as("matlab", "-o stand.mo").err,
            "error: -o stand.mo: the name of a function of MATLAB ends with .m\n");
  std::ofstream(exchange_folder() + "/mine.mo") << "package mine end mine;\n";
  const auto mine = exchanged_as("modelica", "-o mine.mo");
  EXPECT_EQ(mine.exit_code, 2);
  EXPECT_EQ(mine.err,
            "error: the file mine.mo exists and is no earlier export of this case; choose another with -o, or "
            "give --force-overwrite\n");
  EXPECT_EQ(written("mine.mo"), "package mine end mine;\n");
  EXPECT_EQ(exchanged_as("modelica", "-q -o mine.mo --force-overwrite").exit_code, 0);
  std::ofstream(exchange_folder() + "/own.mat") << "numbers of mine";
  EXPECT_EQ(
      exchanged_as("matlab", "-o own.m").err,
      "error: the file own.mat, which belongs beside it, exists and is no earlier export; choose another with -o, "
      "or give --force-overwrite\n");
  EXPECT_FALSE(fs::exists(exchange_folder() + "/own.m"));
  fs::create_directories(exchange_folder() + "/letters");
  std::ofstream(exchange_folder() + "/letters/a") << "a letter";
  EXPECT_EQ(exchanged_as("statespace", "-o letters").err,
            "error: letters exists and is no earlier export of this case; choose another with -o, or give "
            "--force-overwrite\n");
  EXPECT_EQ(exchanged_as("simulink", "").exit_code, 2);
  const auto bearing = millstand("export matlab cases/bearing-266.toml -o b.m");
  EXPECT_EQ(bearing.err, "error: millstand export matlab: kind = \"bearing\" has no stand that vibrates by itself "
                         "(cases/bearing-266.toml); it exports cases of kind four-high and lumped\n");
}

// The function in Octave, where that is installed, moves as simulate does.
TEST(ExchangeCommand, TheFunctionMovesAsSimulateDoes)
{
  if (std::system("octave-cli --version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "octave is not installed";
  ASSERT_EQ(exchanged_as("matlab", "-q -o octave_stand.m").exit_code, 0);
  ASSERT_EQ(millstand("simulate stand.toml -q -o run", exchange_folder()).exit_code, 0);
  const Table response = read_table(exchange_folder() + "/run/response/pass-1.csv");
  const auto n         = response.column("time")->size();
  std::ofstream(exchange_folder() + "/drive.m")
      << "data = dlmread('run/response/pass-1.csv', ',', 1, 0);\n"
         "[model, response] = octave_stand(data(:, 1), data(:, end - 1) * 1e3);\n"
         "dlmwrite('octave.csv', [response.acceleration(:, 3:4) / 9.80665, response.load_cell / 1e3], "
         "'precision', 17);\n";
  ASSERT_EQ(std::system(("cd '" + exchange_folder() + "' && octave-cli drive.m >octave.txt 2>&1").c_str()), 0);
  std::ifstream file(exchange_folder() + "/octave.csv");
  const char *const columns[] = {"upper_work_roll", "lower_work_roll", "load_cell"};
  double worst                = 0;
  char comma                  = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      double value = 0;
      ASSERT_TRUE(file >> value);
      if (k < 2)
        file >> comma;
      const Eigen::VectorXd &column = *response.column(columns[k]);
      worst                         = std::max(worst, std::abs(value - column[i]) / column.cwiseAbs().maxCoeff());
    }
  EXPECT_LT(worst, 1e-9) << "samples of the record are output times";
}
