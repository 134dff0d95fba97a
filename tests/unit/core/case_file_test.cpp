// The tree behind a case file: places of keys and values, order, overrides, syntax errors with their remedies.
#include "core/base/files.h"
#include "core/case/case_file.h"
#include <filesystem>
#include <gtest/gtest.h>

using namespace mill;

namespace {
class CaseFile : public testing::Test {
protected:
  std::string path = (std::filesystem::path(testing::TempDir()) / "millstand_case_file_test.toml").string();
  void TearDown() override
  {
    std::filesystem::remove(path);
  }
  Node tree(const std::string &text, const std::vector<std::string> &sets = {})
  {
    write_atomically(path, text);
    return read_case_file(path, sets);
  }
  /// "line:column: message" of the first problem.
  std::string refusal(const std::string &text, const std::vector<std::string> &sets = {})
  {
    try {
      tree(text, sets);
    } catch (const InputError &error) {
      const Problem &first    = error.problems.at(0);
      const std::string where = first.place.file == path ? "" : first.place.file + " ";
      return where + std::to_string(first.place.line) + ":" + std::to_string(first.place.column) + ": " +
             first.message;
    }
    return "accepted";
  }
};

const Node &at(const Node &root, const std::string &section, const std::string &key)
{
  return root.find(section)->value.find(key)->value;
}

const char *const sample = "kind = \"x\"\n"
                           "[work_roll]\n"
                           "  diameter = \"420 mm\"\n"
                           "  n = 3\n"
                           "[[pass]]\n"
                           "name = \"a\"\n"
                           "[[pass]]\n"
                           "name = \"b\"\n"
                           "loads = [\"1 kN\", \"2 kN\"]\n";
}  // namespace

TEST_F(CaseFile, LinesAndColumnsStartAtOne)
{
  const Node root          = tree(sample);
  const Node::Entry &entry = *root.find("work_roll")->value.find("diameter");
  EXPECT_EQ(entry.key_place.line, 3);
  EXPECT_EQ(entry.key_place.column, 3);
  EXPECT_EQ(entry.value.place.line, 3);
  EXPECT_EQ(entry.value.place.column, 14);
  EXPECT_EQ(root.find("work_roll")->value.place.line, 2);
  EXPECT_EQ(root.find("pass")->value.items[1].place.line, 7);
  EXPECT_EQ(root.find("pass")->value.items[1].find("loads")->value.items[1].place.column, 18);
}

TEST_F(CaseFile, ColumnsAreCharactersAndNotBytes)
{
  const Node root = tree("t = { a = \"\u00b5\u00b5\u00b5\", b = 1 }\n");
  EXPECT_EQ(at(root, "t", "b").place.column, 22);
}

TEST_F(CaseFile, EntriesKeepTheOrderOfTheFile)
{
  const Node root = tree("z = 1\nb = 2\na = 3\n");
  ASSERT_EQ(root.entries.size(), 3u);
  EXPECT_EQ(root.entries[0].key, "z");
  EXPECT_EQ(root.entries[2].key, "a");
}

TEST_F(CaseFile, AnOverrideReplacesAValueAndBringsItsPlace)
{
  const Node root = tree(sample, {"work_roll.diameter=400 mm", "work_roll.n = 8", "pass.1.name=second",
                                  "pass.0.loads=[\"3 kN\", \"4 kN\"]", "new.section.key=true"});
  EXPECT_EQ(at(root, "work_roll", "diameter").text, "400 mm");
  EXPECT_EQ(at(root, "work_roll", "diameter").place.file, "--set work_roll.diameter=400 mm");
  EXPECT_EQ(at(root, "work_roll", "diameter").place.line, 0);
  EXPECT_EQ(at(root, "work_roll", "n").kind, Node::Kind::integer);
  EXPECT_EQ(at(root, "work_roll", "n").number, 8);
  EXPECT_EQ(root.find("pass")->value.items[1].find("name")->value.text, "second");
  EXPECT_EQ(root.find("pass")->value.items[0].find("loads")->value.items[1].text, "4 kN");
  EXPECT_TRUE(at(root, "new", "section").find("key")->value.flag);
}

TEST_F(CaseFile, AnOverrideThatIsNotTomlIsText)
{
  const Node root = tree(sample, {"work_roll.diameter=1\nn = 5", "work_roll.a=", "work_roll.b=\"quoted\""});
  EXPECT_EQ(at(root, "work_roll", "diameter").kind, Node::Kind::text);
  EXPECT_EQ(at(root, "work_roll", "n").number, 3);
  EXPECT_EQ(at(root, "work_roll", "a").text, "");
  EXPECT_EQ(at(root, "work_roll", "b").text, "quoted");
}

