#include "core/base/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/reference.h"
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {
namespace fs = std::filesystem;

// Of a chain whose rows take a millisecond.
const std::string chain = "study new cases/published-1400.toml --set 'given.K3=4.0192e10 N/m' --set "
                          "'given.K5=4.0192e10 N/m' --set 'given.K4=0 N/m' --set dynamics.force_meaning=measured "
                          "--model quick -q ";

nlohmann::json report_of(const std::string &folder)
{
  return nlohmann::json::parse(mill::read_text(folder + "/report.json"));
}

void expect_done(const std::string &arguments)
{
  const Outcome outcome = millstand(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.err;
}

std::string refusal(const std::string &arguments)
{
  const Outcome outcome = millstand(arguments);
  EXPECT_EQ(outcome.exit_code, 2) << arguments;
  return outcome.err;
}

void expect_refused(const std::string &arguments, const std::string &words)
{
  const std::string text = refusal(arguments);
  EXPECT_NE(text.find(words), std::string::npos) << arguments << "\n" << text;
}

TEST(StudyCommandLong, IndicesAndSpreadOfTheChainAreThoseOfTheReference)
{
  const std::string folder = scratch("study-chain") + "/study";
  std::string keys;
  const auto lumped = reference("lumped", "study");
  const auto names  = lumped["names"].get<std::vector<std::string>>();
  const auto sd     = lumped["sd"].get<std::vector<double>>();
  for (std::size_t k = 0; k < names.size(); ++k)
    keys += " --vary 'given." + names[k] + "~normal(" + std::to_string(100 * sd[k]) + " %)'";
  expect_done(chain + "--method sobol --samples 128 --watch f1 --watch f2 --watch f5" + keys + " -o " + folder);
  expect_done("study run " + folder + " -q --jobs 2");
  expect_done("study report " + folder + " -q");
  const auto report = report_of(folder);
  EXPECT_EQ(report["finished"], 128 * 14);
  const auto sd_f = lumped["sd_f"].get<std::vector<double>>(), mean = lumped["mean"].get<std::vector<double>>(),
             nominal = lumped["f_nominal"].get<std::vector<double>>();
  const std::size_t frequencies[]{0, 1, 4}, strongest[]{6, 11, 9};  // K1, K7, K5
  const auto S = lumped["S"].get<std::vector<std::vector<double>>>();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t f = frequencies[i];
    const auto &result  = report["results"][i];
    EXPECT_TRUE(near(result["base"].get<double>(), nominal[f], within(1e-8, "the reference has nine digits")));
    EXPECT_TRUE(near(result["statistics"]["mean"]["value"].get<double>(), mean[f],
                     within(0.0075, "three standard errors of 256 rows: 3 x 3.9 % / sqrt(256)")));
    EXPECT_TRUE(near(result["statistics"]["sd"]["value"].get<double>(), sd_f[f],
                     within(0.14, "three standard errors of 256 rows: 3 / sqrt(2 x 256); 2 % needs 2^14 groups")));
    const auto &sobol = result["sobol"];
    EXPECT_LE(sobol["first_low"][strongest[i]].get<double>(), S[f][strongest[i]]);
    EXPECT_GE(sobol["first_high"][strongest[i]].get<double>(), S[f][strongest[i]]);
  }
  const std::string page = mill::read_text(folder + "/report.html");
  EXPECT_NE(page.find("1792 of 1792 rows finished"), std::string::npos);
  EXPECT_NE(page.find("Which input to measure better first"), std::string::npos);
}

TEST(StudyCommand, LineContactHasTheReferenceScatter)
{
  const std::string folder = scratch("study-line") + "/study";
  expect_done(
      "study new cases/two-cylinders.toml --set steel.poisson_ratio=0.28 --model quick --samples 4096 "
      "--vary 'steel.youngs_modulus~normal(210 GPa, 2 %)' --vary 'upper.diameter~uniform(415, 425) mm' --vary "
      "'lower.diameter~uniform(1440, 1460) mm' --vary 'contact.line.at~normal(697.29 N/mm, 5 %)' --watch "
      "contact.line.tangent -q -o " +
      folder);
  expect_done("study run " + folder + " -q");
  expect_done("study report " + folder + " -q");
  const auto line = reference("line", "study");
  const auto s    = report_of(folder)["results"][0]["statistics"];
  EXPECT_TRUE(near(s["mean"]["value"].get<double>(), 1e6 * line["mean"].get<double>(),
                   within(0.002, "wanted; the standard error of 4096 rows is 0.03 %")));
  EXPECT_TRUE(near(s["sd"]["value"].get<double>(), 1e6 * line["sd"].get<double>(),
                   within(0.02, "wanted; the standard error of 4096 independent rows is 1.1 %")));
  for (const char *end : {"q025", "q975"})
    EXPECT_TRUE(near(s[end]["value"].get<double>(), 1e6 * line[end].get<double>(),
                     within(0.003, "three standard errors of a quantile of 4096 rows")));
}

TEST(StudyCommand, AResultThatDoesNotMoveIsNamedAndNotDrawn)
{
  for (const std::string method : {"monte-carlo", "sobol", "chaos"}) {
    const std::string folder = scratch("study-still-" + method) + "/study";
    expect_done(chain + "--method " + method +
                " --samples 32 --vary 'given.K1~normal(10 %)' --watch K7 --watch f1 -o " + folder);
    expect_done("study run " + folder + " -q");
    expect_done("study report " + folder + " -q");
    const auto results = report_of(folder)["results"];
    EXPECT_EQ(results[0]["statistics"]["sd"]["value"], 0) << method;
    for (const char *shares : {"sobol", "chaos"}) {
      EXPECT_FALSE(results[0].contains(shares)) << method << ": a result without variance has no shares of it";
      EXPECT_EQ(results[1].contains(shares), method == shares) << method;
    }
    const std::string page = mill::read_text(folder + "/report.html");
    EXPECT_NE(page.find("same value in every row or no value: <code>K7</code>."), std::string::npos) << method;
    EXPECT_NE(page.find("Distribution of <code>f1</code>"), std::string::npos)
        << method << ": the drawn one leads its caption";
  }
}

TEST(StudyCommand, RowsAreTheSameAfterKillsAndByShards)
{
  const std::string folder = scratch("study-kills");
  const std::string study  = chain +
                            "--method monte-carlo --samples 600 --vary 'given.K1~normal(10 %)' --vary "
                            "'given.M3~normal(2 %)' --watch f1 --watch f6 -o " +
                            folder;
  for (const char *name : {"/whole", "/killed", "/shards"})
    expect_done(study + name);
  expect_done("study run " + folder + "/whole -q");
  expect_done("study merge " + folder + "/whole");
  // Killed at moments that differ by some milliseconds, in the middle of blocks and commits.
  for (int i = 0; i < 8; ++i)
    shell("timeout -s KILL 0.1" + std::to_string(3 * i + 10) + " '" MILLSTAND_PROGRAM "' study work " + folder +
              "/killed --shard 1/1 -q",
          MILLSTAND_SOURCE_DIR);
  expect_done("study run " + folder + "/killed -q");
  expect_done("study merge " + folder + "/killed");
  for (const char *shard : {"3/3", "1/3", "2/3", "1/3"})
    expect_done("study work " + folder + "/shards -q --shard " + shard);
  expect_done("study merge " + folder + "/shards");
  const std::string whole = mill::read_text(folder + "/whole/results.csv");
  EXPECT_EQ(std::count(whole.begin(), whole.end(), '\n'), 601);
  EXPECT_EQ(mill::read_text(folder + "/killed/results.csv"), whole);
  EXPECT_EQ(mill::read_text(folder + "/shards/results.csv"), whole);
}

TEST(StudyCommand, SigtermKeepsWhatIsFinishedAndNamesTheCommand)
{
  const std::string folder = scratch("study-sigterm") + "/study";
  expect_done(chain + "--samples 3000 --vary 'given.K1~normal(10 %)' --watch f1 -o " + folder);
  const Outcome cut = shell("timeout -s TERM 1 '" MILLSTAND_PROGRAM "' study work " + folder + " --shard 1/1 -q",
                            MILLSTAND_SOURCE_DIR);
  EXPECT_NE(cut.err.find("Continue with: millstand study work " + folder + " --shard 1/1"), std::string::npos)
      << cut.err;
  const Outcome status = millstand("study status " + folder);
  EXPECT_EQ(status.out.find("\n0 of 3000"), std::string::npos) << status.out;
  EXPECT_NE(status.out.find("0 of them begun"), std::string::npos) << status.out;
}

TEST(StudyCommand, AListNamesItsRowsAndWords)
{
  const std::string folder = scratch("study-list");
  mill::write_atomically(folder + "/rows.csv",
                         "given.K3 [kN/mm],dynamics.force_meaning\n30000,measured\n40000,published\n");
  expect_done("study new cases/published-1400.toml --model quick --method list --list " + folder +
              "/rows.csv --watch f3 -q -o " + folder + "/study");
  expect_done("study run " + folder + "/study -q");
  expect_done("study merge " + folder + "/study");
  const std::string csv = mill::read_text(folder + "/study/results.csv");
  EXPECT_NE(csv.find(",30000,\"measured\","), std::string::npos) << csv;
  mill::write_atomically(folder + "/bare.csv", "given.K3\n30000\n");
  expect_refused("study new cases/published-1400.toml --method list --list " + folder + "/bare.csv -o " + folder +
                     "/x",
                 "bare.csv:1:1: error:");
  mill::write_atomically(folder + "/range.csv", "given.K3 [kN/mm]\n30000\n-6\n");
  expect_refused("study new cases/published-1400.toml --method list --list " + folder + "/range.csv -o " + folder +
                     "/x",
                 "range.csv:3:1: error: row 2 (given.K3 = -6 kN/mm)");
}

TEST(StudyCommand, RefusesWhatCannotBeStudied)
{
  const std::string folder = scratch("study-refused"), there = folder + "/study";
  const std::string vary = "--vary 'given.K1~normal(10 %)' ", to = " -o " + there;
  expect_refused(chain + "--method sobol --samples 1000 --vary 'given.K1~normal(10 %)'" + to,
                 "--samples 1000: sobol takes a power of two; the next ones are 512 and 1024");
  expect_refused(chain + "--samples 10 " + vary + vary + to, "--vary names the key given.K1 twice");
  expect_refused(chain + "--samples 10 --vary 'given.K1=6,7 MN/mm'" + to, "draws from distributions");
  expect_refused(chain + "--method grid " + vary + to, "takes values, KEY=a,b,c");
  expect_refused(chain + "--samples 20000000 " + vary + to, "more than ten million; give --yes");
  expect_refused(chain + "--samples 10 --watch f33 " + vary + to, "gives no result of this name; did you mean");
  expect_refused("study run " + there, "holds no study");
  expect_done(chain + "--samples 10 " + vary + to);
  expect_refused(chain + "--samples 20 " + vary + to,
                 "holds a study of published-1400 by latin-hypercube with 10 rows");
  expect_refused(chain + "--samples 20 " + vary + to, "now     samples = 20");
  expect_refused(chain + "--samples 10 " + vary + to,
                 "holds this study already; go on with: millstand study run " + there);
  expect_refused("study work " + there + " --shard 5/4", "the shards of 4 are 1/4 to 4/4");
  expect_refused("study work " + there + " --shard x", "is not of the form I/N");
  expect_refused("study report " + there, "no row of " + there + " is finished");
  expect_refused("study run " + there + " --engine here --hosts hosts.txt",
                 "--hosts belongs to --engine parallel");
}

TEST(StudyCommand, RefusesObjectivesAndSurrogatesThatCannotBe)
{
  const std::string folder = scratch("study-objectives"), to = " -o " + folder + "/study";
  const std::string bounds = "--vary 'given.K1~uniform(4, 8) MN/mm' ";
  expect_refused(
      chain + "--method optimise " + bounds + to,
      "error: --method optimise has no objective: give --minimise RESULT or --maximise RESULT, a name of "
      "results.json");
  expect_refused(
      chain + "--method optimise --minimise f33 " + bounds + to,
      "error: --minimise f33: cases/published-1400.toml gives no result of this name; did you mean 'f3'?");
  expect_refused(chain + "--method optimise --minimise f3 --vary 'given.K1~normal(10 %)'" + to,
                 "--method optimise takes the bounds of each key: KEY~uniform(low, high) UNIT");
  expect_refused(
      chain + "--method optimise --minimise f3 --vary 'given.K1=4,8 MN/mm'" + to,
      "--method optimise searches between bounds, KEY~uniform(low, high) UNIT; values KEY=a,b belong to "
      "--method grid");
  expect_refused(chain + "--samples 16 --minimise f3 " + bounds + to,
                 "--minimise and --maximise belong to --method optimise");
  expect_refused(chain + "--method chaos --samples 16 " + bounds +
                     "--vary 'given.K7~normal(5 %)' --correlate given.K1,given.K7=0.5" + to,
                 "chaos takes independent inputs; leave --correlate out, or use another method");
  expect_refused(chain + "--samples 16 --cache-limit 20 " + bounds + to,
                 "error: --cache-limit \"20\": a size is needed, for example --cache-limit 20GB (MB, GB, TB)");
}

TEST(StudyCommand, AnInvalidBaseCaseIsRefusedWithItsPlace)
{
  const std::string folder = scratch("study-invalid-base");
  std::string text         = mill::read_text(MILLSTAND_SOURCE_DIR "/cases/published-1400.toml");
  text.replace(text.find("kind "), 5, "knid ");
  mill::write_atomically(folder + "/stand.toml", text);
  const std::string message = refusal("study new " + folder +
                                      "/stand.toml --samples 4 --vary 'given.K1~normal(1 %)' "
                                      "-o " +
                                      folder + "/study");
  EXPECT_NE(message.find(folder + "/stand.toml:"), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(folder + "/study"));
}

TEST(StudyCommand, RowsOfAnotherVersionDoNotMix)
{
  const std::string folder = scratch("study-version") + "/study";
  expect_done(chain + "--samples 4 --vary 'given.K1~normal(1 %)' --watch f1 -o " + folder);
  std::string text = mill::read_text(folder + "/study.toml");
  const auto place = text.find("version = \"");
  text.insert(place + 11, "0.0.");
  mill::write_atomically(folder + "/study.toml", text);
  expect_refused("study run " + folder, "their rows do not mix: make the study again with 'millstand study new'");
}

TEST(StudyCommand, ACaseThatHasChangedIsRefusedWithWhatDiffers)
{
  const std::string folder = scratch("study-changed");
  expect_done("new lumped -o " + folder + "/stand.toml");
  expect_done("study new " + folder +
              "/stand.toml --model quick --samples 4 --vary 'given.K1~normal(1 %)' --watch f1 "
              "-q -o " +
              folder + "/study");
  std::string text = mill::read_text(folder + "/stand.toml");
  const auto place = text.find("M2");
  ASSERT_NE(place, std::string::npos);
  const auto digit = text.find_first_of("123456789", text.find('=', place));
  text[digit]      = text[digit] == '9' ? '8' : char(text[digit] + 1);
  mill::write_atomically(folder + "/stand.toml", text);
  const std::string message = refusal("study work " + folder + "/study --shard 1/1");
  EXPECT_NE(message.find("has changed since the study"), std::string::npos) << message;
  EXPECT_NE(message.find("now     M2"), std::string::npos) << message;
}
}  // namespace
