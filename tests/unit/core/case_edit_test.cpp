#include "core/base/errors.h"
#include "core/case/case_edit.h"
#include "core/case/case_file.h"
#include "core/case/input_reference.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace {
const std::string text = "# a stand\n"
                         "kind = \"four-high\"  # kept\n"
                         "\n"
                         "[work_roll]  # both\n"
                         "barrel_diameter = \"420 mm\"   # drawing 17, \u00fcber alles\n"
                         "# neck_diameter = \"250 mm\"  # roll drawing\n"
                         "crown = [[\"-700 mm\", \"0 um\"],  # left ] end\n"
                         "         [\"700 mm\", \"0 um\"]]\n"
                         "\n"
                         "# [bearing.old]\n"
                         "[[pass]]\n"
                         "name = \"first\"\n"
                         "load = \"900 kN\"\n";

// Lines of b that differ from those of a, where both have as many.
int changed_lines(const std::string &a, const std::string &b)
{
  int n = 0;
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    const auto e = std::min(a.find('\n', i), a.size()), f = std::min(b.find('\n', j), b.size());
    n += a.substr(i, e - i) != b.substr(j, f - j);
    i = e + 1;
    j = f + 1;
  }
  return n;
}

std::string value(const std::string &of, const std::string &key)
{
  for (const auto &written : mill::written_values(of))
    if (written.key == key)
      return written.text;
  return "(none)";
}
}  // namespace

TEST(CaseEdit, AValueIsReplacedAndItsCommentStays)
{
  const std::string next = mill::with_value(text, "work_roll.barrel_diameter", "\"430 mm\"");
  EXPECT_NE(next.find("barrel_diameter = \"430 mm\"   # drawing 17, \u00fcber alles\n"), std::string::npos)
      << next;
  EXPECT_EQ(changed_lines(text, next), 1);
  EXPECT_EQ(mill::with_value(next, "work_roll.barrel_diameter", "\"420 mm\""), text);
}

TEST(CaseEdit, AValueOverSeveralLinesIsReplacedAsAWhole)
{
  const std::string next = mill::with_value(text, "work_roll.crown", "\"50 um\"");
  EXPECT_NE(next.find("crown = \"50 um\"\n\n# [bearing.old]\n"), std::string::npos) << next;
}

TEST(CaseEdit, AKeyTakesThePlaceOfItsComment)
{
  const std::string next = mill::with_value(text, "work_roll.neck_diameter", "\"252 mm\"");
  EXPECT_NE(next.find("\nneck_diameter = \"252 mm\"  # roll drawing\n"), std::string::npos) << next;
  EXPECT_EQ(changed_lines(text, next), 1);
}

TEST(CaseEdit, ANewKeyStandsBehindTheLastOfItsSection)
{
  const std::string next = mill::with_value(text, "work_roll.neck_length", "\"300 mm\"");
  EXPECT_NE(next.find("\"0 um\"]]\nneck_length = \"300 mm\"\n\n# [bearing.old]"), std::string::npos) << next;
  const std::string pass = mill::with_value(text, "pass.0.speed", "\"5 m/s\"");
  EXPECT_NE(pass.find("load = \"900 kN\"\nspeed = \"5 m/s\"\n"), std::string::npos) << pass;
}

TEST(CaseEdit, MissingSectionsAndPassesAreAddedAtTheEnd)
{
  EXPECT_EQ(mill::with_value(text, "bearing.\"crb 1.5\".bore", "\"300 mm\""),
            text + "\n[bearing.\"crb 1.5\"]\nbore = \"300 mm\"\n");
  EXPECT_EQ(mill::with_value(text, "pass.1.load", "\"800 kN\""),
            text + "\n[[pass]]\nname = \"pass 2\"\nload = \"800 kN\"\n");
  EXPECT_EQ(mill::with_value("", "title", "\"x\""), "title = \"x\"\n");
}

TEST(CaseEdit, ATakenOutValueBecomesAComment)
{
  const std::string next = mill::with_value(text, "work_roll.barrel_diameter", "");
  EXPECT_NE(next.find("\n# barrel_diameter = \"420 mm\"   # drawing 17"), std::string::npos);
  EXPECT_EQ(mill::with_value(text, "work_roll.roughness", ""), text);
  const std::string list = mill::with_value(text, "work_roll.crown", "");
  EXPECT_NE(list.find("# crown = [[\"-700 mm\""), std::string::npos);
  EXPECT_NE(list.find("#          [\"700 mm\""), std::string::npos) << list;
  EXPECT_EQ(value(list, "work_roll.crown"), "(none)");
}

