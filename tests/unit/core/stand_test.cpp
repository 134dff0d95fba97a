// Whole cases: values arrive in SI, the echo reads back as the same case, templates and schema come from the same
// rows.
#include "core/base/files.h"
#include "core/case/input_reference.h"
#include "core/case/stand_rows.h"
#include "core/model/bite_case.h"
#include "core/model/case.h"
#include "core/model/four_high.h"
#include "core/model/lumped.h"
#include "tests/support/case_folder.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "tests/support/refusal.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

using namespace mill;

namespace {
constexpr double deg = 3.14159265358979323846 / 180;

class Cases : public CaseFolder {};

// Everything that follows from the text of a case, without the marks of the defaults and the absolute paths.
std::string values_of(const Case &c)
{
  std::string text = c.resolved;
  for (std::size_t position; (position = text.find("  # default")) != std::string::npos;)
    text.erase(position, std::string("  # default").size());
  return text;
}

// Same double, or both not given.
testing::AssertionResult same(const double a, const double b)
{
  return a == b || (std::isnan(a) && std::isnan(b)) ? testing::AssertionSuccess()
                                                    : testing::AssertionFailure() << a << " and " << b;
}

template <class T> void expect_same(const std::vector<Field<T>> &fields, const T &a, const T &b)
{
  for (const Field<T> &field : fields)
    EXPECT_EQ(toml_of(row_of(field), member_value(field, a)), toml_of(row_of(field), member_value(field, b)))
        << field.key;
}
}  // namespace

TEST_F(Cases, TheDemoStandIsReadInSi)
{
  const Case c = read_case("cases/four-high-1400.toml");
  EXPECT_EQ(c.name, "four-high-1400");
  EXPECT_EQ(c.kind, "four-high");
  EXPECT_EQ(c.title, "1400 four-high, demo stand");
  const auto &stand = std::get<FourHigh>(c.spec);
  EXPECT_EQ(stand.steel.youngs_modulus, 210e9);
  EXPECT_EQ(stand.steel.density, 7700);
  EXPECT_EQ(stand.work_roll.barrel_diameter, 0.420);
  EXPECT_TRUE(near(stand.work_roll.neck_length, 0.460, within(1e-15, "one subtraction of rounded numbers")));
  EXPECT_EQ(stand.work_roll.chock_mass_lower, 880);
  EXPECT_EQ(stand.backup_roll.barrel_diameter, 1.450);
  EXPECT_EQ(stand.backup_roll.neck_length, 0.950);
  ASSERT_EQ(stand.bearings.size(), 2u);
  const RollerBearing &trb = bearing_of(stand.bearings, stand.work_roll.bearing);
  EXPECT_EQ(trb.name, "trb");
  EXPECT_EQ(trb.rollers_per_row, 39);
  EXPECT_TRUE(near(trb.cup_angle, 19.66 * deg, within(1e-15, "one factor")));
  EXPECT_EQ(trb.profile, RollerProfile::iso);
  EXPECT_EQ(bearing_of(stand.bearings, "crb").roller_law, OneRollerLaw::palmgren);
  EXPECT_TRUE(std::isnan(bearing_of(stand.bearings, "crb").bore));
  EXPECT_EQ(stand.frame.upper_beam_stiffness, 7.30e9);
  EXPECT_EQ(stand.frame.oil_column_stiffness, 1.80e10);
  EXPECT_TRUE(std::isnan(stand.frame.chock_to_housing_stiffness));
  EXPECT_EQ(stand.strip.flow_stress.k, 28e6);
  ASSERT_EQ(stand.passes.size(), 2u);
  EXPECT_EQ(stand.passes[0].force_file, "cases/data/pass-1.csv");
  EXPECT_TRUE(stand.passes[0].synthetic);
  EXPECT_TRUE(near(stand.passes[1].published_peak_g[1], 1.30, within(4e-16, "to m/s2 and back")));
  EXPECT_EQ(stand.upper_contact.loads[1], 2e6);
  EXPECT_EQ(stand.dynamics.modal_damping, 0.01);
  EXPECT_EQ(stand.dynamics.output_rate, 20e3);
  EXPECT_EQ(c.places.at("work_roll.barrel_diameter").file, "cases/four-high-1400.toml");
  EXPECT_GT(c.places.at("work_roll.barrel_diameter").line, 0);
  EXPECT_EQ(c.places.count("bearing.crb.slices"), 0u);
}

