#include "app/stages/response/dynamics_stage.h"
#include "app/studio/answers/case_keys.h"
#include "app/studio/answers/check_answer.h"
#include "app/studio/answers/quick_answer.h"
#include "core/base/units.h"
#include "core/case/case_edit.h"
#include "core/case/input_reference.h"
#include "core/case/kinds.h"
#include "core/model/case.h"
#include "core/model/four_high.h"
#include "tests/support/near.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace studio = mill::studio;
using nlohmann::ordered_json;

namespace {
const std::string path = std::string(MILLSTAND_SOURCE_DIR) + "/cases/studio.toml";

ordered_json checked(const std::string &text)
{
  return studio::check_json(studio::check_answer(path, text), text);
}

std::string stand()
{
  return mill::template_of("four-high");
}

// A cold strip, which bears tensions that the soft one of the template does not, and all that the critical speed
// needs.
std::string rolling_stand()
{
  std::string text = stand();
  for (const auto &[key, toml] : {std::pair("strip.entry_thickness", "\"2.2 mm\""),
                                  {"strip.exit_thickness", "\"1.6 mm\""},
                                  {"strip.friction", "0.06"},
                                  {"strip.flow_stress.k", "\"520 MPa\""},
                                  {"pass.0.synthetic_range", "[\"9.4 MN\", \"9.6 MN\"]"},
                                  {"pass.0.speed", "\"16 m/s\""},
                                  {"pass.0.entry_tension", "\"120 MPa\""},
                                  {"pass.0.exit_tension", "\"150 MPa\""}})
    text = mill::with_value(text, key, toml);
  return text;
}
}  // namespace

TEST(StudioAnswers, TheSchemaHasEveryRowAndTheUnitsOfItsQuantity)
{
  const auto schema = ordered_json::parse(studio::schema_json("four-high"));
  int rows = 0, with_units = 0, pictures = 0;
  for (const auto &section : schema["sections"])
    for (const auto &row : section["rows"]) {
      ++rows;
      pictures += row.contains("picture");
      if (!row.contains("units"))
        continue;
      if (row["form"] == "1") {
        EXPECT_TRUE(row["units"].empty()) << "a factor has no unit to choose: " << row.dump();
        continue;
      }
      ++with_units;
      bool has_its_unit = false;
      for (const auto &unit : row["units"]) {
        EXPECT_TRUE(schema["units"].contains(unit.get<std::string>()));
        has_its_unit |=
            mill::find_unit(unit.get<std::string>()) == mill::find_unit(row["form"].get<std::string>());
      }
      EXPECT_TRUE(has_its_unit) << row.dump();
    }
  EXPECT_GT(rows, 250);
  EXPECT_GT(with_units, 100);
  EXPECT_EQ(pictures, 28);
}

// Every key that says it is drawn moves the length of the drawing that it names, and no other key of the drawing.
TEST(StudioAnswers, AKeyMovesTheLengthThatItIsDrawnBy)
{
  const std::string text = stand();
  const auto before      = checked(text)["geometry"];
  int moved              = 0;
  for (const auto &value : mill::written_values(text)) {
    const std::string picture = studio::picture_of(value.key);
    if (picture.empty())
      continue;
    const auto quantity = mill::parse_quantity(value.text);
    ASSERT_NE(quantity.unit, nullptr) << value.key;
    const std::string longer =
        "\"" + mill::number_text(quantity.number * 1.002) + " " + quantity.unit->symbol + "\"";
    std::string moved_text = mill::with_value(text, value.key, longer);
    if (value.key == "work_roll.neck_diameter")  // the bearing fits its neck
      moved_text = mill::with_value(moved_text, "bearing.trb.bore", longer);
    const auto next = checked(moved_text);
    ASSERT_TRUE(next.contains("geometry")) << value.key << next["problems"].dump();
    EXPECT_TRUE(near(next["geometry"][picture].get<double>(), 1.002 * before[picture].get<double>(),
                     within(1e-9, "the length of the key itself")))
        << value.key;
    ++moved;
  }
  EXPECT_GE(moved, 10);
}