TEST(CaseEdit, LineEndsOfWindowsStay)
{
  EXPECT_EQ(mill::with_value("a = 1\r\n[b]\r\nc = 2 # x\r\n", "b.c", "3"), "a = 1\r\n[b]\r\nc = 3 # x\r\n");
  EXPECT_EQ(mill::with_value("a = 1\r\n", "b.c", "3"), "a = 1\r\n\r\n[b]\r\nc = 3\r\n");
}

TEST(CaseEdit, ASectionOfDottedKeysGetsADottedKey)
{
  const std::string dotted = "title = \"t\"\nsteel.density = \"7850 kg/m3\"\n[strip]\nwidth = \"1 m\"\n";
  EXPECT_EQ(
      mill::with_value(dotted, "steel.poisson_ratio", "0.3"),
      "title = \"t\"\nsteel.poisson_ratio = 0.3\nsteel.density = \"7850 kg/m3\"\n[strip]\nwidth = \"1 m\"\n");
  EXPECT_EQ(value(mill::with_value(dotted, "steel.title", "\"s\""), "steel.title"), "s")
      << "the title of the case is another key";
  const std::string inside = "[bearing]\nwork.rows = 4\nback.rows = 2\n";
  EXPECT_EQ(mill::with_value(inside, "bearing.back.bore", "\"1 m\""),
            "[bearing]\nwork.rows = 4\nback.bore = \"1 m\"\nback.rows = 2\n");
}

TEST(CaseEdit, ASectionThatOnlySectionsBelowItNameGetsItsHeader)
{
  const std::string below = "[contact.upper]\nmethod = \"line\"\n";
  const std::string next  = mill::with_value(below, "contact.samples", "24");
  EXPECT_EQ(value(next, "contact.samples"), "24") << next;
  EXPECT_EQ(value(next, "contact.upper.method"), "line") << next;
  EXPECT_EQ(value(next, "contact.upper.samples"), "(none)") << next;
}

TEST(CaseEdit, WhatCannotBeWrittenIsRefused)
{
  EXPECT_THROW(mill::with_value("[a", "a.b", "1"), mill::InputError);
  EXPECT_THROW(mill::with_value(text, "", "1"), mill::InputError);
  EXPECT_THROW(mill::with_value(text, "work_roll", "1"), mill::InputError);
  EXPECT_THROW(mill::with_value("a = {b = 1}\n", "a.c", "1"), mill::InputError);
  EXPECT_THROW(mill::with_value(text, "work_roll.crown", "1\n2"), mill::InputError);
}

TEST(CaseEdit, ATypedValueIsTomlWhereItFitsAndTextOtherwise)
{
  EXPECT_EQ(mill::toml_as_typed(" 420 mm ", true), "\"420 mm\"");
  EXPECT_EQ(mill::toml_as_typed("0.2", false), "0.2");
  EXPECT_EQ(mill::toml_as_typed("0,2", false), "\"0,2\"");
  EXPECT_EQ(mill::toml_as_typed("true", false), "true");
  EXPECT_EQ(mill::toml_as_typed("true", true), "\"true\"");
  EXPECT_EQ(mill::toml_as_typed("[\"1 kN\", \"2 kN\"]", false), "[\"1 kN\", \"2 kN\"]");
  EXPECT_EQ(mill::toml_as_typed("say \"x\"\nnow", true), "\"say \\\"x\\\" now\"");
  EXPECT_EQ(mill::toml_as_typed("1\n[steel]", false), "\"1 [steel]\"");
}

// Random edits of the whole template: what was set is read back, and the rest is as before.
TEST(CaseEdit, RandomEditsOfATemplateReadBackAndTouchOneLine)
{
  std::mt19937 draw(7);
  std::string now = mill::template_of("four-high");
  for (int i = 0; i < 150; ++i) {
    const auto before      = mill::written_values(now);
    const auto &one        = before[draw() % before.size()];
    const std::string next = mill::with_value(now, one.key, "\"" + std::to_string(draw() % 1000) + " mm\"");
    const auto after       = mill::written_values(next);
    ASSERT_EQ(after.size(), before.size()) << one.key;
    int differ = 0;
    for (std::size_t k = 0; k < after.size(); ++k)
      differ += after[k].text != before[k].text;
    EXPECT_LE(differ, 1) << one.key;
    EXPECT_LE(changed_lines(now, next), 1) << one.key;
    now = next;
  }
}