// What a newcomer types, each with its remedy in place of the words of the parser.
TEST_F(CaseFile, CommonSlipsOfTomlAreNamed)
{
  EXPECT_EQ(refusal("a = true\na = true\n"), "2:1: 'a' appears twice; remove one of the two");
  EXPECT_EQ(refusal("[a]\nx = 1\n[b]\n[a]\n"), "4:2: 'a' appears twice; remove one of the two");
  EXPECT_EQ(refusal("[pass]\nforce = 1\n[pass]\nforce = 2\n"),
            "3:2: a pass is written under [[pass]], in double brackets, one for each");
  EXPECT_EQ(refusal("kind = four-high\n"), "1:8: a text is written in quotes: kind = \"four-high\"");
  EXPECT_EQ(refusal("kind = \"four-high\nx = 1\n"),
            "1:8: the closing quote of this text is missing: kind = \"four-high\"");
  EXPECT_EQ(refusal("[[pass # of the schedule\n"),
            "1:8: the bracket that closes the name of this section is missing: [[pass]]");
  EXPECT_EQ(refusal("estimate = yes\n"), "1:12: yes and no are written true and false: estimate = true");
}

TEST_F(CaseFile, AMalformedOverrideIsRefused)
{
  const std::string form =
      "0:0: an override has the form section.key=value, for example work_roll.barrel_diameter='420 mm'";
  EXPECT_EQ(refusal(sample, {"work_roll.diameter"}), "--set work_roll.diameter " + form);
  EXPECT_EQ(refusal(sample, {"=3"}), "--set =3 " + form);
  EXPECT_EQ(refusal(sample, {"a..b=3"}), "--set a..b=3 " + form);
  EXPECT_EQ(refusal(sample, {"pass.2.name=c"}),
            "--set pass.2.name=c 0:0: '2' in 'pass.2.name' is not the number of an entry; they are 0 to 1");
  EXPECT_EQ(refusal(sample, {"pass.first.name=c"}), "--set pass.first.name=c 0:0: 'first' in 'pass.first.name' is "
                                                    "not the number of an entry; they are 0 to 1");
  EXPECT_EQ(refusal(sample, {"kind.x=c"}),
            "--set kind.x=c 0:0: 'kind.x' leads through a value that is not a section");
}

TEST_F(CaseFile, AQuantityWithoutQuotesGetsTheRepairedLine)
{
  EXPECT_EQ(refusal("[a]\ndiameter = 1450 mm  # ground\n"),
            "2:12: a value with a unit is written in quotes: diameter = \"1450 mm\"");
  EXPECT_EQ(refusal("k = 4.0e4 kN/mm\n"), "1:5: a value with a unit is written in quotes: k = \"4.0e4 kN/mm\"");
  EXPECT_EQ(refusal("z = 2 %\n"), "1:5: a value with a unit is written in quotes: z = \"2 %\"");
}

TEST_F(CaseFile, AKeyTwiceShowsBothLines)
{
  EXPECT_EQ(refusal("[a]\nx = 1\n[b]\nx = 1\ny = 2\nx = 3\n"), "6:1: 'x' appears twice; remove one of the two");
  try {
    tree("[a]\nx = 1\n[b]\nx = 1\ny = 2\nx = 3\n");
  } catch (const InputError &error) {
    ASSERT_EQ(error.problems[0].related.size(), 1u);
    EXPECT_EQ(error.problems[0].related[0].line, 4);
  }
}

// Inputs on which toml++ itself has been known to lose its way (its issues 190, 294, 295).
TEST_F(CaseFile, StrayCharactersAreEitherReadOrRefused)
{
  EXPECT_NE(refusal("\xcc\xaa"), "accepted");
  EXPECT_NE(refusal("[&"), "accepted");
  EXPECT_NE(refusal("a = 1 \xc2\xa7\n"), "accepted");
  EXPECT_NE(refusal("a\xff = 1\n"), "accepted");
  EXPECT_EQ(refusal("s = \"\"\"\\\n\xc2\xa7\"\"\"\n"), "accepted");
}

