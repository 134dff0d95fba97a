// A template filled from a sheet, and what of a template somebody has forgotten to replace.
#include "core/base/files.h"
#include "core/case/case_sheet.h"
#include "core/case/case_template.h"
#include "core/case/input_reference.h"
#include "core/model/case.h"
#include "tests/support/refusal.h"
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>

using namespace mill;

namespace {
class Sheets : public testing::Test {
protected:
  std::string path = (std::filesystem::path(testing::TempDir()) / "millstand_sheet_test.toml").string();
  void TearDown() override
  {
    std::filesystem::remove(path);
  }
  Case filled(const std::string &sheet)
  {
    write_atomically(path, template_from_sheet("four-high", "sheet.csv", sheet));
    return read_case(path);
  }
  /// Line and message of every problem.
  std::string refused(const std::string &sheet)
  {
    try {
      template_from_sheet("four-high", "sheet.csv", sheet);
    } catch (const InputError &error) {
      return error.what();
    }
    return "accepted";
  }
};
}  // namespace

TEST_F(Sheets, FillTheTemplate)
{
  const Case c      = filled("key,value,unit\n"
                                  "work_roll.barrel_diameter,650,mm\n"
                                  "work_roll.neck_diameter,\"250 mm\"\n"
                                  "\n"
                                  "# bearings by their catalogue number\n"
                                  "bearing.crb.roller_length,115 mm,\n"
                                  "bearing.trb.roller_diameter,\n"
                                  "strip.friction,0.06\n"
                                  "title,\"tandem, stand 4\"\n"
                                  "pass.load,12,MN\n");
  const auto &stand = std::get<FourHigh>(c.spec);
  EXPECT_EQ(c.title, "tandem, stand 4");
  EXPECT_EQ(stand.work_roll.barrel_diameter, 0.65);
  EXPECT_EQ(stand.work_roll.neck_diameter, 0.25);
  EXPECT_EQ(stand.strip.friction.coefficient, 0.06);
  ASSERT_EQ(stand.passes.size(), 1u);
  EXPECT_EQ(stand.passes[0].load, 12e6);
  EXPECT_FALSE(stand.passes[0].synthetic) << "the noise of the template goes with its load";
}

TEST_F(Sheets, ASheetMayUseDecimalCommasAndSemicolons)
{
  const Case c      = filled("\xef\xbb\xbfkey;value;unit\r\n"
                                  "strip.entry_thickness;2,85;mm\r\n"
                                  "strip.friction;0,07\r\n"
                                  "bearing.crb.rollers_per_row;34\r\n"
                                  "strip.exit_thickness;\"1,9 mm\"\r\n");
  const auto &stand = std::get<FourHigh>(c.spec);
  EXPECT_EQ(stand.strip.entry_thickness, 2.85e-3);
  EXPECT_EQ(stand.strip.exit_thickness, 1.9e-3);
  EXPECT_EQ(stand.strip.friction.coefficient, 0.07);
  EXPECT_EQ(bearing_of(stand.bearings, "crb").rollers_per_row, 34);
}

TEST_F(Sheets, TheTwoValuesOfAPairStandInOneCellOrSideBySide)
{
  for (const char *row : {"pass.synthetic_range,3.55 MN; 3.65 MN\n", "pass.synthetic_range,3.55; 3.65,MN\n",
                          "pass.synthetic_range,3.55; 3.65 MN\n", "pass.synthetic_range,3.55,3.65,MN\n",
                          "pass.synthetic_range,3.55 MN,3650 kN\n", "pass.synthetic_range;3,55;3,65;MN\n",
                          "pass.synthetic_range\t3,55 MN; 3,65 MN\n", "pass.synthetic_range;\"3,55; 3,65 MN\"\n",
                          "pass.synthetic_range,3.55 MN | 3.65 MN\n"}) {
    const Case c      = filled(row);
    const auto &range = std::get<FourHigh>(c.spec).passes.at(0).synthetic_range;
    EXPECT_EQ(range[0], 3.55e6) << row;
    EXPECT_EQ(range[1], 3.65e6) << row;
  }
  EXPECT_EQ(refused("pass.synthetic_range,3.55 MN,3.65,MN,7\n"),
            "sheet.csv:1:1: error: pass.synthetic_range = [\"3.55 MN\", \"3.65\", \"MN\", \"7\"] is not a pair; a "
            "pair such "
            "as [\"972.898 kN\", \"979.537 kN\"] is needed");
  EXPECT_EQ(
      refused("pass.synthetic_range,3.55 MN\n"),
      "sheet.csv:1:1: error: pass.synthetic_range = [\"3.55 MN\"] is not a pair; a pair such as [\"972.898 kN\", "
      "\"979.537 kN\"] is needed");
}

