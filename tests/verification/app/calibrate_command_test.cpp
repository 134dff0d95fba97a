// millstand calibrate from records to a calibrated case, its refusals, its plan, and what it says to wrong input.
#include "app/twin/calibrate/calibrate_command.h"
#include "core/base/files.h"
#include "core/case/case_file.h"
#include "core/model/case.h"
#include "core/model/lumped.h"
#include "core/records/csv.h"
#include "tests/support/calibration_record.h"
#include "tests/support/near.h"
#include "tests/support/note_ids.h"
#include "tests/support/program.h"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;
using namespace mill;

namespace {
/// The stand whose records are made: set R with some springs moved; what is fitted is at most K3 and the damping.
struct Stand {
  std::string folder         = scratch("calibrate");
  calibration::Recipe recipe = calibration::recipe("two");
  Stand()
  {
    recipe.n     = 60000;  // a third of it is one second, the least a piece may last
    recipe.truth = {{"K3", -0.04}, {"zeta", 0.25}};
    write_atomically(folder + "/stand.toml", case_text());
  }
  static std::string case_text()
  {
    const LumpedModel model = calibration::set_r();
    std::string text        = "schema = 1\nkind = \"lumped\"\ntitle = \"set R\"\n[given]\n";
    for (std::size_t i = 0; i < 6; ++i)
      text += fmt::format("M{} = \"{:.17g} kg\"\n", i + 1, model.M[i].value);
    for (std::size_t i = 0; i < 7; ++i)
      text += i == 2 || i == 4
                  ? fmt::format("K{} = {{ value = \"{:.17g} N/m\", source = \"computed: line contact\" }}\n",
                                i + 1, model.K[i].value)
                  : fmt::format("K{} = \"{:.17g} N/m\"\n", i + 1, model.K[i].value);
    return text + "[[pass]]\nname = \"1\"\nload = \"976 kN\"\n[dynamics]\nmodal_damping = \"1 %\"\n";
  }
  /// A folder of one record; its last third is the check.
  std::string records(const std::string &name, const std::string &force = "force [kN]") const
  {
    const auto made = calibration::record(recipe);
    fs::create_directories(folder + "/" + name);
    std::string text = "time [s]," + force + ",upper_work_roll [m/s2],lower_work_roll [m/s2]\n";
    for (Eigen::Index k = 0; k < recipe.n; ++k)
      text += fmt::format("{:.5f},{:.9g},{:.7g},{:.7g}\n", double(k) / recipe.rate, made.force[k] / 1e3,
                          made.acceleration(k, 0), made.acceleration(k, 1));
    write_atomically(folder + "/" + name + "/pass.csv", text);
    return name;
  }
  Outcome calibrate(const std::string &arguments) const
  {
    return millstand("calibrate stand.toml " + arguments, folder);
  }
  std::string file(const std::string &name, const std::string &text) const
  {
    fs::create_directories(fs::path(folder + "/" + name).parent_path());
    write_atomically(folder + "/" + name, text);
    return name;
  }
};

void expect_said(const Outcome &outcome, const int code, const std::string &message)
{
  EXPECT_EQ(outcome.exit_code, code) << outcome.err;
  EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err << "\nwanted: " << message;
}
}  // namespace

