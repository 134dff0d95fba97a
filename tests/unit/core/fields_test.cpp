// Rows: every kind of value, its range, its default and the way back to text; and a walk over all rows of the
// product.
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/case/fields.h"
#include "core/case/stand_rows.h"
#include "tests/support/near.h"
#include <cmath>
#include <filesystem>
#include <memory>
#include <set>

using namespace mill;

namespace {
struct Sample {
  double length = 0, ratio = 0, free = not_given;
  int count = 0;
  bool flag = false;
  std::string word, text, path;
  std::array<double, 2> loads = {not_given, not_given};
  std::vector<std::array<double, 2>> table;
};

const std::vector<Field<Sample>> rows{
    {"length", &Sample::length, "mm", {200, 2500}, required, "420 mm", "a length"},
    {"ratio", &Sample::ratio, "1", {0, 0.5}, 0.25, "0.25", "a ratio"},
    {"free", &Sample::free, "kN", {1, 10}, absent, "5 kN", "a force"},
    {"count", &Sample::count, "count", {1, 8}, 4, "4", "a count"},
    {"flag", &Sample::flag, "flag", {}, 0, "true", "a flag"},
    {"word", &Sample::word, "none | iso", {}, "none", "iso", "a choice"},
    {"text", &Sample::text, "text", {}, "", "abc", "a text"},
    {"path", &Sample::path, "path", {}, absent, "a.csv", "a file"},
    {"loads", &Sample::loads, "kN", {1, 100}, absent, R"(["1 kN", "2 kN"])", "a pair"},
    {"table", &Sample::table, "mm, um", {-9, 9}, absent, R"([["0 mm", "1 um"], ["1 mm", "2 um"]])", "a table"},
};

template <class T> void expect_struct_defaults(const std::vector<Field<T>> &fields)
{
  const auto owned = std::make_unique<T>();
  const T &made    = *owned;
  for (const Field<T> &field : fields) {
    const Row row                = row_of(field);
    const bool decided_by_others = row.kind == Kind::choice && row.fallback.kind == Fallback::Kind::absent;
    if (row.fallback.kind != Fallback::Kind::required && !decided_by_others) {
      EXPECT_EQ(toml_of(row, member_value(field, made)), default_toml(row)) << row.key;
    }
  }
}

class Fields : public testing::Test {
protected:
  std::string path = (std::filesystem::path(testing::TempDir()) / "millstand_fields_test.toml").string();
  Reading reading;
  void TearDown() override
  {
    std::filesystem::remove(path);
  }
  Sample read_text_as(const std::string &body)
  {
    write_atomically(path, "[s]\n" + body);
    const Node root = read_case_file(path);
    reading         = {};
    reading.file    = path;
    reading.folder  = "cases";
    Sample out;
    read({&root.find("s")->value, "s"}, rows, out, reading);
    return out;
  }
  /// Messages of every problem, one per line.
  std::string refusal(const std::string &body)
  {
    read_text_as(body);
    std::string text;
    for (const Problem &problem : reading.problems)
      text += (text.empty() ? "" : "\n") + problem.message;
    return text;
  }
  std::string with_length(const std::string &line)
  {
    return refusal("length = \"420 mm\"\n" + line);
  }
};
}  // namespace

