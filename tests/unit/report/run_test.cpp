#include "core/base/errors.h"
#include "core/base/files.h"
#include "report/front/html.h"
#include "report/page/curves.h"
#include "report/page/run.h"
#include "tests/support/interrupted_folder.h"
#include "tests/support/near.h"
#include "tests/support/sample_run.h"
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

using namespace mill;
using namespace mill::report;

namespace {
std::string message_of(const std::string &directory)
{
  try {
    read_run(directory);
  } catch (const InputError &error) {
    const Problem &problem = error.problems.at(0);
    return std::filesystem::path(problem.place.file).filename().string() + ":" +
           std::to_string(problem.place.line) + ":" + std::to_string(problem.place.column) + ": " +
           problem.message;
  }
  return "no error";
}

void overwrite(const std::string &path, const std::string &text)
{
  std::ofstream(path) << text;
}
}  // namespace

TEST(Run, ReadsTheFilesOfARun)
{
  const auto run = read_run(write_sample_run());
  EXPECT_EQ(run.case_name, "four-high-1400");
  EXPECT_EQ(run.results.front().name, "K1") << "order of computation, not of the alphabet";
  const Result *K3 = run.find("K3.tangent");
  ASSERT_TRUE(K3);
  EXPECT_EQ(K3->checks.size(), 2u);
  EXPECT_TRUE(near(K3->checks[1].value, 7.53399e11, within(0, "read back from 17 digits")));
  EXPECT_TRUE(std::isnan(run.find("K1")->error_estimate)) << "null represents no estimate";
  EXPECT_TRUE(near(run.manifest.geometry.at("backup_diameter"), 1.45, within(0, "read back")));
  EXPECT_EQ(run.manifest.passes.at(1).slug, "pass-2");
  ASSERT_TRUE(run.table("response/pass-1"));
  EXPECT_EQ(run.table("response/pass-1")->columns.at(0).size(), 4001);
  EXPECT_EQ(run.table("response/pass-3"), nullptr);
  EXPECT_TRUE(near(run.manifest.passes.at(1).load, 1e3 * run.table("response/pass-2")->column("force")->mean(),
                   within(1e-14, "a pass without a working load works at the mean of its record")));
  EXPECT_TRUE(run.remarks.empty());
}

// The run that has just written a folder still has its tables.
TEST(Run, ItsOwnTablesAreNotReadAgain)
{
  const std::string directory                    = write_sample_run();
  const auto read                                = read_run(directory);
  auto at_hand                                   = read.tables;
  at_hand.at("response/pass-1").columns.at(0)[0] = 77;
  at_hand.at("response/pass-2").columns.at(0)[0] = std::numeric_limits<double>::infinity();
  at_hand["curves/never-written"]                = at_hand.at("response/pass-1");
  const auto from_memory                         = read_own_run(directory, at_hand);
  EXPECT_EQ(from_memory.table("response/pass-1")->columns.at(0)[0], 77) << "taken as it is";
  EXPECT_EQ(from_memory.table("response/pass-2")->columns.at(0)[0],
            read.table("response/pass-2")->columns.at(0)[0])
      << "a file says this in another way: read";
  EXPECT_EQ(from_memory.tables.size(), read.tables.size()) << "what is not a file does not belong to the run";
  EXPECT_EQ(from_memory.remarks, read.remarks);
}

TEST(Run, IsReadWholeWhereASignalInterruptsTheReadingOfItsFolders)
{
  const std::string directory = write_sample_run();
  const auto calm             = read_run(directory);
  const interrupted_folder::EachSecondCall interrupted;
  const auto run = read_run(directory);
  EXPECT_GE(interrupted.failed(), 2) << "curves and response";
  EXPECT_EQ(run.tables.size(), calm.tables.size());
  EXPECT_EQ(run.remarks, calm.remarks);
}

TEST(Run, NoResultsIsAnInputErrorWithTheRemedy)
{
  const std::string directory = write_sample_run();
  std::filesystem::remove(directory + "/results.json");
  EXPECT_EQ(message_of(directory),
            "results.json:0:0: no results.json in " + directory +
                "; name the folder that `millstand run` has written, or run the case first");
}

TEST(Run, BrokenResultsAreNamedWithTheirPlace)
{
  const std::string directory = write_sample_run();
  overwrite(directory + "/results.json", "{\n  \"case\": \"a\",\n  \"status\" \"ok\"\n}\n");
  EXPECT_EQ(message_of(directory), "results.json:3:15: this is not JSON; run the case again, or restore the "
                                   "file as the program wrote it");
  overwrite(directory + "/results.json", "");
  EXPECT_EQ(message_of(directory).substr(0, 17), "results.json:1:1:");
  for (const char *foreign :
       {"[1, 2]", "{\"case\": 3}", "{\"case\": \"a\", \"status\": \"ok\", \"values\": {\"K1\": 7}}",
        "{\"case\": \"a\", \"status\": \"ok\", \"values\": {}, \"warnings\": [1]}"}) {
    overwrite(directory + "/results.json", foreign);
    EXPECT_NE(message_of(directory).find("not a results.json of this program"), std::string::npos) << foreign;
  }
}