TEST_F(Cases, ThePublishedModelHasThePublishedNumbers)
{
  const Case c      = read_case("cases/published-1400.toml");
  const auto &given = std::get<Lumped>(c.spec).given;
  const auto M = reference_vector("published.M"), K = reference_vector("published.K");
  const auto tolerance = within(4e-16, "one change of unit");
  for (int i = 0; i < 6; ++i)
    EXPECT_TRUE(near(given.at("M" + std::to_string(i + 1)).parameter.value, M[i], tolerance));
  for (int i = 0; i < 7; ++i)
    EXPECT_TRUE(near(given.at("K" + std::to_string(i + 1)).parameter.value, K[i], tolerance));
  EXPECT_TRUE(near(given.at("Kzc2").parameter.value, reference("published.Kzc").get<double>(), tolerance));
  EXPECT_EQ(given.at("K3").parameter.source, Source::published);
  EXPECT_EQ(given.at("K3").parameter.unit, "N/m");
  EXPECT_EQ(given.at("C").parameter.value, 1.91141e5);
  EXPECT_EQ(std::get<Lumped>(c.spec).dynamics.force_meaning, ForceMeaning::published);
}

TEST_F(Cases, ATwoCylindersCaseIsReadInSi)
{
  const auto pair = std::get<TwoCylinders>(read_case("cases/two-cylinders.toml").spec);
  EXPECT_EQ(pair.upper.diameter, 0.4);
  EXPECT_EQ(pair.lower.diameter, 1.3);
  EXPECT_EQ(pair.steel.poisson_ratio, 0.3);
  EXPECT_EQ(pair.contact.length, 0.1);
  EXPECT_EQ(pair.contact.loads[0], 200e3);
  EXPECT_EQ(pair.contact.at, 1e6);
}

TEST_F(Cases, ABearingCaseIsReadInSi)
{
  const auto spec          = std::get<BearingCase>(read_case("cases/bearing-266.toml").spec);
  const RollerBearing &trb = bearing_of(spec.bearings, spec.load.bearing);
  EXPECT_EQ(trb.roller_law, OneRollerLaw::fe);
  EXPECT_EQ(trb.rings, RingBodies::elastic);
  EXPECT_EQ(trb.arrangement, "+-+-");
  EXPECT_EQ(spec.load.radial, 1e6);
  EXPECT_EQ(spec.load.loads[1], 4e6);
  EXPECT_TRUE(std::isnan(spec.motion.mass));
  EXPECT_TRUE(same(spec.published.at("row1_roller").parameter.value, 6.78395e8));
}

// Values that the drawing of a bearing leaves out follow from the others, and are reported.
TEST_F(Cases, AMissingMemberOfTheApexConditionIsComputed)
{
  const std::string whole = read_text("cases/bearing-266.toml");
  const auto without      = [&](const std::string &key) {
    const auto begin = whole.find(key + " "), end = whole.find('\n', begin);
    const auto spec =
        std::get<BearingCase>(read_case(file("b.toml", whole.substr(0, begin) + whole.substr(end + 1))).spec);
    return spec.bearings.at(0);
  };
  const double degree = 3.14159265358979323846 / 180;
  // The given cup angle is rounded to 0.01 deg; the closing values of the drawing's other members are those of the
  // table in which it closes (D_pw 311.15, D_we 21.5, 2.5 deg: 19.66 deg).
  const auto rounded = within(6e-4, "a cup angle known to 0.005 deg");
  EXPECT_TRUE(near(without("cup_angle").cup_angle, 19.66 * degree, rounded));
  EXPECT_TRUE(near(without("roller_diameter").roller_diameter, 21.5e-3, rounded));
  EXPECT_TRUE(near(without("roller_cone_angle").roller_cone_angle, 2.5 * degree, rounded));
  EXPECT_EQ(without("cup_angle").filled.size(), 3u) << "it, and the support of the chock";
  EXPECT_NE(without("cup_angle").filled[0].find("bearing.trb.cup_angle is not given: 19.66 deg"),
            std::string::npos);
  EXPECT_EQ(without("chock_width").filled.at(0),
            "bearing.trb.chock_width is not given: 604.52 mm assumed, 1.7 outside diameters");
}