TEST_F(Fields, EveryKindOfValueIsReadInSi)
{
  const Sample s = read_text_as("length = \"42 cm\"\n");
  EXPECT_EQ(reading.problems.size(), 1u);  // cm is not in the list
  const Sample t =
      read_text_as("length = \"0.42 m\"\nratio = 0.125\nfree = \"5000 N\"\ncount = 8\nflag = true\n"
                   "word = \"iso\"\ntext = \"a \\\"b\\\"\"\npath = \"data/../x.csv\"\n"
                   "loads = [\"1 kN\", \"100000 N\"]\ntable = [[\"0 mm\", \"1 um\"], [\"2 mm\", \"-9 um\"]]\n");
  ASSERT_TRUE(reading.problems.empty());
  EXPECT_EQ(t.length, 0.42);
  EXPECT_EQ(t.ratio, 0.125);
  EXPECT_EQ(t.free, 5000);
  EXPECT_EQ(t.count, 8);
  EXPECT_TRUE(t.flag);
  EXPECT_EQ(t.word, "iso");
  EXPECT_EQ(t.text, "a \"b\"");
  EXPECT_EQ(t.path, "cases/x.csv");
  EXPECT_EQ(t.loads[1], 1e5);
  EXPECT_EQ(t.table[1][0], 0.002);
  EXPECT_EQ(t.table[1][1], -9e-6);
  EXPECT_EQ(reading.places.at("s.length").line, 2);
}

TEST_F(Fields, DefaultsAreUsedAndNotMarkedAsRead)
{
  const Sample s = read_text_as("length = \"420 mm\"\n");
  EXPECT_EQ(s.ratio, 0.25);
  EXPECT_TRUE(std::isnan(s.free));
  EXPECT_EQ(s.count, 4);
  EXPECT_EQ(s.word, "none");
  EXPECT_EQ(reading.places.count("s.ratio"), 0u);
}

TEST_F(Fields, ValuesThatAreNotQuantitiesAreRefused)
{
  const std::string need = "; a length is needed, for example \"420 mm\"";
  EXPECT_EQ(refusal("length = 420"), "s.length = 420 has no unit" + need);
  EXPECT_EQ(refusal("length = \"420\""), "s.length = \"420\" has no unit" + need);
  EXPECT_EQ(refusal("length = \"420 kg\""), "s.length = \"420 kg\" is a mass" + need);
  EXPECT_EQ(refusal("length = \"wide\""), "s.length = \"wide\" does not begin with a number" + need);
  EXPECT_EQ(refusal("length = \"420 inch\""),
            "s.length = \"420 inch\" is in inches; 420 inch = 10668 mm, which is outside 200 mm .. 2500 mm");
  EXPECT_EQ(refusal("length = \"42 ell\""),
            "s.length = \"42 ell\" has the unknown unit 'ell'" + need + " (known units: m, mm, um)");
  EXPECT_EQ(refusal("length = true"), "s.length = true is not a quantity" + need);
  EXPECT_EQ(refusal("length = [\"1 m\"]"), "s.length = [\"1 m\"] is not a quantity" + need);
  EXPECT_EQ(refusal("length = 1979-05-27"), "s.length = (date or time) is not a quantity" + need);
  EXPECT_EQ(refusal("length = \"14500 mm\""), "s.length = \"14500 mm\" is outside 200 mm .. 2500 mm");
  EXPECT_EQ(refusal("length = \"-420 mm\""), "s.length = \"-420 mm\" is outside 200 mm .. 2500 mm");
  EXPECT_EQ(refusal(""), "[s] has no 'length'; add for example length = \"420 mm\"");
}

TEST_F(Fields, BothEndsOfARangeAreAllowedInEveryUnit)
{
  for (const char *text : {"200 mm", "0.2 m", "200000 um", "2500 mm", "2.5 m", "2500000 um"})
    EXPECT_EQ(refusal("length = \"" + std::string(text) + "\""), "") << text;
  for (const char *text : {"199.999999 mm", "2500.000001 mm"})
    EXPECT_NE(refusal("length = \"" + std::string(text) + "\""), "") << text;
}