TEST(Run, WarningsOfAnEarlierVersionAreWholeTexts)
{
  const std::string directory = write_sample_run();
  overwrite(directory + "/results.json",
            "{\"case\": \"a\", \"status\": \"warnings\", \"values\": {}, \"warnings\": [\"a; b\", \"a; b\"]}");
  const auto warnings = read_run(directory).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].id, WarningId::text_only);
  EXPECT_EQ(warnings[0].fact, "a; b");
}

TEST(Run, MissingAndBrokenCompanionsBecomeRemarks)
{
  const std::string directory = write_sample_run();
  std::filesystem::remove(directory + "/run.json");
  overwrite(directory + "/curves/modes.csv", "mode []\nnot a number\n");
  const auto run = read_run(directory);
  ASSERT_EQ(run.remarks.size(), 2u);
  EXPECT_EQ(run.remarks[0].substr(0, 22), "curves/modes.csv canno");
  EXPECT_EQ(run.remarks[1].substr(0, 19), "run.json is missing");
  EXPECT_EQ(run.table("curves/modes"), nullptr);
}

TEST(Run, FilesOfTwoRunsAreRefused)
{
  const std::string directory = write_sample_run();
  const auto changed          = [&](const std::string &file, const nlohmann::json &patch) {
    auto json = nlohmann::json::parse(read_text(directory + "/" + file));
    json.merge_patch(patch);
    overwrite(directory + "/" + file, json.dump(1));
  };
  changed("run.json", {{"run_id", "a1"},
                       {"files", {{"curves/modes.csv", hash_of(read_text(directory + "/curves/modes.csv"))}}}});
  changed("results.json", {{"run_id", "b2"}});
  EXPECT_EQ(message_of(directory),
            "results.json:0:0: is of run b2, but run.json in the same folder is of run a1: the folder "
            "mixes two runs; run the case again");
  changed("results.json", {{"run_id", "a1"}});
  const auto run = read_run(directory);
  EXPECT_TRUE(run.table("curves/modes"));
  EXPECT_EQ(run.table("curves/contact-upper"), nullptr) << "not in the list of this run";
  ASSERT_FALSE(run.remarks.empty());
  EXPECT_NE(run.remarks.front().find("is not of this run and is left out"), std::string::npos);
  overwrite(directory + "/curves/modes.csv", read_text(directory + "/curves/modes.csv") + "\n");
  EXPECT_EQ(
      message_of(directory),
      "modes.csv:0:0: is not the file that run a1 wrote: it was changed since then, or is of another run; run the "
      "case again, or restore the file");
}

// 200 000 levels overflowed the stack wherever a value was copied; 1e400 was called our own mistake.
TEST(Run, NestingAndNumbersBeyondAllBoundsAreRefused)
{
  const std::string again     = "; run the case again, or restore the file as the program wrote it";
  const std::string directory = write_sample_run(), results = directory + "/results.json";
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  overwrite(results, "{\"values\": {\"a\": {\"value\": 1, \"checks\": " + deep + "}}}");
  EXPECT_EQ(message_of(directory), "results.json:1:1: this JSON nests deeper than 64 levels" + again);
  overwrite(results, "{\"values\": {\"a\": {\"value\": 1e400}}}");
  EXPECT_EQ(message_of(directory), "results.json:1:1: this holds a number that no computer stores" + again);
  overwrite(results, "{\"case\": \"[[{\\\"[[\", \"status\": \"ok\", \"values\": {}}");
  overwrite(directory + "/run.json", "{\"versions\": {\"a\": " + deep + "}}");
  EXPECT_EQ(message_of(directory), "no error");
  EXPECT_EQ(read_run(directory).remarks.size(), 1u) << "run.json";
}

// An ending that no kind of curve has made a contact of its own out of a curve of a known one.
TEST(Run, AnUnknownCurveIsReportedAndNotTakenForAContact)
{
  const std::filesystem::path directory = write_sample_run(), curves = directory / "curves";
  std::filesystem::copy_file(curves / "contact-upper.csv", curves / "contact-upper-roughness.csv");
  std::filesystem::copy_file(curves / "bearing-trb.csv", curves / "bearing-trb-anything.csv");
  const auto run = read_run(directory.string());
  EXPECT_EQ(items_of(run, curve::contact), (std::vector<std::string>{"upper", "lower"}));
  EXPECT_EQ(items_of(run, curve::bearing), (std::vector<std::string>{"trb", "crb"}));
  ASSERT_EQ(run.remarks.size(), 2u);
  EXPECT_EQ(run.remarks[1],
            "curves/contact-upper-roughness.csv is not a curve that this program knows and is not shown.");
  const std::string html = html_page(run);
  EXPECT_EQ(html.find("Contact upper-roughness"), std::string::npos);
  EXPECT_NE(html.find("curves/contact-upper-roughness.csv is not a curve that this program"), std::string::npos);
}