TEST_F(Cases, AnOldNameOfAKeyIsAcceptedWithAWarning)
{
  const std::string file = "cases/bearing-266.toml";
  const Case old         = read_case(file, {"bearing.trb.row_hands=-+-+"});
  EXPECT_EQ(std::get<BearingCase>(old.spec).bearings.at(0).arrangement, "-+-+");
  ASSERT_EQ(old.warnings.size(), 1u);
  EXPECT_EQ(old.warnings[0].id, WarningId::old_key);
  EXPECT_EQ(text_of(old.warnings[0]),
            "bearing.trb.row_hands is the old name of the key arrangement; write arrangement");
  EXPECT_NE(old.resolved.find("\narrangement = \"-+-+\"\n"), std::string::npos) << "the present name";
  EXPECT_EQ(refusal([&] {
              read_case(file, {"bearing.trb.row_hands=-+-+", "bearing.trb.arrangement=-+-+"});
            })
                .rfind("unknown key 'row_hands' in [bearing.trb]; it was replaced by 'arrangement' after version "
                       "0.1.0: write "
                       "the value under the new name",
                       0),
            0u);
}

TEST_F(Cases, TheArrangementOfTheRowsMustBeConfirmed)
{
  const auto trb = [](const std::vector<std::string> &sets) {
    return std::get<BearingCase>(read_case("cases/bearing-266.toml", sets).spec).bearings.at(0);
  };
  EXPECT_TRUE(trb({}).arrangement_assumed);
  EXPECT_FALSE(trb({"bearing.trb.arrangement=+-+-"}).arrangement_assumed);
  EXPECT_FALSE(trb({"bearing.trb.rows=1"}).arrangement_assumed);
  EXPECT_EQ(trb({"bearing.trb.rows=2", "bearing.trb.arrangement=+-"}).arrangement, "+-");
  EXPECT_EQ(refusal([&] {
              trb({"bearing.trb.rows=2", "bearing.trb.arrangement=-+-+"});
            }),
            "bearing.trb.arrangement = \"-+-+\" arranges 4 rows; the bearing has 2");
  EXPECT_EQ(trb({"bearing.trb.arrangement=back-to-back"}).arrangement, "+-+-");
  EXPECT_EQ(trb({"bearing.trb.rows=2", "bearing.trb.arrangement=face-to-face"}).arrangement, "-+");
  EXPECT_EQ(arrangement_name("+-+-", 2), "+-, back to back (TDO)");
  EXPECT_EQ(arrangement_name("-+", 4), "-+-+, pairs face to face: two double cones (TQO)");
  EXPECT_EQ(usual_arrangements(2), (std::vector<std::string>{"-+", "+-"}));
  EXPECT_EQ(usual_arrangements(4).size(), 4u);
  EXPECT_TRUE(usual_arrangements(1).empty());
}