TEST_F(Sheets, AmongDecimalCommasAPointBeforeThreeDigitsIsRefused)
{
  EXPECT_EQ(
      refused("strip.entry_thickness;2,85;mm\nwork_roll.barrel_length;1.400;mm\n"),
      "sheet.csv:2:1: error: work_roll.barrel_length = \"1.400 mm\" has two readings: other numbers of this sheet "
      "have decimal commas, so that the point may stand for a decimal point, \"1.400 mm\", or for thousands, "
      "\"1400 mm\"; write \"1,400 mm\" or \"1400 mm\"");
  EXPECT_EQ(refused("strip.entry_thickness;2,85;mm\npass.synthetic_range;1.230 kN;1.250,5 kN\n"),
            "sheet.csv:2:1: error: pass.synthetic_range = \"1.230 kN\" has two readings: other numbers of this "
            "sheet have "
            "decimal commas, so that the point may stand for a decimal point, \"1.230 kN\", or for thousands, "
            "\"1230 kN\"; "
            "write \"1,230 kN\" or \"1230 kN\"");
  const Case c      = filled("strip.entry_thickness;2,85;mm\nwork_roll.barrel_length;1.400,0;mm\n"
                                  "strip.exit_thickness;1,900;mm\nstrip.friction;0.065\n");
  const auto &stand = std::get<FourHigh>(c.spec);
  EXPECT_EQ(stand.work_roll.barrel_length, 1.4);
  EXPECT_EQ(stand.strip.exit_thickness, 1.9e-3);
  EXPECT_EQ(stand.strip.friction.coefficient, 0.065) << "behind a zero a point does not separate thousands";
  EXPECT_EQ(std::get<FourHigh>(filled("work_roll.barrel_length,1.400,m\n").spec).work_roll.barrel_length, 1.4);
}

TEST_F(Sheets, ADesignationReplacesTheDrawing)
{
  const Case c      = filled("bearing.trb.designation,LM761649D\n"
                                  "work_roll.neck_diameter,342.9 mm\n"
                                  "work_roll.barrel_diameter,560 mm\n"
                                  "work_roll.total_length,2600 mm\n");
  const auto &stand = std::get<FourHigh>(c.spec);
  EXPECT_EQ(bearing_of(stand.bearings, "trb").designation, "LM761649D");
}

TEST_F(Sheets, AllProblemsAreReportedTogether)
{
  EXPECT_EQ(
      refused("work_roll.barel_diameter,650,mm\n"
              "work_roll.barrel_length,1400,kg\n"
              "backup_roll.barrel_diameter,57.1,in\n"
              "strip.width,1000 mm\n"
              "strip.width,1200 mm\n"
              "colour,red\n"
              "bearing.trb.rows,3.5\n"
              "work_roll.bearing_span,1,2,3\n"),
      "sheet.csv:1:1: error: unknown key 'work_roll.barel_diameter'; did you mean 'work_roll.barrel_diameter'?\n"
      "sheet.csv:2:1: error: work_roll.barrel_length = \"1400 kg\" is a mass; a length is needed, for example "
      "\"1400 mm\"\n"
      "sheet.csv:3:1: error: backup_roll.barrel_diameter = \"57.1 in\" is in inches; 57.1 in = 1450.34 mm: write "
      "\"1450.34 mm\"\n"
      "sheet.csv:5:1: error: 'strip.width' appears twice; remove one of the two\n"
      "sheet.csv:6:1: error: unknown key 'colour'; the template and docs/input.md have the keys of each section\n"
      "sheet.csv:7:1: error: bearing.trb.rows = 3.5 is not a whole number; a whole number is needed, for example "
      "4\n"
      "sheet.csv:8:1: error: work_roll.bearing_span: 4 cells in a row; key, value and unit are wanted");
}

