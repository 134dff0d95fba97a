#include "app/trace/trace_text.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/model/case.h"
#include "core/model/lumped_model.h"
#include "reduce/chain/equivalent_mass.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

// Elasticities of the closed-form model and their sentences.
namespace {
using namespace mill;

const std::string demo = "cases/four-high-1400.toml", nowhere = "no such folder";

// The forces of the demo stand are read once for all of these.
Trace traced(const TraceOptions &options)
{
  static ClosedFormMemory memory;
  return trace(options, memory);
}

const TraceLine &line(const Trace &trace, const std::string &result)
{
  for (const TraceLine &l : trace.lines)
    if (l.result.name == result)
      return l;
  throw std::runtime_error(result + " is not reached");
}

bool reaches(const Trace &trace, const std::string &result)
{
  for (const TraceLine &l : trace.lines)
    if (l.result.name == result)
      return true;
  return false;
}

Tolerance digits()
{
  return within(0.01, "the table is printed with two digits after the point", 1);
}
}  // namespace

TEST(Trace, BackupRollDiameterHasTheSlopesOfTheTable)
{
  const Trace t = traced({demo, "backup_roll.barrel_diameter", {}, nowhere});
  EXPECT_EQ(t.key.shown, "1450 mm");
  EXPECT_EQ(t.per, "%");
  const std::pair<const char *, double> table[] = {
      {"K3", -0.06}, {"K5", -0.06}, {"K_ZW", 1.63},     {"K2", 0.25},       {"K6", 0.70},      {"M2", 0.72},
      {"M5", 0.99},  {"M3", 0.03},  {"open.f1", -0.29}, {"open.f2", -0.37}, {"open.f3", 0.06},
  };
  for (const auto &[result, slope] : table)
    EXPECT_TRUE(near(line(t, result).slope, slope, digits())) << result;
  for (const char *still : {"M1", "M6", "K1", "K7", "Kzc1", "Kzc2", "K_Zy", "K4"})
    EXPECT_FALSE(reaches(t, still)) << still;
}

TEST(Trace, WhiteForceToAKilohertzHardlyFeelsTheBackupRoll)
{
  // The demo stand with 2 % damping, its first force made noise up to 1 kHz.
  std::string text   = read_text(demo);
  const auto replace = [&](const std::string &from, const std::string &to) {
    const auto position = text.find(from);
    ASSERT_NE(position, std::string::npos) << from;
    text.replace(position, from.size(), to);
  };
  replace("force          = \"data/pass-1.csv\"", "synthetic_range = [\"972.898 kN\", \"979.537 kN\"]");
  replace("\"data/pass-2.csv\"", quoted(std::filesystem::absolute("cases/data/pass-2.csv").string()));
  replace("modal_damping = \"1 %\"", "modal_damping = \"2 %\"");
  const std::string file = testing::TempDir() + "trace-white.toml";
  write_atomically(file, text);
  const Trace t = traced({file, "backup_roll.barrel_diameter", {}, nowhere});
  std::filesystem::remove(file);
  EXPECT_TRUE(near(line(t, "pass 1.white_rms_g.upper_work_roll").slope, -0.04, digits()));
  // The record itself is one draw: the mean square of a mode is known to (2 pi zeta f T)^-1/2, 14 % at 39 Hz and 6
  // % at 218 Hz, and a change of 1 % of f moves it by half its width.
  EXPECT_TRUE(near(line(t, "pass 1.rms_g.upper_work_roll").slope, -0.04,
                   within(0.1, "one record of 10 s: 0.06 of a mode's mean square over half its width", 1)));
  const double record = line(t, "pass 1.rms_g.upper_work_roll").result.parameter.value;
  const double white  = line(t, "pass 1.white_rms_g.upper_work_roll").result.parameter.value;
  EXPECT_TRUE(
      near(white, record,
           within(0.1, "mean square known to 6 .. 14 % over 10 s, its root to half of that; the bandwidth of "
                       "the record is read to 3 dB")));
}