// A chock inside Kzc is not a spring of the chain, and the chock of a backup roll is not carried by two feet.
TEST_F(Cases, AChockEntersTheChainOnce)
{
  const std::vector<std::string> drawn{"bearing.crb.bore=950 mm", "bearing.crb.outside_diameter=1200 mm",
                                       "bearing.crb.width=520 mm", "bearing.crb.roller_law=iso"};
  const auto stand = [&](const std::string &more) {
    std::vector<std::string> sets = drawn;
    sets.push_back(more);
    return std::get<FourHigh>(read_case("cases/four-high-1400.toml", sets).spec);
  };
  const auto elastic = stand("bearing.crb.rings=elastic");
  EXPECT_TRUE(std::isinf(elastic.frame.upper_chock_stiffness));
  EXPECT_TRUE(std::isinf(elastic.frame.lower_chock_stiffness));
  const RollerBearing &crb = bearing_of(elastic.bearings, "crb");
  EXPECT_TRUE(crb.support_assumed);
  EXPECT_TRUE(std::isnan(crb.chock_support_gap));
  EXPECT_TRUE(near(bearing_of(elastic.bearings, "trb").chock_support_gap, 0.4,
                   within(1e-12, "read from millimetres and added: rounding", 1)));
  const auto &notes = crb.filled;
  EXPECT_EQ(std::count_if(notes.begin(), notes.end(),
                          [](const auto &text) { return text.find("already includes") != std::string::npos; }),
            2);
  EXPECT_EQ(stand("bearing.crb.chock=rigid").frame.upper_chock_stiffness, 1.03e11);
  EXPECT_EQ(stand("bearing.crb.rings=rigid").frame.upper_chock_stiffness, 1.03e11);
}

TEST_F(Cases, LawAndRingsFollowTheDrawing)
{
  const auto stand = std::get<FourHigh>(read_case("cases/four-high-1400.toml").spec);
  EXPECT_EQ(bearing_of(stand.bearings, "trb").roller_law, OneRollerLaw::fe);
  EXPECT_EQ(bearing_of(stand.bearings, "trb").rings, RingBodies::elastic);
  EXPECT_EQ(bearing_of(stand.bearings, "crb").rings, RingBodies::rigid);
  const auto plain = read_case("cases/bearing-266.toml", {"model.roller_law=iso", "model.rings=rigid"});
  const auto &trb  = std::get<BearingCase>(plain.spec).bearings.at(0);
  EXPECT_EQ(trb.roller_law, OneRollerLaw::iso);
  EXPECT_EQ(trb.rings, RingBodies::rigid);
}

TEST_F(Cases, TheResolvedCaseReadsBackAsTheSameCase)
{
  for (const char *path : {"cases/four-high-1400.toml", "cases/published-1400.toml", "cases/two-cylinders.toml",
                           "cases/bearing-266.toml"}) {
    const Case first = read_case(path);
    const Case again = read_case(file("resolved.toml", first.resolved));
    EXPECT_EQ(values_of(first), values_of(again)) << path;
    EXPECT_EQ(again.resolved.find("# default"), std::string::npos) << "an echo says everything";
  }
  const auto a = std::get<FourHigh>(read_case("cases/four-high-1400.toml").spec);
  const auto b =
      std::get<FourHigh>(read_case(file("resolved.toml", read_case("cases/four-high-1400.toml").resolved)).spec);
  expect_same(backup_roll_rows(), a.work_roll, b.work_roll);
  expect_same(backup_roll_rows(), a.backup_roll, b.backup_roll);
  expect_same(bearing_rows(), a.bearings[0], b.bearings[0]);
  expect_same(frame_rows(), a.frame, b.frame);
  expect_same(strip_rows(), StripInput{a.strip, a.strip.friction.coefficient},
              StripInput{b.strip, b.strip.friction.coefficient});
  EXPECT_TRUE(same(a.bearings[0].cup_angle, b.bearings[0].cup_angle));
  EXPECT_TRUE(same(a.work_roll.neck_length, b.work_roll.neck_length));
}