TEST(CalibrateCommand, RecordsBecomeACase)
{
  const Stand stand;
  stand.records("measured");
  const auto done = stand.calibrate("--measured measured --free K3,zeta -q -o out");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  const std::string path = stand.folder + "/out/calibrated.toml", text = read_text(path);
  EXPECT_NE(text.find("source = \"calibrated: records pass.csv; not identified: none\", interval = ["),
            std::string::npos);
  const Case calibrated = read_case(path);
  const auto &lumped    = std::get<Lumped>(calibrated.spec);
  const Parameter &K3   = lumped.given.at("K3").parameter;
  const double truth    = calibration::set_r().K[2].value * std::exp(-0.04);
  EXPECT_EQ(K3.source, Source::measured);
  ASSERT_EQ(K3.checks.size(), 2u);
  EXPECT_LT(K3.checks[0].value, K3.value);
  EXPECT_GT(K3.checks[1].value, K3.value);
  EXPECT_LT(std::abs(K3.value / truth - 1), 4 * K3.error_estimate);
  EXPECT_TRUE(near(lumped.dynamics.modal_damping, 0.01 * std::exp(0.25),
                   within_absolute(1e-4, "noise of two seconds of record")));
  EXPECT_EQ(lumped.given.at("K1").parameter.source, Source::given);  // it was not asked for
  // any verb takes it, and it may be calibrated again
  EXPECT_EQ(millstand("modes out/calibrated.toml -q -o modes", stand.folder).exit_code, 0);
  const auto page = read_text(stand.folder + "/out/report.html");
  EXPECT_NE(page.find("2 of 2 unknowns are identified by these records"), std::string::npos);
  EXPECT_EQ(millstand("report out", stand.folder).out, "report: out/report.html\n");
  EXPECT_EQ(read_text(stand.folder + "/out/report.html"), page);
  // a folder that holds something else stays as it is
  stand.file("other/thesis.txt", "x");
  expect_said(stand.calibrate("--measured measured -q -o other"), 2,
              "the folder other holds files that no calibration wrote; choose another with -o, or give "
              "--force-overwrite");
}

TEST(CalibrateCommand, AStandThatCannotExplainTheRecordsIsRefused)
{
  Stand stand;
  // K5 moves the mode of the lower work roll, whose third octave holds more than 1 % of the energy.
  stand.recipe.truth = {{"K5", -0.1}};
  stand.records("measured");
  const auto refused = stand.calibrate("--measured measured --free K3,zeta -o out");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.out.find("refused: in "), std::string::npos) << refused.out;
  EXPECT_TRUE(fs::exists(stand.folder + "/out/report.html"));
  EXPECT_FALSE(fs::exists(stand.folder + "/out/calibrated.toml"));
  const auto accepted = stand.calibrate("--measured measured --free K3,zeta --accept -q -o out");
  EXPECT_EQ(accepted.exit_code, 0);
  const std::string text = read_text(stand.folder + "/out/calibrated.toml");
  EXPECT_NE(text.find("# REFUSED, written because of --accept: in "), std::string::npos);
  EXPECT_NE(text.find("; refused, accepted by the user\""), std::string::npos);
}

// The column of the force has a name without a role, so that it is not used.
TEST(CalibrateCommand, RecordsWithoutForceBecomeACase)
{
  const Stand stand;
  stand.records("measured", "AI_03 [kN]");
  const auto done = stand.calibrate("--measured measured --free K3,zeta -o out");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  const std::string words = "no force was recorded, so the fit eliminates it: at each frequency it uses the "
                            "ratios of the accelerations, "
                            "and their level as far as the force is smooth over a third octave. Where a channel "
                            "holds the force, name it "
                            "with --channel AI_01=force";
  EXPECT_NE(done.out.find("note: " + words + "\n"), std::string::npos) << done.out;
  const auto ids = note_ids(nlohmann::json::parse(read_text(stand.folder + "/out/calibration.json")));
  EXPECT_EQ(ids.count("force-not-recorded"), 1u);
  const std::string path = stand.folder + "/out/calibrated.toml", text = read_text(path);
  EXPECT_NE(text.find("# " + words + "\n"), std::string::npos);
  EXPECT_NE(text.find("source = \"calibrated: records pass.csv; no force recorded; not identified: none\""),
            std::string::npos)
      << text;
  const Case calibrated = read_case(path);
  const auto &lumped    = std::get<Lumped>(calibrated.spec);
  const Parameter &K3   = lumped.given.at("K3").parameter;
  const double truth    = calibration::set_r().K[2].value * std::exp(-0.04);
  EXPECT_LT(std::abs(K3.value / truth - 1), 4 * K3.error_estimate);
  EXPECT_GT(K3.error_estimate, 1e-4);  // with the force it is known twenty times better
  EXPECT_TRUE(near(std::log(lumped.dynamics.modal_damping / 0.01), 0.25,
                   within_absolute(4 * 0.02, "four deviations of the plan for 2 s, 0.017, rounded up")));
  const Table force          = read_table(stand.folder + "/out/force.csv");
  const Eigen::VectorXd &low = *force.column("low"), &high = *force.column("high");
  int held = 0;  // 1 kN rms up to 1500 Hz
  for (Eigen::Index i = 0; i < low.size(); ++i)
    held += low[i] < 1000 / std::sqrt(1500.0) && high[i] > 1000 / std::sqrt(1500.0);
  EXPECT_GE(held, int(0.8 * double(low.size())));
  const auto page = read_text(stand.folder + "/out/report.html");
  EXPECT_NE(page.find("<p>" + words + ".</p>"), std::string::npos);
  EXPECT_NE(page.find("within the noise and a model error of 5 % per third octave"), std::string::npos);
  EXPECT_EQ(millstand("report out", stand.folder).exit_code, 0);
  EXPECT_EQ(read_text(stand.folder + "/out/report.html"), page);
  expect_said(stand.calibrate("--measured measured --align -q -o out"), 2,
              "error: --align: no force was recorded, so there is no second clock");
  stand.records("both");
  fs::copy(stand.folder + "/measured/pass.csv", stand.folder + "/both/second.csv");
  expect_said(stand.calibrate("--measured both -q -o out"), 2,
              "both/second.csv: no channel \"force\" in N or kN, which both/pass.csv has; name it with --channel "
              "AI_01=force, or calibrate records with and without force one after the other");
}