TEST_F(Fields, ValuesOfTheWrongKindAreRefused)
{
  EXPECT_EQ(with_length("ratio = \"0.2\""),
            "s.ratio = \"0.2\" is not a number; a pure number is needed, for example 0.25");
  EXPECT_EQ(with_length("ratio = nan"),
            "s.ratio = nan is not a number; a pure number is needed, for example 0.25");
  EXPECT_EQ(with_length("ratio = 0.6"), "s.ratio = 0.6 is outside 0 .. 0.5");
  EXPECT_EQ(with_length("count = 2.5"),
            "s.count = 2.5 is not a whole number; a whole number is needed, for example 4");
  EXPECT_EQ(with_length("count = 9.0"), "s.count = 9 is outside 1 .. 8") << "9.0 is whole, and too large";
  EXPECT_EQ(with_length("count = 1e300"),
            "s.count = 1e+300 is not a whole number; a whole number is needed, for example 4");
  EXPECT_EQ(with_length("count = inf"),
            "s.count = inf is not a whole number; a whole number is needed, for example 4");
  EXPECT_EQ(with_length("count = 9"), "s.count = 9 is outside 1 .. 8");
  EXPECT_EQ(with_length("count = 99999999999999"), "s.count = 99999999999999 is outside 1 .. 8");
  EXPECT_EQ(with_length("flag = 1"), "s.flag = 1 is neither true nor false");
  EXPECT_EQ(with_length("word = \"ios\""),
            "s.word = \"ios\" is unknown; one of none | iso is needed; did you mean 'iso'?");
  EXPECT_EQ(with_length("text = 3"), "s.text = 3 is not a text; a text in quotes is needed, for example \"abc\"");
  EXPECT_EQ(with_length("path = \"\""), "s.path = \"\" is not the name of a file");
  EXPECT_EQ(with_length("loads = [\"1 kN\"]"),
            "s.loads = [\"1 kN\"] is not a pair; a pair such as [\"1 kN\", \"2 kN\"] is needed");
  EXPECT_EQ(with_length("loads = [\"1 kN\", 2]"),
            "s.loads[1] = 2 has no unit; a pair such as [\"1 kN\", \"2 kN\"] is needed");
  EXPECT_EQ(with_length("loads = [\"1 N\", \"2 kg\"]"),
            "s.loads[0] = \"1 N\" is outside 1 kN .. 100 kN\n"
            "s.loads[1] = \"2 kg\" is a mass; a pair such as [\"1 kN\", \"2 kN\"] is needed");
  EXPECT_EQ(with_length("table = [[\"0 mm\", \"1 um\"]]"),
            "s.table = [[\"0 mm\", \"1 um\"]] is not a list of two pairs or more; a list of pairs such as "
            "[[\"0 mm\", \"1 um\"], [\"1 mm\", \"2 um\"]] is needed");
  EXPECT_EQ(with_length("table = [[\"1 mm\", \"1 um\"], [\"1 mm\", \"2 um\"]]"),
            "s.table[1] = [\"1 mm\", \"2 um\"] does not increase in its first column; sort the pairs");
}

TEST_F(Fields, UnknownKeysGetTheNearestOrTheWholeList)
{
  EXPECT_EQ(with_length("lenght = 1"), "unknown key 'lenght' in [s]; did you mean 'length'?");
  EXPECT_EQ(
      with_length("colour = 1"),
      "unknown key 'colour' in [s]; known: length, ratio, free, count, flag, word, text, path, loads, table");
}

TEST_F(Fields, EveryProblemIsCollected)
{
  EXPECT_EQ(refusal("length = 1\nratio = 7\ncount = 0\nx = 1\n"),
            "s.length = 1 has no unit; a length is needed, for example \"420 mm\"\n"
            "s.ratio = 7 is outside 0 .. 0.5\ns.count = 0 is outside 1 .. 8\n"
            "unknown key 'x' in [s]; known: length, ratio, free, count, flag, word, text, path, loads, table");
  EXPECT_FALSE(reading.usable({"s.length"}));
  EXPECT_TRUE(reading.usable({"s.free", "s.word"}));
}

