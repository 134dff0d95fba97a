// millstand export fmu as a user meets it.
#include "core/base/files.h"
#include "core/records/csv.h"
#include "dynamics/fmu/archive.h"
#include "dynamics/fmu/runtime/fmi2_interface.h"
#include "dynamics/fmu/runtime/modal_system.h"
#include "dynamics/fmu/runtime/model_data.h"
#include "dynamics/fmu/runtime/variables.h"
#include "dynamics/fmu/unpacked_unit.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/short_stand.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <regex>

namespace fs = std::filesystem;
using namespace mill;

namespace {
std::string folder()
{
  static const std::string made = folder_with_short_stand("export");
  return made;
}

Outcome exported(const std::string &more)
{
  return millstand("export fmu stand.toml " + more, folder());
}

std::string entry(const std::string &archive, const std::string &name)
{
  for (const auto &file : fmu::entries_of(read_text(archive)))
    if (file.name == name)
      return file.bytes;
  ADD_FAILURE() << archive << " has no " << name;
  return "";
}
}  // namespace

TEST(ExportCommand, WritesTheSameArchiveOfEitherVersionEachTime)
{
  const auto first = exported("-o a.fmu");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.out.find("a.fmu: chain of six masses, FMI 2.0 co-simulation, Linux"), 0u) << first.out;
  EXPECT_EQ(exported("-o b.fmu -q").exit_code, 0);
  EXPECT_EQ(read_text(folder() + "/a.fmu"), read_text(folder() + "/b.fmu"));
  EXPECT_EQ(exported("-o c.fmu --fmi 3 -q").out, "");
  EXPECT_NE(entry(folder() + "/c.fmu", "modelDescription.xml").find("fmiVersion=\"3.0\""), std::string::npos);
  EXPECT_EQ(exported("-o a.fmu --fmi 3").exit_code, 0) << "an earlier export of the case is replaced";
  for (const auto &file : fs::directory_iterator(folder()))
    EXPECT_EQ(file.path().string().find(".part"), std::string::npos) << file.path();
  EXPECT_EQ(exported("").out.find("out/stand.fmu: "), 0u);
  EXPECT_TRUE(fs::exists(folder() + "/out/stand.fmu"));
}

// The same force through simulate and through the unit.
TEST(ExportCommand, TheUnitMovesAsSimulateDoes)
{
  ASSERT_EQ(exported("-o moves.fmu -q").exit_code, 0);
  ASSERT_EQ(millstand("simulate stand.toml -q -o run", folder()).exit_code, 0);
  const Table response = read_table(folder() + "/run/response/pass-1.csv");
  const auto model     = fmu::read_model(entry(folder() + "/moves.fmu", "resources/model.json"));
  const fmu::UnpackedUnit unit(read_text(folder() + "/moves.fmu"), "stand", 2);
  const fmi2CallbackFunctions callbacks{};
  const auto variables = fmu::variables_of(model);
  const auto value_of  = [&](const std::string &name) {
    for (std::size_t i = 0; i < variables.size(); ++i)
      if (variables[i].name == name)
        return unsigned(i);
    ADD_FAILURE() << name;
    return 0u;
  };
  const fmi2Component c = unit.function<decltype(&fmi2Instantiate)>("fmi2Instantiate")(
      "stand", fmi2CoSimulation, model.guid.c_str(), unit.resources().c_str(), &callbacks, 0, 0);
  ASSERT_TRUE(c);
  const unsigned use = value_of("use_stored_force");
  const int yes      = 1;
  EXPECT_EQ(unit.function<decltype(&fmi2SetBoolean)>("fmi2SetBoolean")(c, &use, 1, &yes), 0);
  EXPECT_EQ(unit.function<decltype(&fmi2SetupExperiment)>("fmi2SetupExperiment")(c, 0, 0, 0, 0, 0), 0);
  EXPECT_EQ(unit.function<decltype(&fmi2EnterInitializationMode)>("fmi2EnterInitializationMode")(c), 0);
  EXPECT_EQ(unit.function<decltype(&fmi2ExitInitializationMode)>("fmi2ExitInitializationMode")(c), 0);
  const unsigned references[] = {value_of("a_upper_work_roll"), value_of("a_lower_work_roll"),
                                 value_of("a_upper_frame"), value_of("F_cell")};
  const char *const columns[] = {"upper_work_roll", "lower_work_roll", "upper_frame", "load_cell"};
  const double units[]        = {9.80665, 9.80665, 9.80665, 1e3};
  const auto n                = response.column("time")->size();
  EXPECT_GT(n, 9000);
  double worst = 0, values[4];
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i > 0) {
      ASSERT_EQ(unit.function<decltype(&fmi2DoStep)>("fmi2DoStep")(c, double(i - 1) * 5e-5, 5e-5, 1), 0);
    }
    ASSERT_EQ(unit.function<decltype(&fmi2GetReal)>("fmi2GetReal")(c, references, 4, values), 0);
    for (int k = 0; k < 4; ++k) {
      const Eigen::VectorXd &column = *response.column(columns[k]);
      worst = std::max(worst, std::abs(values[k] / units[k] - column[i]) / column.cwiseAbs().maxCoeff());
    }
  }
  EXPECT_LT(worst, 1e-10);
  unit.function<decltype(&fmi2FreeInstance)>("fmi2FreeInstance")(c);
}