TEST(CalibrateCommand, LevelsAloneDetermineOneNumber)
{
  const auto levels = millstand("calibrate cases/published-levels.toml --measured cases/data/published-levels");
  EXPECT_EQ(levels.exit_code, 3);
  EXPECT_NE(levels.out.find(
                "refused: these levels determine 1 number, damping x bandwidth of the force (both slopes are "
                "near -0.5); neither of the two is printed, and no case is written"),
            std::string::npos)
      << levels.out;
  EXPECT_NE(levels.out.find("zeta       0.64 of its prior deviation is left: not identified"), std::string::npos)
      << levels.out;
}

TEST(CalibrateCommand, PlanPrintsWhatARecordWouldIdentify)
{
  const auto two = millstand("calibrate cases/published-levels.toml --plan");
  EXPECT_EQ(two.exit_code, 0) << two.err;
  EXPECT_NE(two.out.find("weakest direction that is seen: 0.47 ln K1 - 0.88 ln K2"), std::string::npos) << two.out;
  EXPECT_NE(two.out.find("would help most: a sensor at upper_frame"), std::string::npos) << two.out;
  const auto low =
      millstand("calibrate cases/published-levels.toml --plan --force-up-to \"300 Hz\" --free K3,K6,K7 "
                "--force-rms \"447.2136 N\"");
  EXPECT_NE(low.out.find("not identified"), std::string::npos) << low.out;
}

TEST(CalibrateCommand, PlanWritesItsNumbersWithFullDigits)
{
  const Stand stand;
  const auto plan = stand.calibrate("--plan --free \"frame, M2/M5, K3, zeta\" -q -o plan");
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_EQ(plan.out, "");
  const auto json = nlohmann::json::parse(read_text(stand.folder + "/plan/plan.json"));
  std::vector<std::string> names;
  for (const auto &unknown : json["unknowns"]) {
    names.push_back(unknown["name"]);
    EXPECT_TRUE(near(unknown["sd"].get<double>(),
                     unknown["shrink"].get<double>() * unknown["prior_sd"].get<double>(),
                     within(1e-14, "one product")));
  }
  EXPECT_EQ(names, (std::vector<std::string>{"K1/K7", "M1/M6", "M2/M5", "K3", "zeta"}));
  EXPECT_EQ(json["ratios"].size(), 6u);
  const std::string page = read_text(stand.folder + "/plan/report.html");
  EXPECT_NE(page.find(fmt::format("{}", json["unknowns"][3]["shrink"].get<double>())), std::string::npos)
      << "the page has the digits of the file";
  EXPECT_EQ(millstand("report plan", stand.folder).exit_code, 0);
  EXPECT_EQ(read_text(stand.folder + "/plan/report.html"), page);
  const auto words = stand.calibrate("--plan --free \"masses, ratios\"");
  for (const char *name : {"M1 ", "M6 ", "zeta1 ", "zeta6 "})
    EXPECT_NE(words.out.find(name), std::string::npos) << words.out;
}

