// millstand export modelica, matlab and statespace as a user meets them.
#include "app/export/exported_files.h"
#include "core/base/files.h"
#include "core/records/csv.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/refusal.h"
#include "tests/support/short_stand.h"
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

namespace fs = std::filesystem;
using namespace mill;

namespace {
std::string exchange_folder()
{
  static const std::string made = folder_with_short_stand("exchange");
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
  const auto matrices = exchanged_as("statespace", "");
  EXPECT_EQ(matrices.out, "out/stand-statespace: chain of six masses, case stand, pass 1\n") << matrices.err;
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
  const auto refused = [](const ExportFormat format, const std::string &output) {
    return refusal([&] { exchange_name(format, output); });
  };
  EXPECT_EQ(refused(ExportFormat::modelica, "my-stand.mo"),
            "-o my-stand.mo: a package of Modelica has the name of its file, and "
            "\"my-stand\" cannot be a name; take my_stand.mo");
  EXPECT_EQ(
      refused(ExportFormat::matlab, "end.m"),
      "-o end.m: a function of MATLAB has the name of its file, and \"end\" cannot be a name; take end_stand.m");
  EXPECT_EQ(refused(ExportFormat::matlab, "stand.mo"),
            "-o stand.mo: the name of a function of MATLAB ends with .m");
  EXPECT_EQ(usual_output(ExportFormat::modelica, "time"), "out/time_stand.mo");
  const std::string folder = exchange_folder() + "/";
  std::ofstream(folder + "mine.mo") << "package mine end mine;\n";
  const auto mine = exchanged_as("modelica", "-o mine.mo");
  EXPECT_EQ(mine.exit_code, 2);
  EXPECT_EQ(mine.err,
            "error: the file mine.mo exists and is not an earlier export of this case; choose another with -o, "
            "or give --force-overwrite\n");
  EXPECT_EQ(written("mine.mo"), "package mine end mine;\n");
  // Of another case whose name begins alike.
  std::ofstream(folder + "other.mo") << "package other \"case stand-2, pass 1\" end other;\n";
  EXPECT_NE(refusal([&] { require_own(ExportFormat::modelica, folder + "other.mo", "stand"); }), "accepted");
  EXPECT_EQ(refusal([&] { require_own(ExportFormat::modelica, folder + "other.mo", "stand-2"); }), "accepted");
  std::ofstream(folder + "own.mat") << "numbers of mine";
  EXPECT_EQ(refusal([&] {
              require_own_companions(ExportFormat::matlab, {{folder + "own.m", ""}, {folder + "own.mat", ""}});
            }),
            "the file " + folder +
                "own.mat, which belongs to it, exists and is not an earlier export; choose another "
                "with -o, or give --force-overwrite");
  fs::create_directories(folder + "letters");
  EXPECT_EQ(refusal([&] { require_own(ExportFormat::statespace, folder + "letters", "stand"); }), "accepted")
      << "an empty folder";
  std::ofstream(folder + "letters/a") << "a letter";
  EXPECT_EQ(refusal([&] { require_own(ExportFormat::statespace, folder + "letters", "stand"); }),
            folder + "letters exists and is not an earlier export of this case; choose another with -o, or give "
                     "--force-overwrite");
  const auto bearing = millstand("export matlab cases/bearing-266.toml -o b.m");
  EXPECT_EQ(bearing.err, "error: millstand export matlab: kind = \"bearing\" has no stand that a force can drive "
                         "(cases/bearing-266.toml); it exports cases of kind four-high, lumped and cluster\n");
}

TEST(ExchangeCommand, RefusesNamesThatHideALibrary)
{
  const auto refused = [](const ExportFormat format, const std::string &output) {
    return refusal([&] { exchange_name(format, output); });
  };
  EXPECT_EQ(refused(ExportFormat::modelica, "Modelica.mo"),
            "-o Modelica.mo: a package of Modelica that is called \"Modelica\" hides "
            "what has this name there; take Modelica_stand.mo");
  for (const char *name : {"modelica", "Complex", "ModelicaServices", "Real", "abs", "extends", "parameter"})
    EXPECT_NE(refused(ExportFormat::modelica, std::string(name) + ".mo"), "accepted") << name;
  for (const char *name : {"load", "expm", "size", "persistent"})
    EXPECT_NE(refused(ExportFormat::matlab, std::string(name) + ".m"), "accepted") << name;
  EXPECT_EQ(refused(ExportFormat::modelica, "Modelica_stand.mo"), "accepted");
  EXPECT_EQ(usual_output(ExportFormat::modelica, "Modelica"), "out/Modelica_stand.mo");
}

// The disk is full before the second file: no file of the export is there, and one of before is as it was.
TEST(ExchangeCommand, AFullDiskLeavesNoHalfOfAnExport)
{
  const std::string folder = exchange_folder();
  const auto limited       = [&](const std::string &arguments) {  // no file may be longer than 32 KiB
    return millstand(arguments, folder, "trap '' XFSZ; ulimit -f 64");
  };
  const auto files = [&] {
    std::set<std::string> names;
    for (const auto &file : fs::recursive_directory_iterator(folder))
      names.insert(file.path().string());
    return names;
  };
  const auto before  = files();
  const auto outcome = limited("export modelica stand.toml -o full.mo");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_EQ(outcome.err, "full_force.txt: error: cannot be written: File too large\n");
  EXPECT_EQ(files(), before);
  ASSERT_EQ(exchanged_as("modelica", "-o full.mo -q").exit_code, 0);
  const std::string package = written("full.mo"), series = written("full_force.txt");
  EXPECT_EQ(limited("export modelica stand.toml -o full.mo --set given.K3='5e3 kN/mm'").exit_code, 3);
  EXPECT_EQ(written("full.mo"), package);
  EXPECT_EQ(written("full_force.txt"), series);
}

// The function in Octave, where that is installed, moves as simulate does.
TEST(ExchangeCommand, TheFunctionMovesAsSimulateDoes)
{
  const auto matlab = exchanged_as("matlab", "-o octave_stand.m");
  EXPECT_EQ(matlab.out, "octave_stand.m, octave_stand.mat: chain of six masses, case stand, pass 1\n")
      << matlab.err;
  EXPECT_EQ(written("octave_stand.m").find("function [model, response] = octave_stand(time, force)\n"), 0u);
  if (std::system("octave-cli --version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "octave is not installed";
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