TEST(Trace, PowerLawsHaveTheirExponents)
{
  // At a given load a law F = c Z d^(10/9) has dF/dd proportional to (c Z)^(9/10); Palmgren's c goes with l^(8/9).
  const Trace rows = traced({demo, "bearing.crb.rows", {}, nowhere});
  EXPECT_EQ(rows.steps, "3 .. 5");
  EXPECT_TRUE(near(line(rows, "Kzc1").slope, 0.9, within(1e-6, "power law; equilibrium solved to 1e-9")));
  const Trace length = traced({demo, "bearing.crb.roller_length", {}, nowhere});
  EXPECT_TRUE(near(line(length, "K_Zy").slope, 0.8, within(1e-6, "power law; equilibrium solved to 1e-9")));
  const Trace load = traced({demo, "backup_roll.bearing_load", {}, nowhere});
  EXPECT_EQ(load.key.origin, "not given: half the rolling force");
  EXPECT_TRUE(near(line(load, "Kzc4").slope, 0.1, within(1e-6, "power law; equilibrium solved to 1e-9")));
}

// The lower bearings carry the load of the lower half: an offset of its rolls moves K6 and leaves K2.
TEST(Trace, LowerBearingsFollowTheLowerHalf)
{
  ClosedFormMemory memory;
  const auto even     = closed_form_chain(read_case(demo), memory);
  const auto bent     = closed_form_chain(read_case(demo, {"contact.lower.axis_offset=400 mm"}), memory);
  const auto value_of = [](const std::vector<ClosedFormResult> &all, const char *name) {
    return find(all, name)->parameter.value;
  };
  const double e = 0.4 / ((0.420 + 1.450) / 2);
  EXPECT_TRUE(near(value_of(bent, "K_Zy_lower") / value_of(bent, "K_Zy"), std::pow(1 + e * e, 0.05),
                   within(1e-6, "Palmgren's tangent goes with load^0.1; equilibrium solved to 1e-9")));
  EXPECT_EQ(value_of(bent, "K2"), value_of(even, "K2"));
  EXPECT_GT(value_of(bent, "K6"), value_of(even, "K6"));
}

TEST(Trace, ZerosWordsAndAbsentKeysHaveNoPercent)
{
  const Trace mass = traced({demo, "work_roll.chock_mass_upper", {}, nowhere});
  EXPECT_EQ(mass.per, "kg");
  EXPECT_EQ(mass.steps, "0 kg .. 0.01 kg");
  ClosedFormMemory memory;
  const auto none = closed_form_chain(read_case(demo), memory);
  const auto more = closed_form_chain(read_case(demo, {"work_roll.chock_mass_upper=1 kg"}), memory);
  const double M3 = find(none, "M3")->parameter.value;
  EXPECT_TRUE(near(line(mass, "M3").slope, 100 * (find(more, "M3")->parameter.value / M3 - 1),
                   within(1e-3, "logarithm against first order over 1 kg of 1875 kg")));
  EXPECT_FALSE(reaches(mass, "M4"));

  const Trace frame = traced({demo, "dynamics.frame", {}, nowhere});
  EXPECT_EQ(frame.reason, "a word has no size; every other one is tried");
  ASSERT_EQ(line(frame, "open.f1").words.size(), 1u);
  EXPECT_EQ(line(frame, "open.f1").words[0].first, "closed");

  const Trace cell = traced({demo, "frame.load_cell_stiffness", {}, nowhere});
  EXPECT_EQ(cell.key.shown, "not given");
  EXPECT_EQ(cell.reason, "it is not given");
  EXPECT_TRUE(reaches(cell, "K7") && reaches(cell, "open.f2") && !reaches(cell, "open.f1"));
  EXPECT_TRUE(reaches(cell, "f1") && reaches(cell, "f2")) << "the strip joins both halves";

  const Trace crown = traced({demo, "work_roll.crown", {}, nowhere});
  EXPECT_FALSE(line(crown, "K3").moves);
  EXPECT_NE(trace_text(crown).find("finite elements only"), std::string::npos);
  EXPECT_EQ(trace_text(crown).find("Elasticities"), std::string::npos) << "nothing moves";

  const Trace title = traced({demo, "title", {}, nowhere});
  EXPECT_EQ(trace_text(title), "title = \"1400 four-high, demo stand\"  (cases/four-high-1400.toml:12)\n"
                               "  reaches no result of this case: headline of the report\n"
                               "No elasticity: a name has no size.\n");
}

