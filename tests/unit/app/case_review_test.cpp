// What a case and its records say about each other before a run, word for word.
#include "app/command/completion.h"
#include "app/review/case_review.h"
#include "app/review/closed_form_modes.h"
#include "app/review/estimate_review.h"
#include "app/review/record_review.h"
#include "app/run/run_kind.h"
#include "app/run/run_summary.h"
#include "core/base/files.h"
#include "core/case/estimates.h"
#include "core/case/input_reference.h"
#include "core/model/case.h"
#include "tests/support/given_stand.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

using namespace mill;
namespace fs = std::filesystem;

namespace {
using Sets = std::vector<std::string>;

std::string messages(const std::vector<Problem> &problems)
{
  std::string text;
  for (const Problem &problem : problems)
    text += (text.empty() ? "" : "\n") + problem.message;
  return text;
}

std::string messages(const std::vector<Warning> &warnings)
{
  std::vector<Problem> problems;
  for (const Warning &warning : warnings)
    problems.push_back(problem_of(warning));
  return messages(problems);
}

class Reviewed : public testing::Test {
protected:
  fs::path folder = fs::path(testing::TempDir()) / "millstand_review_test";
  void SetUp() override
  {
    fs::create_directories(folder);
  }
  void TearDown() override
  {
    fs::remove_all(folder);
  }
  /// A force record of n samples at `rate`, alternating around a mean; those of `lost` are left out.
  std::string record(const std::string &name, const int n, const double rate, const double mean_kN,
                     const std::string &header = "time [s],force [kN]", const int lost_from = 0,
                     const int lost_to = 0, const int columns = 1)
  {
    std::string text = header + "\n";
    for (int i = 0; i < n; ++i)
      if (i < lost_from || i >= lost_to) {
        text += fmt::format("{:.6f}", i / rate);
        for (int c = 0; c < columns; ++c)
          text += fmt::format(",{:.3f}", mean_kN + (i % 2 ? 1 : -1));
        text += "\n";
      }
    const std::string path = (folder / name).string();
    write_atomically(path, text);
    return path;
  }
  CaseReview review(const Sets &sets, const char *file = "cases/published-1400.toml")
  {
    const Case c = read_case(file, sets);
    return run_kind(c).review(c, "");
  }
};
}  // namespace

TEST_F(Reviewed, ARecordMustOutlastTheLowestMode)
{
  // (34.1) at 38.9 Hz and 1 %: 2.05 s.
  EXPECT_TRUE(near(needed_duration({38.9, 800, 0.01}), 5 / (2 * 3.14159265358979 * 0.01 * 38.9),
                   within(1e-12, "the formula")));
  EXPECT_EQ(needed_duration({}), 0);
  const std::string brief = record("brief.csv", 2001, 4000, 976);
  const CaseReview r      = review({"pass.0.force=" + brief});
  ASSERT_EQ(r.warnings.size(), 1u);
  const Warning &brevity = r.warnings[0];
  EXPECT_EQ(brevity.id, WarningId::record_short);
  EXPECT_EQ(brevity.subject, "pass 1");
  EXPECT_EQ(brevity.fact.rfind("the force record lasts 0.5 s; the lowest mode to be expected, at ", 0), 0u)
      << brevity.fact;
  EXPECT_NE(brevity.fact.find(" to build up (five decay times at 1 % damping)"), std::string::npos);
  EXPECT_EQ(brevity.detail, "peaks and rms are those of a start");
  EXPECT_EQ(brevity.remedy, "give a longer record");
  EXPECT_EQ(r.facts.at(0), "pass 1: the force record lasts 0.5 s, 2001 samples at 4000 Hz, mean 976 kN");
}

// Some milliseconds by closed forms, before the finite elements find the same.
TEST_F(Reviewed, AModulusThatLeavesNothingForTheFrameIsRefusedWithBothNumbers)
{
  const std::string path = (folder / "modulus.toml").string();
  write_atomically(path, template_of("four-high"));
  const CaseReview good = review({}, path.c_str());
  EXPECT_EQ(messages(good.problems), "");
  const CaseReview bad = review({"frame.modulus=50 MN/mm"}, path.c_str());
  ASSERT_EQ(bad.problems.size(), 1u);
  EXPECT_EQ(bad.problems[0].place.file, "--set frame.modulus=50 MN/mm");
  EXPECT_EQ(bad.problems[0].place.line, 0);
  const std::string &message = bad.problems[0].message;
  EXPECT_EQ(message.rfind("frame.modulus = 50 MN/mm leaves nothing for the frame: with touching work rolls the "
                          "rolls, their contacts and bearings and what is given of the frame have ",
                          0),
            0u)
      << message;
  EXPECT_NE(message.find(" MN/mm together, and the whole stand is softer than that; give the slope of force over "
                         "screw position of both housings together, or correct rolls and bearings"),
            std::string::npos)
      << message;
}