TEST_F(Fields, TheResolvedLinesReadBackAsTheSameStruct)
{
  const Sample a = read_text_as(
      "length = \"333.33333333333331 mm\"\nfree = \"3.3 kN\"\ntext = \"tab\\there\"\n"
      "loads = [\"1.1 kN\", \"2.2 kN\"]\ntable = [[\"0.1 mm\", \"0.7 um\"], [\"0.3 mm\", \"-0.7 um\"]]\n");
  const std::string echo = resolved_lines("s", rows, a, reading);
  EXPECT_NE(echo.find("ratio = 0.25  # default"), std::string::npos) << echo;
  EXPECT_NE(echo.find("# path is not given"), std::string::npos) << echo;
  const Sample b = read_text_as(echo);
  ASSERT_TRUE(reading.problems.empty()) << reading.problems[0].message;
  EXPECT_EQ(a.length, b.length);
  EXPECT_EQ(a.free, b.free);
  EXPECT_EQ(a.text, b.text);
  EXPECT_EQ(a.loads, b.loads);
  EXPECT_EQ(a.table, b.table);
}

TEST(Suggestion, AnExchangeOfTwoLettersIsOneSlip)
{
  EXPECT_EQ(suggestion("radial_clearence", {"radial_clearance", "rows"}), "; did you mean 'radial_clearance'?");
  EXPECT_EQ(suggestion("rwos", {"radial_clearance", "rows"}), "; did you mean 'rows'?");
  EXPECT_EQ(suggestion("ab", {"xy"}), "; known: xy");
  EXPECT_EQ(suggestion("barrel_dia", {"barrel_diameter", "crown"}), "; did you mean 'barrel_diameter'?");
  EXPECT_EQ(suggestion("barrel", {"barrel_diameter", "barrel_length"}), "; known: barrel_diameter, barrel_length");
  EXPECT_EQ(suggestion(std::string(100000, 'x'), {"rows"}), "; known: rows");
}

TEST(AllRows, EveryRowIsComplete)
{
  for (const std::string &kind : case_kinds())
    for (const SectionRows &section : sections_of(kind)) {
      std::set<std::string> keys;
      for (const Row &row : section.rows) {
        const std::string name = kind + " " + section.name + "." + row.key;
        EXPECT_TRUE(keys.insert(row.key).second) << name << " stands twice";
        EXPECT_FALSE(row.meaning.empty()) << name;
        EXPECT_FALSE(row.example.empty()) << name;
        EXPECT_LE(row.range.min, row.range.max) << name;
        if (row.kind == Kind::quantity || row.kind == Kind::pair) {
          EXPECT_NE(find_unit(row.form), nullptr) << name << " has the unit " << row.form;
        }
      }
    }
}

// Each example and each default must pass the check of its own row: a message must not advise what it refuses.
TEST(AllRows, ExamplesAndDefaultsAreAccepted)
{
  const std::string path = (std::filesystem::path(testing::TempDir()) / "millstand_rows_test.toml").string();
  for (const std::string &kind : case_kinds())
    for (const SectionRows &section : sections_of(kind))
      for (const Row &row : section.rows)
        for (const std::string &value : {example_toml(row), default_toml(row)}) {
          if (value.empty())
            continue;
          write_atomically(path, row.key + " = " + value + "\n");
          const Node root = read_case_file(path);
          Reading reading;
          EXPECT_TRUE(read_row(row, {&root, ""}, reading)) << kind << " " << section.name << "." << row.key;
        }
  std::filesystem::remove(path);
}

// A struct that is used without a case file has the same defaults as a case without the key.
TEST(AllRows, DefaultsAreThoseOfTheStructs)
{
  expect_struct_defaults(steel_rows());
  expect_struct_defaults(bearing_rows());
  expect_struct_defaults(dynamics_rows());
  expect_struct_defaults(roll_contact_rows());
  expect_struct_defaults(line_contact_rows());
  expect_struct_defaults(pass_rows());
  expect_struct_defaults(strip_rows());
  expect_struct_defaults(backup_roll_rows());
}