TEST(ExportCommand, SaysWhatItCannotExport)
{
  const auto bearing = millstand("export fmu cases/bearing-266.toml -o /nowhere/b.fmu");
  EXPECT_EQ(bearing.exit_code, 2);
  EXPECT_EQ(bearing.err,
            "error: millstand export fmu: kind = \"bearing\" has no stand that a force can drive "
            "(cases/bearing-266.toml); it exports cases of kind four-high, lumped, cluster and chatter\n");
  const auto pass = exported("--pass 'pass 7' -o p.fmu");
  EXPECT_EQ(pass.exit_code, 2);
  EXPECT_EQ(pass.err,
            "error: --pass \"pass 7\": the case has no pass of this name; it has \"pass 1\", \"pass 2\"\n");
  EXPECT_EQ(exported("--fmi 4 -o p.fmu").exit_code, 2);
  EXPECT_EQ(millstand("export simulink stand.toml", folder()).exit_code, 2);
  EXPECT_FALSE(fs::exists(folder() + "/p.fmu"));
}

TEST(ExportCommand, KeepsFilesThatAreNotItsOwn)
{
  const auto text = exported("-o unit.zip");
  EXPECT_EQ(text.exit_code, 2);
  EXPECT_EQ(text.err, "error: -o unit.zip: a functional mock-up unit is an archive whose name ends with .fmu\n");
  std::ofstream(folder() + "/mine.fmu") << "a letter";
  const auto mine = exported("-o mine.fmu");
  EXPECT_EQ(mine.exit_code, 2);
  EXPECT_EQ(mine.err,
            "error: the file mine.fmu exists and is not an earlier export of this case; choose another with -o, "
            "or give --force-overwrite\n");
  EXPECT_EQ(read_text(folder() + "/mine.fmu"), "a letter");
  EXPECT_EQ(exported("-o mine.fmu -q --force-overwrite").exit_code, 0);
  fs::create_directories(folder() + "/box.fmu");
  const auto box = exported("-o box.fmu");
  EXPECT_EQ(box.exit_code, 2);
  EXPECT_EQ(box.err, "error: -o box.fmu is a folder; name the archive, for example box.fmu/stand.fmu\n");
  const auto nowhere = exported("-o nowhere/stand.fmu");
  EXPECT_EQ(nowhere.exit_code, 2) << nowhere.err;
}

// A pass of its own force and a closed frame, a published force: other branches of the model, checked by the
// program.
TEST(ExportCommand, OtherFramesAndForcesPassTheCheckOfTheProgram)
{
  for (const char *choice : {"dynamics.force_meaning=disturbance --set dynamics.frame=closed",
                             "dynamics.force_meaning=published --pass 'pass 2'"}) {
    const auto outcome =
        exported("-q -o other.fmu --force-overwrite --set given.C='1.9e5 N s/m' --set " + std::string(choice));
    EXPECT_EQ(outcome.exit_code, 0) << choice << outcome.err;
  }
  const auto sick = exported("-o sick.fmu --set given.K3='0.001 kN/mm' --set given.M3='0.001 kg' -q");
  EXPECT_EQ(sick.exit_code, 0) << sick.err;
}