// Numbers without a short decimal form survive the way through the text.
TEST_F(Cases, TheResolvedCaseKeepsEveryDigit)
{
  const std::string text = template_of("two-cylinders");
  const unsigned seed    = 99;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> diameter(1, 5000);
  for (int i = 0; i < 200; ++i) {
    char set[80];
    std::snprintf(set, sizeof set, "upper.diameter=%.17g mm", diameter(random));
    const Case first = read_case(file("a.toml", text), {set});
    const Case again = read_case(file("b.toml", first.resolved));
    EXPECT_TRUE(
        same(std::get<TwoCylinders>(first.spec).upper.diameter, std::get<TwoCylinders>(again.spec).upper.diameter))
        << set << ", seed " << seed;
  }
}

TEST_F(Cases, OverridesAreCheckedLikeTheFile)
{
  const Case c = read_case("cases/two-cylinders.toml", {"upper.diameter=0.5 m", "contact.line.samples=30"});
  EXPECT_EQ(std::get<TwoCylinders>(c.spec).upper.diameter, 0.5);
  EXPECT_EQ(std::get<TwoCylinders>(c.spec).contact.samples, 30);
  EXPECT_EQ(c.places.at("upper.diameter").file, "--set upper.diameter=0.5 m");
  try {
    read_case("cases/two-cylinders.toml",
              {"upper.diametre=0.5 m", "lower.diameter=5 kg", "steel.poisson_ratio=0.7"});
    FAIL() << "accepted";
  } catch (const InputError &error) {
    EXPECT_STREQ(error.what(),
                 "--set lower.diameter=5 kg: error: lower.diameter = \"5 kg\" is a mass; a length is needed, for "
                 "example \"1300 mm\"\n"
                 "--set steel.poisson_ratio=0.7: error: steel.poisson_ratio = 0.7 is outside 0 .. 0.49\n"
                 "--set upper.diametre=0.5 m: error: unknown key 'diametre' in [upper]; did you mean 'diameter'?");
  }
}

// Every quantity of [frame] and [given] may say how far it is off; that becomes its error, and is kept.
TEST_F(Cases, AToleranceIsTheErrorOfItsValue)
{
  const std::string path = "cases/four-high-1400.toml";
  const Case c           = read_case(path, {"frame.upper_post_stiffness_tolerance=5 %", "given.K3=4e4 kN/mm",
                                            "given.K3_tolerance=2 %", "given.K1=6e3 kN/mm"});
  const auto &stand      = std::get<FourHigh>(c.spec);
  EXPECT_EQ(stand.frame.tolerance, (std::map<std::string, double>{{"upper_post_stiffness", 0.05}}));
  EXPECT_EQ(stand.given.at("K3").parameter.error_estimate, 0.02);
  EXPECT_TRUE(std::isnan(stand.given.at("K1").parameter.error_estimate));
  EXPECT_EQ(stand.given.at("K1").parameter.error_lacks, std::vector<std::string>{"given.K1_tolerance"});
  EXPECT_EQ(values_of(read_case(file("b.toml", c.resolved))), values_of(c));
  const Case lumped = read_case("cases/published-1400.toml", {"given.M3_tolerance=10 %"});
  EXPECT_EQ(std::get<Lumped>(lumped.spec).given.at("M3").parameter.error_estimate, 0.1);
}