TEST_F(Reviewed, SamplingAndGapsOfARecordAreChecked)
{
  const std::string slow = record("slow.csv", 2001, 200, 976, "time [s],force [kN]", 640, 664);
  const CaseReview r     = review({"pass.0.force=" + slow});
  EXPECT_EQ(messages(r.warnings),
            "pass 1: the force record has a gap, the longest of 0.125 s at 3.195 s: straight lines fill it");
  EXPECT_NE(messages(r.said_by_run).find("pass 1: the rolling force is sampled at "), std::string::npos);
  EXPECT_NE(messages(r.said_by_run).find(" (mode by closed forms)"), std::string::npos);
}

TEST_F(Reviewed, AMeasuredRecordIsCheckedToo)
{
  const std::string header = "time [s],upper_work_roll [g],lower_work_roll [g]";
  const std::string force  = record("force.csv", 40001, 4000, 976),
                    slow   = record("slow.csv", 2001, 200, 0, header, 0, 0, 2);
  const CaseReview r       = review({"pass.0.force=" + force, "pass.0.measured=" + slow});
  EXPECT_NE(messages(r.warnings)
                .find("pass 1: the measured record is sampled at 200 Hz and shows nothing above 100 "
                      "Hz: the highest mode to be expected is at "),
            std::string::npos)
      << messages(r.warnings);
  std::string late = read_text(slow);
  for (std::size_t position = late.find('\n') + 1; position < late.size();
       position             = late.find('\n', position) + 1)
    late.insert(position, "1");  // 0.005 becomes 10.005, the last 110
  const std::string path = (folder / "late.csv").string();
  write_atomically(path, late);
  EXPECT_EQ(
      messages(review({"pass.0.force=" + force, "pass.0.measured=" + path}).problems),
      "pass 1: the measured record, 10 .. 110 s, and the force record, 0 .. 10 s, have no time in common; count "
      "both from the same moment");
  EXPECT_EQ(refusal([&] {
              review({"pass.0.force=" + force, "pass.0.measured=" + force});
            }).find("no column 'upper_work_roll' in this record, which has 'force'"),
            0u)
      << refusal([&] {
           review({"pass.0.force=" + force, "pass.0.measured=" + force});
         });
}

TEST_F(Reviewed, ALoadOfAnotherOrderIsRefused)
{
  const std::string force = record("force.csv", 40001, 4000, 976);
  const Sets on{"pass.0.force=" + force, "pass.1.force=" + force};
  const auto with = [&](const std::string &set, const char *file) {
    Sets sets = on;
    sets.push_back(set);
    return review(sets, file);
  };
  const char *chain = "cases/published-1400.toml";
  EXPECT_EQ(
      messages(with("pass.0.load=976 N", chain).problems),
      "pass 1: pass.load is 0.976 kN, the mean of its force record 976 kN, a factor of 1000; one of the two is "
      "in another unit");
  EXPECT_EQ(messages(with("pass.0.load=900 kN", chain).said_by_run)
                .find("pass 1: pass.load is 900 kN, the mean of its force record 976 kN: stiffnesses belong to "
                      "the first, accelerations to the second"),
            0u);
  EXPECT_EQ(
      messages(with("contact.upper.loads=[\"100 N\", \"500 N\"]", "cases/four-high-1400.toml").problems)
          .find("contact.upper.loads = 0.1 kN .. 0.5 kN does not hold the working load of 976 kN; a curve is "
                "never extrapolated, widen the range"),
      0u);
}

// In the words of the verdict of the run, and at the place of the pass.
TEST_F(Reviewed, APassWithoutSpeedNamesTheKey)
{
  const auto silent = [](const CaseReview &r) {
    return std::none_of(r.said_by_run.begin(), r.said_by_run.end(), [](const Warning &warning) {
      return warning.id == WarningId::critical_speed_not_searched;
    });
  };
  const char *tandem = "cases/cold-tandem-2030.toml";
  EXPECT_TRUE(silent(review({}, tandem)));
  const Case c = [] {
    std::string text = read_text("cases/cold-tandem-2030.toml");
    const auto line  = text.find("speed           = \"15 m/s\"");
    return read_case_of("cases/cold-tandem-2030.toml", text.replace(line, 1, "# s"));
  }();
  const CaseReview r = review_stand(c, "");
  ASSERT_FALSE(silent(r));
  const auto warning = std::find_if(r.said_by_run.begin(), r.said_by_run.end(), [](const Warning &w) {
    return w.id == WarningId::critical_speed_not_searched;
  });
  EXPECT_EQ(text_of(*warning),
            "stand 5: critical speed not searched: pass.0.speed is not given; add it to the case");
  EXPECT_EQ(warning->place.line, 89);
  EXPECT_EQ(sentence_of(not_searched("stand 5", 0, {"pass.speed"})),
            "Critical speed not searched: pass.speed is not given.");
}