TEST_F(Sheets, AKeyOfAnEarlierVersionIsNamedWithItsSuccessor)
{
  EXPECT_EQ(
      refused("bearing.trb.row_hands,+-+-\nbearing.trb.tilt_lever,full\n"),
      "sheet.csv:1:1: error: unknown key 'bearing.trb.row_hands'; it was replaced by 'arrangement' after version "
      "0.1.0: write the value under the new name\n"
      "sheet.csv:2:1: error: unknown key 'bearing.trb.tilt_lever'; it was dropped after version 0.1.0: a turn of "
      "the inner ring now always presses a tapered roller by its full moment; delete the line");
}

TEST_F(Sheets, WhatIsLeftOfTheTemplateIsListed)
{
  write_atomically(path, template_of("four-high"));
  const Case c = read_case(path);
  EXPECT_GE(c.left_at_template.size(), 25u);
  EXPECT_EQ(std::count(c.left_at_template.begin(), c.left_at_template.end(), "work_roll.neck_diameter"), 1);
  ASSERT_EQ(c.warnings.size(), 1u);
  EXPECT_EQ(c.warnings[0].id, WarningId::template_values);
  EXPECT_NE(c.warnings[0].fact.find(" values are still those of the template"), std::string::npos);
  EXPECT_EQ(c.warnings[0].detail.find("work_roll.barrel_diameter, "), 0u) << c.warnings[0].detail;
  EXPECT_EQ(c.warnings[0].remedy, "replace them, or name those that are meant in confirmed = \"...\"");
  const Case one = read_case(path, {"work_roll.neck_diameter=250 mm"});
  EXPECT_EQ(one.left_at_template.size() + 1, c.left_at_template.size());
  const Case rolls = read_case(path, {"confirmed=work_roll strip.width"});
  for (const std::string &key : rolls.left_at_template) {
    EXPECT_NE(key.rfind("work_roll.", 0), 0u) << key;
    EXPECT_NE(key, "strip.width");
  }
  EXPECT_TRUE(read_case(path, {"confirmed=all"}).left_at_template.empty());
  EXPECT_TRUE(read_case(path, {"confirmed=all"}).warnings.empty());
  EXPECT_TRUE(read_case("cases/four-high-1400.toml").left_at_template.empty())
      << "the template has them from here";
}

// Part one: some forty lines, each with a note on where to find the value.
TEST(Template, ATemplateBeginsWithTheDrawing)
{
  const std::string text = template_of("four-high"), part = text.substr(0, text.find("# Part 2"));
  ASSERT_NE(text.find("# Part 2"), std::string::npos);
  EXPECT_EQ(text.rfind("#:schema ./millstand.schema.json\n", 0), 0u);
  EXPECT_LT(std::count(part.begin(), part.end(), '\n'), 100);
  for (const CaseKind *kind : all_kinds()) {
    const std::string text = template_of(kind->name), first = text.substr(0, text.find("# Part 2"));
    for (const DrawingValue &value : kind->drawing) {
      EXPECT_NE(first.find(value.where), std::string::npos) << value.section << "." << value.key;
      const auto section = std::find_if(kind->sections.begin(), kind->sections.end(),
                                        [&](const SectionRows &s) { return s.id() == value.section; });
      ASSERT_NE(section, kind->sections.end()) << value.section;
      EXPECT_TRUE(std::any_of(section->rows.begin(), section->rows.end(),
                              [&](const Row &row) { return row.key == value.key; }))
          << value.section << "." << value.key;
      EXPECT_NE(input_reference().find("where to find it: " + value.where), std::string::npos) << value.where;
    }
  }
  const std::string experts = text.substr(text.find("# Part 2"));
  for (const std::string &line : split(experts, "\n"))
    EXPECT_TRUE(line.empty() || line[0] == '#') << line;
}

TEST_F(Sheets, RefuseAQuoteThatIsNotClosed)
{
  const std::string message = refused("key,value\nstrip.friction,\"0.06\ntitle,x\n");
  EXPECT_NE(message.find("sheet.csv:2:16"), std::string::npos) << message;
  EXPECT_NE(message.find("not closed"), std::string::npos) << message;
}