TEST(Trace, EqualBarrelLengthsGiveDifferentSlopesUpAndDown)
{
  // The shorter barrel bounds the contact: longer changes nothing, shorter does.
  const Trace t = traced({demo, "backup_roll.barrel_length", {}, nowhere});
  EXPECT_EQ(line(t, "K3").slope_up, 0);
  EXPECT_GT(line(t, "K3").slope_down, 0.5);
  EXPECT_NE(trace_text(t).find("+0.00 up, +0.92 down"), std::string::npos);
}

TEST(Trace, TwoPercentMoreDiameterReachesItsResultsOnly)
{
  // 420 on 1450 mm under 976 217.5 N on 1.4 m, and 2 % more.
  const std::vector<std::string> pair{"steel.poisson_ratio=0.28", "upper.diameter=420 mm",
                                      "contact.line.at=697.298214285714 N/mm"};
  const auto tangent = [&](const char *diameter) {
    auto sets = pair;
    sets.push_back(std::string("lower.diameter=") + diameter);
    ClosedFormMemory memory;
    const auto results = closed_form_chain(read_case("cases/two-cylinders.toml", sets), memory);
    return find(results, "contact.line.tangent")->parameter.value;
  };
  EXPECT_TRUE(near(1.4 * tangent("1450 mm"), 4.019e10, within(2e-4, "reference printed with four digits")));
  EXPECT_TRUE(
      near(100 * (tangent("1479 mm") / tangent("1450 mm") - 1), -0.12, within(0.03, "bound of the issue", 1)))
      << "lower.diameter: a radius taken for a diameter, or one roll for the other?";

  const Case thin = read_case(demo), thick = read_case(demo, {"backup_roll.barrel_diameter=1479 mm"});
  ClosedFormMemory memory;
  const auto before = closed_form_chain(thin, memory), after = closed_form_chain(thick, memory);
  EXPECT_TRUE(near(100 * (find(after, "K3")->parameter.value / find(before, "K3")->parameter.value - 1), -0.12,
                   within(0.03, "bound of the issue", 1)))
      << "backup_roll.barrel_diameter";
  const auto roll_mass = [](FourHigh stand) {
    // A roll that does not bend, moving as one: its mass without necks.
    stand.backup_roll.bearing_mass = stand.backup_roll.chock_mass_lower = stand.backup_roll.neck_length = 0;
    reduce::SteppedBeam rigid = reduce::backup_beam(stand);
    rigid.barrel.bending = rigid.neck.bending = 1e40;
    rigid.barrel.shear = rigid.neck.shear = 1e40;
    reduce::Flexibilities one;
    one.frame_lower = one.bearing_lower = one.roll_lower = 1;
    return reduce::lower_backup_mass(stand, rigid, one);
  };
  const auto &thin_stand = std::get<FourHigh>(thin.spec), &thick_stand = std::get<FourHigh>(thick.spec);
  EXPECT_TRUE(near(roll_mass(thick_stand) / roll_mass(thin_stand) - 1, 0.0404,
                   within(1e-9, "diameter squared: 1.02^2 = 1.0404 exactly")))
      << "backup_roll.barrel_diameter";
  // Everything of the work roll to the last digit.
  for (const double Roll::*size : {&Roll::barrel_diameter, &Roll::barrel_length, &Roll::neck_diameter,
                                   &Roll::neck_length, &Roll::bearing_span, &Roll::bearing_mass})
    EXPECT_EQ(thin_stand.work_roll.*size, thick_stand.work_roll.*size);
  for (const char *same : {"Kzc2", "Kzc3", "M1", "M6", "K1", "K7", "K4"})
    EXPECT_EQ(find(before, same)->parameter.value, find(after, same)->parameter.value) << same;
  const Trace t = traced({demo, "backup_roll.barrel_diameter", {}, nowhere});
  EXPECT_EQ(t.key.origin, "cases/four-high-1400.toml:33");
}