// The deviation before the records is the error that the case states, and a mass with a stated error is free.
TEST(CalibrateCommand, TakesTheStatedErrorsAsDeviationsBeforeTheRecords)
{
  const Stand stand;
  std::string text = Stand::case_text();
  for (const auto &[key, tolerance] : {std::pair("K2", "82 %"), std::pair("M3", "4 %")}) {
    const auto position = text.find(std::string(key) + " = ");
    text.insert(text.find('\n', position) + 1, fmt::format("{}_tolerance = \"{}\"\n", key, tolerance));
  }
  stand.file("stated.toml", text);
  ASSERT_EQ(millstand("calibrate stated.toml --plan -q -o plan", stand.folder).exit_code, 0);
  std::map<std::string, double> prior;
  const auto plan = nlohmann::json::parse(read_text(stand.folder + "/plan/plan.json"));
  for (const auto &unknown : plan["unknowns"])
    prior[unknown["name"]] = unknown["prior_sd"];
  EXPECT_EQ(prior.at("K2"), 0.82);
  EXPECT_EQ(prior.at("M3"), 0.04);
  EXPECT_EQ(prior.count("M2"), 0u) << "no error is stated";
}

// A refused calibration prints the value and the interval of one fit.
TEST(CalibrateCommand, PrintsRefusedValuesInsideTheirIntervals)
{
  Stand stand;
  stand.recipe.truth = {{"K1", -0.06}, {"K2", 0.08}, {"K5", -0.1}};
  stand.records("measured");
  const auto refused = stand.calibrate("--measured measured --free K1,K2,K6,zeta -o out");
  ASSERT_EQ(refused.exit_code, 3) << refused.out;
  const auto json = nlohmann::json::parse(read_text(stand.folder + "/out/calibration.json"));
  for (const auto &unknown : json["unknowns"]) {
    const auto percent = [&](const char *which) { return std::stod(unknown["shown"][which].get<std::string>()); };
    EXPECT_LE(percent("low"), percent("value")) << unknown;
    EXPECT_GE(percent("high"), percent("value")) << unknown;
    const auto &factor = json["values"]["factor." + unknown["name"].get<std::string>()];
    EXPECT_TRUE(near(std::log(factor["value"].get<double>()), unknown["estimate"].get<double>(),
                     within(1e-9, "the value of the joint fit", 1e-3)));
  }
  const auto quiet = stand.calibrate("--measured measured --free K1,K2,K6,zeta -q -o out");
  EXPECT_EQ(quiet.exit_code, 3);
  EXPECT_EQ(quiet.out, "");
  EXPECT_EQ(quiet.err.rfind("refused: ", 0), 0u) << "a refusal has a sentence: " << quiet.err;
}