TEST_F(Reviewed, AStripThatNeedsAnotherForceIsReported)
{
  const std::string force = record("force.csv", 40001, 4000, 976);
  const Sets on{"pass.0.force=" + force, "pass.1.force=" + force};
  const auto with = [&](const std::string &flow) {
    Sets sets = on;
    sets.push_back("strip.flow_stress.k=" + flow);
    return review(sets, "cases/four-high-1400.toml");
  };
  for (const Warning &warning : with("28 MPa").said_by_run)
    EXPECT_NE(warning.id, WarningId::bite_force) << "the demo stand: " << text_of(warning);
  const std::string warned = messages(with("60 MPa").said_by_run);
  EXPECT_EQ(warned.rfind("pass 1: by the slab theory this strip takes a rolling force of 2.", 0), 0u) << warned;
  EXPECT_NE(warned.find(" MN, the load is 976 kN (+1"), std::string::npos) << warned;
  EXPECT_NE(warned.find(" %); check flow stress, friction and thicknesses"), std::string::npos) << warned;
  const std::string refused = messages(with("0.2 MPa").problems);
  EXPECT_NE(refused.find("a factor of 1"), std::string::npos) << refused;
  EXPECT_NE(
      refused.find("; is one of load, flow stress, width and thicknesses in another unit? given.K4 leaves the "
                   "strip out"),
      std::string::npos)
      << refused;
}

// Everything behind springs and masses is given: the closed forms need neither frame nor bearing nor flow stress.
TEST_F(Reviewed, AStandWithEverythingGivenHasItsModes)
{
  const std::string path = (folder / "given.toml").string();
  write_atomically(path, given_stand());
  const Case c       = read_case(path);
  const auto &stand  = std::get<FourHigh>(c.spec);
  const auto results = closed_form_stand(stand, 976e3);
  const auto value   = [&](const std::string &name) {
    const auto match =
        std::find_if(results.begin(), results.end(), [&](const ClosedFormResult &r) { return r.name == name; });
    return match == results.end() ? std::nan("") : match->parameter.value;
  };
  EXPECT_EQ(value("M1"), 9320);
  EXPECT_EQ(value("K2"), 1.0e10);
  EXPECT_EQ(value("K_Zy"), 1.02e11);
  // Upper half open: f of M1, M2, M3 on K1, K2, K3, from its characteristic polynomial det(K - w^2 M) = 0.
  const double w2 = std::pow(2 * 3.14159265358979323846 * value("open.f1"), 2);
  const double a = 6.3086e9 + 1e10 - w2 * 9320, b = 1e10 + 4e10 - w2 * 59720, d = 4e10 - w2 * 1889;
  EXPECT_LT(std::abs(a * (b * d - 16e20) - 1e20 * d), 1e-6 * std::abs(a * b * d));
  EXPECT_TRUE(run_kind(c).review(c, "").problems.empty());
}

TEST_F(Reviewed, EstimatesAreRankedByTheirEffect)
{
  const std::string path = (folder / "template.toml").string();
  write_atomically(path, template_of("four-high"));
  const auto stand   = std::get<FourHigh>(read_case(path).spec);
  const auto records = ranked_estimates(stand, 976e3);
  ASSERT_EQ(records.size(), stand.estimates.size());
  const auto move = [&](const EstimateRecord &record, const std::string &name) {
    for (const auto &[of, value] : record.moves)
      if (of == name)
        return value;
    return 0.;
  };
  const auto problem_of = [&](const std::string &key) {
    return *std::find_if(records.begin(), records.end(),
                         [&](const EstimateRecord &r) { return r.estimate.key == key; });
  };
  // K1 is a series; the modulus keeps the sum over all parts of the frame, so that a softer beam makes the others
  // stiffer: K1 moves by its share of that sum.
  const Frame &f      = stand.frame;
  const Estimate beam = problem_of("frame.upper_beam_stiffness").estimate;
  double all          = 0;
  for (const Estimate &e : stand.estimates)
    all += e.unit == "kN/mm" ? 1 / e.value : 0;
  const double rest = 1 / f.upper_post_stiffness + 1 / f.piston_stiffness + 1 / f.upper_packing_stiffness;
  const auto share  = [&](const double K) { return (rest + 1 / K) / (all - 1 / beam.value + 1 / K); };
  EXPECT_TRUE(near(move(problem_of("frame.upper_beam_stiffness"), "K1"),
                   0.5 * std::log(share(beam.low) / share(beam.high)), within(1e-9, "two series of springs")));
  EXPECT_GT(move(problem_of("frame.upper_beam_stiffness"), "K7"), 0) << "the modulus keeps";
  EXPECT_GT(move(problem_of("backup_roll.chock_mass_upper"), "M2"), 0.01);
  const auto largest = [&](const EstimateRecord &r) {
    double most = 0;
    for (const auto &[name, value] : r.moves)
      if (name[0] == 'f' && name.size() == 2)
        most = std::max(most, value);
    return most;
  };
  for (std::size_t i = 1; i < records.size(); ++i)
    EXPECT_GE(largest(records[i - 1]), largest(records[i])) << records[i].estimate.key;
}