TEST_F(Cases, AToleranceBelongsToAValue)
{
  const std::string path = "cases/four-high-1400.toml";
  const auto message_of  = [&](const std::vector<std::string> &sets) {
    return refusal([&] { read_case(path, sets); });
  };
  EXPECT_EQ(message_of({"given.K3_tolerance=2 %"}),
            "given.K3_tolerance = \"2 %\" belongs to given.K3, which is not given; give both or neither");
  EXPECT_EQ(
      message_of({"frame.load_cell_stiffness_tolerance=2 %"}),
      "frame.load_cell_stiffness_tolerance = \"2 %\" belongs to frame.load_cell_stiffness, which is not given; "
      "give both or neither");
  EXPECT_EQ(message_of({"frame.piston_mass_tolerance=200 %"}),
            "frame.piston_mass_tolerance = \"200 %\" is outside 0 % .. 100 %");
  EXPECT_EQ(message_of({"backup_roll.bending_model=euler"}).find("backup_roll.bending_model"), 0u);
  std::string text = read_text("cases/published-1400.toml");
  text.replace(text.find("{ value = \"9321.943 kg\",   source = \"published\" }"),
               std::string("{ value = \"9321.943 kg\",   source = \"published\" }").size(),
               "{ value = \"9321.943 kg\", error_estimate = 0.1 }\nM1_tolerance = \"3 %\"");
  EXPECT_EQ(refusal([&] { read_case(file("cases.toml", text)); }),
            "given.M1_tolerance = \"3 %\" repeats or contradicts the error estimate of the value; leave one of "
            "the two out");
}

TEST_F(Cases, FrictionIsANumberOrALaw)
{
  const std::string path = file("a.toml", template_of("bite"));
  EXPECT_EQ(std::get<BiteCase>(read_case(path).spec).strip.friction.coefficient, 0.2);
  EXPECT_EQ(std::get<BiteCase>(read_case(path).spec).strip.friction.law, FrictionLaw::coulomb);
  const std::vector<std::string> speed{
      "strip.friction={ law = \"speed\", at_unit_speed = 0.066723, per_log_speed = "
      "-0.00662 }",
      "pass.0.speed=178 m/min"};
  const Case c = read_case(path, speed);
  EXPECT_EQ(std::get<BiteCase>(c.spec).strip.friction.per_log_speed, -0.00662);
  const Case again = read_case(file("b.toml", c.resolved));
  EXPECT_EQ(values_of(c), values_of(again));
  EXPECT_EQ(std::get<BiteCase>(again.spec).strip.friction.law, FrictionLaw::speed);
}

TEST_F(Cases, APassMayHaveItsOwnThicknessesAndPeaks)
{
  const std::string path = file("a.toml", template_of("four-high"));
  const Case c           = read_case(path, {"pass.0.entry_thickness=6 mm", "pass.0.exit_thickness=4 mm",
                                            "pass.0.load=900 kN", "pass.0.measured_peak=[\"1.20 g\", \"0.60 g\"]"});
  const Pass &pass       = std::get<FourHigh>(c.spec).passes[0];
  EXPECT_EQ(pass.entry_thickness, 0.006);
  EXPECT_EQ(pass.exit_thickness, 0.004);
  EXPECT_EQ(pass.load, 900e3);
  EXPECT_TRUE(near(pass.measured_peak_g[0], 1.20, within(4e-16, "to m/s2 and back")));
  EXPECT_TRUE(std::isnan(pass.published_peak_g[0]));
}

TEST_F(Cases, APassWithoutAForceFileIsMarkedSynthetic)
{
  std::string text = template_of("four-high");
  for (std::size_t position; (position = text.find("synthetic = true")) != std::string::npos;)
    text.replace(position, 16, "# nothing");
  const Case c = read_case(file("a.toml", text));
  EXPECT_TRUE(std::get<FourHigh>(c.spec).passes[0].synthetic);
}

TEST_F(Cases, EveryTemplateRunsAndNamesEveryKey)
{
  for (const std::string &kind : case_kinds()) {
    const std::string text = template_of(kind);
    const Case c           = read_case(file(kind + ".toml", text));
    EXPECT_EQ(c.kind, kind);
    for (const SectionRows &section : sections_of(kind))
      for (const Row &row : section.rows)
        if (!is_tolerance(row.key))  // one for each value, explained once in the meaning of the section
          EXPECT_NE(text.find(row.key + " = "), std::string::npos)
              << kind << ": " << section.name << "." << row.key;
  }
  EXPECT_THROW(template_of("fourhigh"), InputError);
}