TEST(Trace, TheTableIsPrintedWordForWord)
{
  // Numbers: Johnson (1985), R 200/650 mm, E 210 GPa, nu 0.3, 1000 N/mm.  Slopes over R2: half width and pressure
  // +-R1/(2(R1 + R2)) = 0.118; approach R2/(R1 + R2)/(ln - 1) = 0.059, tangent the same over ln - 2 = 12.02:
  // 0.064.
  const Trace t = traced({"cases/two-cylinders.toml", "lower.diameter", {}, nowhere});
  EXPECT_EQ(trace_text(t),
            "lower.diameter = 1300 mm  (cases/two-cylinders.toml:17)\n"
            "  -> contact of the two cylinders\n"
            "       contact.line.half_width         0.0012991 m  +0.12 % per %  fem/roll/contact_study (3.2)\n"
            "       contact.line.peak_pressure    4.9005e+08 Pa  -0.12 % per %  fem/roll/contact_study (3.3)\n"
            "       contact.line.approach          3.5931e-05 m  +0.06 % per %  fem/roll/contact_study (3.4)\n"
            "       contact.line.secant         2.7831e+10 N/m2  -0.06 % per %  fem/roll/contact_study (3.5a)\n"
            "       contact.line.tangent        3.0146e+10 N/m2  -0.06 % per %  fem/roll/contact_study (3.5b)\n"
            "Elasticities are differences between 1287 mm .. 1313 mm.\n"
            "Closed forms that stand in for finite elements:\n"
            "  contact.line.half_width, contact.line.peak_pressure, contact.line.approach, contact.line.secant, "
            "contact.line.tangent: Hertz and Johnson, fem/contact/line_bodies (3.2) to (3.5b), for contact finite "
            "elements, fem/roll/contact_study\n"
            "No run is stored to compare with.\n");
  EXPECT_EQ(trace_text(t, false).find("Elasticities"), std::string::npos);
}