// A name without an ASCII letter.
TEST(ExportCommand, NamesOfOtherScriptsBecomeNumbersWithAWord)
{
  const std::string name = "\xE5\x9B\x9B\xE8\xBE\x8A";  // Chinese: four rolls
  fs::copy_file(folder() + "/stand.toml", folder() + "/" + name + ".toml", fs::copy_options::overwrite_existing);
  const auto unit = millstand("export fmu " + name + ".toml", folder());
  EXPECT_EQ(unit.exit_code, 0) << unit.err;
  const std::string description = entry(folder() + "/out/" + name + ".fmu", "modelDescription.xml");
  std::smatch identifier;
  ASSERT_TRUE(std::regex_search(description, identifier, std::regex("modelIdentifier=\"(stand_[0-9a-f]{8})\"")));
  EXPECT_EQ(unit.err, "note: other programs cannot write the name of the case \"" + name +
                          "\"; the model is called " + identifier[1].str() + " there\n");
  for (const auto &[format, ending] : {std::pair{"modelica", ".mo"}, std::pair{"matlab", ".m"}}) {
    const auto model = millstand("export " + std::string(format) + " " + name + ".toml", folder());
    EXPECT_EQ(model.exit_code, 0) << model.err;
    EXPECT_TRUE(fs::exists(folder() + "/out/" + identifier[1].str() + ending)) << model.out;
    EXPECT_EQ(model.err, unit.err);
  }
}

// A client that holds the input and takes the proposed step sees the fastest mode.
TEST(ExportCommand, TheProposedStepIsATwentiethOfTheShortestPeriod)
{
  ASSERT_EQ(exported("-o step.fmu -q --set dynamics.output_rate='1 kHz'").exit_code, 0);
  const std::string description = entry(folder() + "/step.fmu", "modelDescription.xml");
  const auto data               = fmu::read_model(entry(folder() + "/step.fmu", "resources/model.json"));
  const auto system             = fmu::modal_system(data, fmu::start_of(data));
  const double highest          = *std::max_element(system.rad.begin(), system.rad.end()) / (2 * M_PI);
  std::smatch match;
  ASSERT_TRUE(std::regex_search(description, match, std::regex("stepSize=\"([^\"]*)\"")));
  const double step = std::stod(match[1]);
  EXPECT_LE(step, 1 / (20 * highest));
  EXPECT_GT(step, 0.5 / (20 * highest)) << "and not much shorter";
  EXPECT_TRUE(near(std::round(1e-3 / step), 1e-3 / step, within(1e-9, "whole parts of the output step")));
}

// docs/examples/fmu_step.c as a reader would use it.
TEST(ExportCommand, TheExampleInCRuns)
{
  ASSERT_EQ(exported("-o example.fmu -q").exit_code, 0);
  for (const auto &file : fmu::entries_of(read_text(folder() + "/example.fmu"))) {
    const fs::path path = fs::path(folder()) / "unit" / file.name;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << file.bytes;
  }
  const std::string build = "cd '" + folder() +
                            "' && cc -o fmu_step '" MILLSTAND_SOURCE_DIR
                            "/docs/examples/fmu_step.c' -ldl -lm && ./fmu_step unit >example.txt";
  ASSERT_EQ(std::system(build.c_str()), 0);
  // The same force through simulate.
  std::ofstream force(folder() + "/force.csv");
  force << "time [s],force [kN]\n" << std::setprecision(17);
  for (int i = 0; i <= 20000; ++i)
    force << i * 5e-5 << "," << 976 + 3 * std::sin(2 * M_PI * 39 * i * 5e-5) << "\n";
  force.close();
  ASSERT_EQ(millstand("simulate stand.toml -q -o sine --force force.csv", folder()).exit_code, 0);
  const auto results = nlohmann::json::parse(std::ifstream(folder() + "/sine/results.json"));
  const double peak  = results.at("values").at("pass 1.peak_g.upper_work_roll").at("value").get<double>();
  double printed     = 0;
  EXPECT_EQ(std::sscanf(read_text(folder() + "/example.txt").c_str(), "upper work roll: peak %lf g", &printed), 1);
  EXPECT_TRUE(near(printed, peak, within(1e-4, "four digits after the point are printed", 1)));
}