TEST_F(Cases, TheInputReferenceInTheTreeIsCurrent)
{
  EXPECT_EQ(read_text("docs/input.md"), input_reference())
      << "docs/input.md is printed by input_reference(); replace it by the new text";
}

TEST_F(Cases, TheSchemaHasEveryKeyAndNoOther)
{
  const auto schema = nlohmann::json::parse(case_schema());
  EXPECT_EQ(schema.at("$schema"), "http://json-schema.org/draft-07/schema#");
  const auto &branches = schema.at("allOf");
  ASSERT_EQ(branches.size(), case_kinds().size());
  EXPECT_EQ(schema.at("properties").at("kind").at("enum"), nlohmann::json(case_kinds()));
  std::vector<nlohmann::json> kinds;
  for (std::size_t i = 0; i < branches.size(); ++i) {
    EXPECT_EQ(branches[i].at("if").at("properties").at("kind").at("const"), case_kinds()[i]);
    kinds.push_back(branches[i].at("then"));
    EXPECT_EQ(kinds[i].at("properties").at("kind").at("const"), case_kinds()[i]);
    for (const SectionRows &section : sections_of(case_kinds()[i])) {
      nlohmann::json object = kinds[i];
      for (const std::string &part : split(section.name, "."))
        if (!part.empty()) {
          if (object.contains("items"))  // a section of each of a list
            object = nlohmann::json(object.at("items"));
          object = object.at("properties").at(part);
          if (object.contains("anyOf"))  // friction = 0.2 or { law = ... }
            object = nlohmann::json(object.at("anyOf").at(1));
        }
      if (section.repeat == SectionRows::Repeat::list)
        object = object.at("items");
      if (section.repeat == SectionRows::Repeat::named)
        object = object.at("additionalProperties");
      if (object.contains("if"))  // rollers or an oil film
        object = nlohmann::json(object.at(section.type.empty() ? "else" : "then"));
      EXPECT_EQ(object.at("additionalProperties"), false) << section.name;
      for (const Row &row : section.rows) {
        ASSERT_TRUE(object.at("properties").contains(row.key)) << section.name << "." << row.key;
        EXPECT_NE(object["properties"][row.key].at("description").get<std::string>().find(row.meaning),
                  std::string::npos);
      }
    }
  }
}

// Cases that contradict mechanics or geometry are refused by name in tests/regression/broken_cases_test.cpp; here
// the apex condition sin(alpha_m) = (D_pw/D_we) tan(beta) with cup angles computed outside the program.
TEST_F(Cases, TheApexConditionClosesWithTheReferenceAngles)
{
  const std::string path = file("a.toml", template_of("four-high"));
  const auto set         = [](const char *diameter, const char *angle) {
    return std::vector<std::string>{std::string("bearing.trb.roller_diameter=") + diameter,
                                    std::string("bearing.trb.cup_angle=") + angle};
  };
  EXPECT_NO_THROW(read_case(path, set("20 mm", "21.09 deg")));
  EXPECT_NO_THROW(read_case(path, set("21.5 mm", "19.66 deg")));
  EXPECT_NO_THROW(read_case(path, set("23 mm", "18.42 deg")));
  EXPECT_NO_THROW(read_case(path, set("21.5 mm", "20.1 deg")));  // within half a degree
  EXPECT_THROW(read_case(path, set("21.5 mm", "20.2 deg")), InputError);
  EXPECT_THROW(read_case(path, set("20 mm", "19.66 deg")), InputError);
  try {
    read_case(path, set("21.5 mm", "13.5 deg"));
    FAIL() << "13.5 deg would need a roller of 32 mm";
  } catch (const InputError &error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("19.66 deg"), std::string::npos) << message;  // the cup angle that closes it
    // 311.15 mm tan(1.25 deg) / sin(13.5 deg - 1.25 deg)
    EXPECT_NE(message.find("roller_diameter = \"31.998"), std::string::npos) << message;
  }
}