TEST(CalibrateCommand, ForceDrivesALumpedStandWithoutPasses)
{
  const Stand stand;
  std::string text = Stand::case_text();
  text.erase(text.find("[[pass]]"), text.find("[dynamics]") - text.find("[[pass]]"));
  stand.file("lumped.toml", text);
  std::string force = "time [s],force [kN]\n";
  for (int k = 0; k < 20000; ++k)
    force += fmt::format("{:.5f},{:.6f}\n", k * 5e-5, 976 + 5 * std::sin(2 * M_PI * 218 * k * 5e-5));
  stand.file("force.csv", force);
  const auto run = millstand("simulate lumped.toml --force force.csv -q -o run", stand.folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  ASSERT_TRUE(fs::exists(stand.folder + "/run/response/record.csv"));
  const Table response = read_table(stand.folder + "/run/response/record.csv");
  EXPECT_GT(response.columns[1].cwiseAbs().maxCoeff(), 0);
  // the same force as that of a pass
  stand.file("pass.toml", text + "[[pass]]\nname = \"record\"\nforce = \"force.csv\"\n");
  ASSERT_EQ(millstand("simulate pass.toml -q -o with-pass", stand.folder).exit_code, 0);
  EXPECT_EQ(read_text(stand.folder + "/run/response/record.csv"),
            read_text(stand.folder + "/with-pass/response/record.csv"));
}

namespace {
CommandLine line_of(const Stand &stand)
{
  CommandLine line;
  line.verb   = mill::Verb::calibrate;
  line.target = stand.folder + "/stand.toml";
  line.output = stand.folder + "/refused";
  line.quiet  = true;
  return line;
}

CommandLine plan_of(const Stand &stand, const std::string &free, const std::string &duration)
{
  CommandLine line        = line_of(stand);
  line.calibrate.plan     = true;
  line.calibrate.free     = free;
  line.calibrate.duration = duration;
  return line;
}

CommandLine measured_in(const Stand &stand, const std::string &folder)
{
  CommandLine line        = line_of(stand);
  line.calibrate.measured = stand.folder + "/" + folder;
  return line;
}

/// What the program would say with exit code 2; folders are those of the test.
void expect_refused(const CommandLine &line, const std::string &message)
{
  try {
    calibrate_command(line);
    ADD_FAILURE() << "not refused; wanted: " << message;
  } catch (const InputError &error) {
    std::string output;
    for (const Problem &problem : error.problems)
      output += render(problem) + "\n";
    const std::string folder = fs::path(line.target).parent_path().string() + "/";
    for (auto position = output.find(folder); position != std::string::npos; position = output.find(folder))
      output.erase(position, folder.size());
    EXPECT_NE(output.find(message), std::string::npos) << output << "\nwanted: " << message;
  }
}
}  // namespace

TEST(CalibrateCommand, NamesWrongInputWithItsRemedy)
{
  const Stand stand;
  expect_said(
      stand.calibrate(""), 2,
      "error: millstand calibrate: no records; name their folder with --measured DIR, or use --plan to see which "
      "unknowns a record would identify");
  expect_said(
      stand.calibrate("--measured nowhere"), 2,
      "error: --measured nowhere: no such folder; it holds the records, and records.toml where they have roles");
  stand.file("empty/readme.md", "no record");
  expect_refused(measured_in(stand, "empty"),
                 "error: --measured empty: no record in it; .csv, .npy, .uff and .mat are read");
  stand.file("roles/records.toml", "[[record]]\nfile = \"pass.csv\"\nrole = \"train\"\n");
  expect_refused(
      measured_in(stand, "roles"),
      "roles/records.toml:3:8: error: record.0.role = \"train\" is unknown; one of fit | check is needed");
  stand.file("nothing/records.toml", "band = [\"20 Hz\", \"900 Hz\"]\n");
  expect_refused(measured_in(stand, "nothing"),
                 "neither [[record]] nor [[level]]; a record needs at least file = \"pass-1.csv\"");
  stand.file("levels/records.toml", "[[level]]\nplace = \"upper_work_roll\"\n");
  expect_refused(measured_in(stand, "levels"), "a level is either rms or peak, for example rms = \"0.4 g\"");
  stand.file("place/records.toml", "[[level]]\nplace = \"uper_work_roll\"\nrms = \"0.4 g\"\n");
  expect_refused(measured_in(stand, "place"),
                 "the chain has no place uper_work_roll; did you mean 'upper_work_roll'?");
  expect_refused(plan_of(stand, "K9", ""), "--free \"K9\": the stand has no unknown \"K9\"");
  expect_refused(plan_of(stand, "K1,K1", ""), "--free \"K1,K1\": K1 appears twice");
  expect_refused(plan_of(stand, "frame, K7", ""), "--free \"frame, K7\": K7 appears twice");
  expect_refused(plan_of(stand, "M2/M9", ""), "--free \"M2/M9\": the stand has no unknown \"M9\"");
  expect_refused(plan_of(stand, "", "20"),
                 "--duration \"20\": a time above zero is needed, for example --duration \"20 s\"");
  expect_said(
      millstand("calibrate cases/two-cylinders.toml --plan"), 2,
      "millstand calibrate: the case cases/two-cylinders.toml has no chain of six masses; name a case of kind "
      "four-high, or of kind lumped with [given]");
}