TEST(RunSummary, DigitsAreThoseThatTheErrorAllows)
{
  const auto shown = [](const double value, const char *unit, const double error = NAN) {
    Parameter p;
    p.value = value;
    p.unit  = unit;
    if (!std::isnan(error))
      p.error_estimate = error;
    return engineering(p);
  };
  EXPECT_EQ(shown(37.7941, "Hz"), "37.79 Hz") << "four digits without a stated error";
  EXPECT_EQ(shown(846.349, "Hz"), "846.3 Hz");
  EXPECT_EQ(shown(37.7941, "Hz", 0.01), "37.8 Hz") << "0.38 Hz: its first digit is the last that is known";
  EXPECT_EQ(shown(4.01918e10, "N/m"), "40190 kN/mm");
  EXPECT_EQ(shown(12345, "1"), "12345") << "a number of things";
}

TEST(RunSummary, HasAtMostTwentyFiveLines)
{
  Results results;
  const auto add = [&](const std::string &name, const double value, const char *unit) {
    Parameter p;
    p.value = value;
    p.unit  = unit;
    results.append({{name, p}});
  };
  add("stand.modulus.tangent", 4.5e9, "N/m");
  add("stand.modulus.kiss", 5.1e9, "N/m");
  for (int i = 1; i <= 20; ++i) {
    add("K3.reading" + std::to_string(i), 4e10, "N/m");
    add("mode.bending_" + std::to_string(i) + ".frequency", 100. * i, "Hz");
    results.values.back().second.method = "bending " + std::to_string(i) + ", roll: 60 % of it; six masses";
    results.warnings.push_back(
        warning_of_text("warning number " + std::to_string(i) + " " + std::string(300, 'x')));
  }
  std::string limits;
  for (int i = 0; i < 20; ++i)
    limits += "condition " + std::to_string(i) + ": stable\n";
  const std::string text = run_summary(results, "stand", limits, "out/stand/report.html");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 25);
  EXPECT_EQ(
      text.rfind(
          "stand: finished with 20 warnings\nmill modulus: 4.5 MN/mm with strip, 5.1 MN/mm with touching work "
          "rolls\n  bending 1, roll ",
          0),
      0u)
      << text;
  EXPECT_NE(text.find("  and 12 more named modes\ncondition 0: stable\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\nand 14 more warnings on the page\nreport: out/stand/report.html\n"), std::string::npos)
      << text;
  EXPECT_EQ(run_summary({}, "stand", "", "p"), "stand: finished with no warnings\nreport: p\n");
}

TEST(Completion, KnowsVerbsOptionsAndKinds)
{
  const auto option = [](const std::string &name, const bool takes, const std::string &meaning) {
    return DescribedOption{{name}, true, takes, false, meaning, {}};
  };
  const std::vector<DescribedVerb> verbs{
      {"new", "write a case", {option("--output", true, "file"), option("--from", true, "the owner's sheet")}},
      {"run", "the whole chain", {option("--fresh", false, "compute everything again")}}};
  const std::string bash = completion_script("bash", verbs);
  EXPECT_NE(bash.find("compgen -W \"new run --help --version\""), std::string::npos) << bash;
  EXPECT_NE(bash.find("new) options=\"--output --from\" ;;"), std::string::npos) << bash;
  EXPECT_NE(bash.find("four-high"), std::string::npos);
  EXPECT_EQ(bash.find("compdef"), std::string::npos);
  const std::string zsh = completion_script("zsh", verbs);
  EXPECT_EQ(zsh.rfind("#compdef millstand\n", 0), 0u) << zsh;
  EXPECT_NE(zsh.find("run) options=('--fresh:compute everything again' ) ;;"), std::string::npos) << zsh;
  const std::string fish = completion_script("fish", verbs);
  EXPECT_NE(fish.find("complete -c millstand -n '__fish_seen_subcommand_from new' -l from -r -d 'the owner'\\''s "
                      "sheet'\n"),
            std::string::npos)
      << fish;
  EXPECT_EQ(refusal([&] { completion_script("bsh", verbs); }),
            "no completion is available for the shell 'bsh'; did you mean 'bash'?");
}