// A result that has a value on one side of the key only, or that the run has and the case has not.
TEST(Trace, AMissingValueLeavesTheElasticityEmptyAndIsExplained)
{
  Trace t = traced({"cases/two-cylinders.toml", "lower.diameter", {}, nowhere});
  ASSERT_EQ(t.lines.size(), 5u);
  t.lines.resize(2);
  t.lines[1].slope = t.lines[1].slope_up = t.lines[1].slope_down = std::nan("");
  t.lines[1].result.parameter.value                              = std::nan("");
  t.run_folder                                                   = "out/earlier";
  t.run                                                          = {{"contact.line.peak_pressure", 4.9e8}};
  const std::string text                                         = trace_text(t);
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
  EXPECT_NE(text.find("No elasticity, because the result has no value for this key or for the changed key: "
                      "contact.line.peak_pressure.\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("contact.line.peak_pressure has no value here\n"), std::string::npos) << text;
}

TEST(Trace, UnknownKeysNameTheNearest)
{
  const auto message_of = [](const std::string &key) {
    return refusal([&] { traced({demo, key, {}, nowhere}); });
  };
  EXPECT_EQ(message_of("backup_roll.barel_diameter"),
            "unknown key 'backup_roll.barel_diameter' in cases/four-high-1400.toml; did you mean "
            "'backup_roll.barrel_diameter'?");
  EXPECT_EQ(message_of("bakup_roll.barrel_diameter"),
            "unknown key 'bakup_roll.barrel_diameter' in cases/four-high-1400.toml; did you mean "
            "'backup_roll.barrel_diameter'?");
  EXPECT_EQ(message_of("steel.colour"),
            "unknown key 'steel.colour' in cases/four-high-1400.toml; known: youngs_modulus, "
            "poisson_ratio, density, yield_stress");
  EXPECT_EQ(message_of("nonsense"),
            "unknown key 'nonsense' in cases/four-high-1400.toml; docs/input.md lists the keys of "
            "kind \"four-high\"");
  EXPECT_EQ(refusal([] {
              traced({demo, "steel.density", {"steel.density=-1 kg/m3"}, nowhere});
            }),
            "steel.density = \"-1 kg/m3\" is outside 500 kg/m3 .. 25000 kg/m3");
}

// bending_model = "solid": the ratio of solid roll to beam is the last run's, on the beam of the case.
TEST(Trace, ASolidRollHasTheStiffnessOfTheLastRun)
{
  const std::string folder = testing::TempDir() + "trace-solid";
  std::filesystem::create_directories(folder);
  const auto store = [&](const std::vector<std::string> &sets) {
    write_atomically(folder + "/resolved.toml", read_case(demo, sets).resolved);
  };
  store({});
  const auto bending = [&](const std::vector<std::string> &sets, const std::string &where) {
    return traced({demo, "backup_roll.neck_diameter", sets, where});
  };
  const auto value  = [](const Trace &t) { return line(t, "K_ZW").result.parameter.value; };
  const double beam = value(bending({}, nowhere)), other_beam = value(bending({"strip.width=900 mm"}, nowhere)),
               thick  = value(bending({"backup_roll.neck_diameter=900 mm"}, nowhere));
  const double stored = 0.9 * beam;
  write_atomically(folder + "/results.json",
                   R"({"values": {"K_ZW": {"value": )" + number_text(stored) + R"(}, "M2": {"value": 1}}})");
  EXPECT_TRUE(near(value(bending({}, folder)), stored, within(1e-12, "the solid roll of the run")));
  EXPECT_NE(
      trace_text(bending({}, folder))
          .find(", times 0.9, the solid roll of the last run over its beam, for the roll by finite elements"),
      std::string::npos)
      << trace_text(bending({}, folder));
  EXPECT_NE(trace_text(bending({}, nowhere)).find("K_ZW: stepped Timoshenko beam, "), std::string::npos);
  EXPECT_EQ(trace_text(bending({}, nowhere)).find("times"), std::string::npos);
  EXPECT_TRUE(near(value(bending({"backup_roll.neck_diameter=900 mm"}, folder)), 0.9 * thick,
                   within(1e-12, "the run's ratio on the beam of the case")));
  EXPECT_TRUE(near(value(bending({"strip.width=900 mm"}, folder)), 0.9 * other_beam, within(1e-12, "the same")));
  EXPECT_TRUE(
      near(value(bending({"backup_roll.bending_model=beam"}, folder)), beam, within(1e-12, "asked for a beam")));
  store({"backup_roll.bending_model=beam"});
  EXPECT_TRUE(near(value(bending({}, folder)), beam, within(1e-12, "a run of beams knows no solid roll")));
  std::filesystem::remove_all(folder);
}

TEST(Trace, TheLastRunIsComparedAndCanGiveTheSprings)
{
  EXPECT_EQ(refusal([] {
              traced({demo, "steel.density", {}, nowhere, true});
            }),
            "--full takes the springs of the last run, and there is none in no such folder; run millstand run "
            "cases/four-high-1400.toml first, or leave --full out");
  const std::string folder = testing::TempDir() + "trace-run";
  std::filesystem::create_directories(folder);
  write_atomically(folder + "/resolved.toml", read_case(demo).resolved);
  write_atomically(folder + "/results.json",
                   R"({"values": {"K3": {"value": 2e10}, "M1": {"value": 9320}, "K1": {"value": null}}})");
  const Trace other_key = traced({demo, "given.K3", {}, folder});
  EXPECT_TRUE(other_key.same_inputs);
  EXPECT_NE(trace_text(other_key).find("Values above against the last run (" + folder + "): K3 +101.0 %\n"),
            std::string::npos)
      << trace_text(other_key);
  const Trace full = traced({demo, "steel.youngs_modulus", {}, folder, true});
  EXPECT_TRUE(near(line(full, "K3").result.parameter.value, 2e10, within(1e-12, "taken over")));
  const Trace closed = traced({demo, "steel.youngs_modulus", {}, folder});
  EXPECT_TRUE(
      near(line(full, "K3").slope, line(closed, "K3").slope, within(1e-9, "the same change, another size")));
  EXPECT_GT(std::abs(line(full, "f6").slope - line(closed, "f6").slope), 1e-3) << "a softer K3 carries more of it";
  const Trace other = traced({demo, "steel.density", {"strip.width=900 mm"}, folder});
  EXPECT_FALSE(other.same_inputs);
  EXPECT_NE(trace_text(other).find(", with other inputs): "), std::string::npos);
  std::filesystem::remove_all(folder);
}

// The closed form is a beam whatever bending_model says, so that only a run can show what it moves.
TEST(Trace, TheBendingModelReachesTheStiffnessOfTheBackupRoll)
{
  const std::string text = trace_text(traced({demo, "backup_roll.bending_model", {}, nowhere}));
  EXPECT_EQ(text.find("reaches no result"), std::string::npos) << text;
  EXPECT_NE(text.find("K_ZW"), std::string::npos) << text;
}