namespace {
/// A folder of its own with these files, and the refusal of one that it does not have.
std::string refusal_of_missing(const std::vector<std::string> &names, const std::string &missing)
{
  const auto folder = std::filesystem::path(testing::TempDir()) / "millstand_missing_case_test";
  std::filesystem::create_directory(folder);
  for (const std::string &name : names)
    write_atomically((folder / name).string(), "kind = \"x\"\n");
  std::string message = "read";
  try {
    read_case_file((folder / missing).string());
  } catch (const InputError &error) {
    message = error.problems.at(0).message;
    EXPECT_EQ(error.problems.at(0).place.file, (folder / missing).string());
  }
  std::filesystem::remove_all(folder);
  return message;
}
}  // namespace

TEST_F(CaseFile, AMissingFileIsNamedWithTheOneThatIsMeant)
{
  EXPECT_EQ(refusal_of_missing({}, "my-stand.toml"), "the file does not exist");
  EXPECT_EQ(refusal_of_missing({"my-stand.toml", "other.toml", "my-stan.csv"}, "my-stnad.toml"),
            "the file does not exist; did you mean 'my-stand.toml'?");
  EXPECT_EQ(refusal_of_missing({"plate.toml", "bearing.toml", "notes.txt"}, "my-stand.toml"),
            "the file does not exist; known: bearing.toml, plate.toml");
  // Of many files the list would hide the message.
  EXPECT_EQ(refusal_of_missing(
                {"1.toml", "2.toml", "3.toml", "4.toml", "5.toml", "6.toml", "7.toml", "8.toml", "9.toml"},
                "my-stand.toml"),
            "the file does not exist");
  try {
    read_case_file("no-such-folder/case.toml");
    FAIL() << "read";
  } catch (const InputError &error) {
    EXPECT_STREQ(error.what(), "no-such-folder/case.toml: error: the file does not exist");
  }
}

TEST_F(CaseFile, ValuesAreShownAsWritten)
{
  const Node root = tree("a = \"420 mm\"\nb = 0.2\nc = 3\nd = false\ne = [1]\nf = {}\n");
  EXPECT_EQ(shown(root.find("a")->value), "\"420 mm\"");
  EXPECT_EQ(shown(root.find("b")->value), "0.2");
  EXPECT_EQ(shown(root.find("c")->value), "3");
  EXPECT_EQ(shown(root.find("d")->value), "false");
  EXPECT_EQ(shown(root.find("e")->value), "[1]");
  EXPECT_EQ(shown(root.find("f")->value), "{...}");
}

namespace {
std::string repeated(const std::string &text, const int n)
{
  std::string all;
  for (int i = 0; i < n; ++i)
    all += text;
  return all;
}
}  // namespace

// 40 000 names in one key ended in a stack overflow, in the parser and wherever a tree is walked or taken apart.
TEST_F(CaseFile, NestingIsBoundedBeforeItIsParsed)
{
  const std::string why =
      "this nests deeper than 16 levels, deeper than any key of a case; look for a bracket that is "
      "not closed or for dots in place of values";
  const int n = 40000;
  EXPECT_EQ(refusal("x = 1\n" + repeated("a.", n) + "b = 1\n"), "2:32: " + why);
  EXPECT_EQ(refusal("[" + repeated("a.", n) + "b]\n"), "1:33: " + why);
  EXPECT_EQ(refusal("x = " + repeated("[", n)), "1:21: " + why);
  EXPECT_EQ(refusal("x = " + repeated("{a=", n)), "1:53: " + why);
  EXPECT_EQ(refusal("x = [\"\"\"a\"\"\"\", {" + repeated("a.", n) + "b = 1}]"), "1:48: " + why);
  EXPECT_EQ(refusal("x = 1", {repeated("a.", n) + "b=1"}).substr(0, 8), "--set a.");
  EXPECT_NE(refusal("x = 1", {"y=" + repeated("[", n)}).find(why), std::string::npos);
}

TEST_F(CaseFile, DotsAndBracketsInStringsAndCommentsDoNotNest)
{
  const std::string dots = repeated("a.[{", 50);
  EXPECT_EQ(refusal("# " + dots + "\nx = \"" + dots + "\\\"\" # " + dots + "\ny = '" + dots + "'\nz = \"\"\"\n" +
                    dots + "\"\"\"\"\"\nw = \'\'\'" + dots + "\'\'\'\n\"" + dots + "\" = 1\n"),
            "accepted");
  EXPECT_EQ(refusal("a.b.c.d.e.f.g.h = [[[[{x.y.z = [1.5, 2.5]}]]]]"), "accepted");
}