TEST(StudioAnswers, AProblemNamesItsKey)
{
  const std::string wrong = mill::with_value(stand(), "work_roll.barrel_diameter", "\"420 bar\"");
  const auto answer       = checked(wrong);
  ASSERT_EQ(answer["problems"].size(), 1u) << answer["problems"].dump();
  EXPECT_EQ(answer["problems"][0]["severity"], "error");
  EXPECT_EQ(answer["problems"][0]["key"], "work_roll.barrel_diameter");
  EXPECT_FALSE(answer.contains("geometry"));
}

// '.' and '/' are escaped where a name is part of a key, and "check" prints the name.
TEST(StudioAnswers, ANameOfTheUserStandsAsItWasTyped)
{
  const auto answer = checked(
      mill::with_value(mill::with_value(stand(), "pass.0.name", "\"2.0 mm/A\""), "strip.width", "\"300 mm\""));
  const std::string facts = answer["facts"].dump(), problems = answer["problems"].dump();
  EXPECT_NE(facts.find("2.0 mm/A: the noise"), std::string::npos) << facts;
  EXPECT_NE(problems.find("2.0 mm/A: by the slab theory"), std::string::npos) << problems;
  EXPECT_EQ((facts + problems).find("%2"), std::string::npos) << facts << problems;
}

TEST(StudioAnswers, TheQuickAnswerIsTheClosedFormOfTrace)
{
  mill::ClosedFormMemory memory, of_trace;
  const mill::Case the_case = mill::read_case_of(path, rolling_stand());
  const auto quick          = studio::quick_answer(the_case, memory);
  of_trace.with_responses   = false;
  const auto closed         = mill::closed_form_chain(the_case, of_trace);
  ASSERT_EQ(quick.results.size(), closed.size());
  for (std::size_t i = 0; i < closed.size(); ++i) {
    EXPECT_EQ(quick.results[i].name, closed[i].name);
    EXPECT_EQ(quick.results[i].parameter.value, closed[i].parameter.value) << closed[i].name;
  }
  for (const char *name : {"K3", "K5", "Kzc1", "M1", "M6", "stand.modulus.kiss", "mode.gap_first_kind.frequency"})
    EXPECT_NE(mill::find(quick.results, name), nullptr) << name;
  ASSERT_EQ(quick.speeds.size(), mill::all_passes(the_case).size());
  const auto &speed = quick.speeds[0];
  EXPECT_LT(speed.low, speed.critical) << mill::sentence_of(speed);
  EXPECT_GT(speed.high, speed.critical);
}

// "1 % of K3 moves the gap mode by ..": against the frequency of six masses with that spring changed.
TEST(StudioAnswers, TheMoveOfAModeIsThatOfTheChangedSpring)
{
  mill::ClosedFormMemory memory;
  const auto answer  = studio::quick_answer(mill::read_case_of(path, rolling_stand()), memory, false);
  const auto closed  = memory.stands.front();
  std::size_t number = 0;
  while (answer.modes.at(number).key != "gap_first_kind")
    ++number;
  const auto frequency = [&](const double factor) {
    mill::LumpedModel model = closed.model;
    model.K[2].value *= factor;
    return mill::chain_modes(model, mill::in_state(closed.stand->dynamics, mill::GapState::rolling))
        .modes.frequency[Eigen::Index(number)];
  };
  const auto move = std::find_if(answer.moves.begin(), answer.moves.end(), [](const studio::QuickMove &m) {
    return m.input == "K3" && m.mode == "gap_first_kind";
  });
  ASSERT_NE(move, answer.moves.end());
  const double slope = std::log(frequency(1.001) / frequency(0.999)) / std::log(1.001 / 0.999);
  EXPECT_TRUE(near(move->slope, slope, within_absolute(1e-5, "second order of a difference of 0.1 %")));
}
