#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <sstream>

// What the folders promise each other, read from the sources.
namespace fs = std::filesystem;

namespace {
const fs::path root = MILLSTAND_SOURCE_DIR;
// The rooms of the product, each with those that it may include.
const std::set<std::string> below_app{"core", "reduce", "meshes", "fem", "dynamics", "report", "twin"};
const std::map<std::string, std::set<std::string>> rooms{{"core", std::set<std::string>()},
                                                         {"reduce", {"core"}},
                                                         {"meshes", {"core"}},
                                                         {"fem", {"core", "reduce"}},
                                                         {"dynamics", {"core", "reduce"}},
                                                         {"report", {"core"}},
                                                         {"twin", {"core", "dynamics"}},
                                                         {"app", below_app}};

std::vector<std::string> names_of(const std::map<std::string, std::set<std::string>> &map)
{
  std::vector<std::string> names;
  for (const auto &[name, value] : map)
    names.push_back(name);
  return names;
}

const std::vector<std::string> stages = names_of(rooms);

struct Source {
  std::string name;  // from the root: "fem/contact_solver.h"
  std::string folder;
  bool header;
  std::vector<std::string> lines;
};

std::vector<Source> sources(const std::vector<std::string> &folders)
{
  std::vector<Source> out;
  for (const std::string &folder : folders)
    for (const auto &entry : fs::recursive_directory_iterator(root / folder)) {
      const auto ending = entry.path().extension();
      if (ending != ".h" && ending != ".cpp")
        continue;
      Source s{fs::relative(entry.path(), root).string(), folder, ending == ".h", {}};
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);)
        s.lines.push_back(line);
      out.push_back(s);
    }
  return out;
}

std::vector<std::string> includes(const Source &source)
{
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<std::string> out;
  std::smatch match;
  for (const std::string &line : source.lines)
    if (line.find("include") != std::string::npos && std::regex_search(line, match, pattern))
      out.push_back(match[1]);
  return out;
}

bool starts_with(const std::string &text, const std::string &prefix)
{
  return text.compare(0, prefix.size(), prefix) == 0;
}

// Whether the pattern is in the line, asked only where one of `words` is, each match of it having one: the
// library's expressions take seconds for all lines of the tree.
bool finds(const std::string &line, const std::vector<std::string> &words, const std::regex &pattern)
{
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string &word) { return line.find(word) != std::string::npos; }) &&
         std::regex_search(line, pattern);
}
}  // namespace

TEST(Layers, ARoomIncludesOnlyTheRoomsBelowIt)
{
  for (const Source &source : sources(stages))
    for (const std::string &include : includes(source))
      for (const std::string &room : stages)
        if (starts_with(include, room + "/"))
          EXPECT_TRUE(room == source.folder || rooms.at(source.folder).count(room))
              << source.name << " includes " << include;
}

TEST(Layers, ThereAreThirteenRoomsAtTheTop)
{
  const std::set<std::string> wanted{"app",    "cases",  "cmake",  "core",    "docs",  "dynamics", "fem",
                                     "meshes", "reduce", "report", "scripts", "tests", "twin"};
  std::set<std::string> found;
  for (const auto &entry : fs::directory_iterator(root))
    if (const std::string name = entry.path().filename().string();
        entry.is_directory() && name[0] != '.' && name != "build" && name != "out" && !fs::is_empty(entry.path()))
      found.insert(name);
  EXPECT_EQ(found, wanted);
}

// Folders form no circle, of two or of more: each can be read, built and tested after those that it includes.
TEST(Layers, NoFolderIncludesItselfByWayOfOthers)
{
  auto all = stages;
  all.insert(all.end(), {"tests/manual", "tests/bench"});
  std::map<std::string, std::set<std::string>> below;  // folder -> folders that it includes
  std::map<std::pair<std::string, std::string>, std::string> example;
  for (const Source &source : sources(all)) {
    const std::string folder = fs::path(source.name).parent_path().string();
    for (const std::string &include : includes(source)) {
      const std::string other = fs::path(include).parent_path().string();
      if (other == folder || !fs::exists(root / include))
        continue;
      below[folder].insert(other);
      example[{folder, other}] = source.name + " includes " + include;
    }
  }
  EXPECT_GT(below.size(), 60u) << "the folders are no longer found";
  std::set<std::string> done, open;
  std::vector<std::string> path;
  const std::function<void(const std::string &)> visit = [&](const std::string &folder) {
    if (done.count(folder))
      return;
    path.push_back(folder);
    open.insert(folder);
    for (const std::string &other : below[folder])
      if (open.count(other)) {
        std::string circle;
        for (auto it = std::find(path.begin(), path.end(), other); it != path.end(); ++it)
          circle += example[{*it, it + 1 == path.end() ? other : *(it + 1)}] + "\n";
        ADD_FAILURE() << "a circle of folders:\n" << circle;
      } else {
        visit(other);
      }
    open.erase(folder);
    path.pop_back();
    done.insert(folder);
  };
  for (const std::string &folder : names_of(below))
    visit(folder);
}

TEST(Layers, ThirdPartyStaysBehindItsFolder)
{
  // library -> folders whose sources may include it, those below them too; headers may include Eigen only.
  const std::map<std::string, std::set<std::string>> owners{
      {"deal.II/", {"fem/dealii"}},
      {"gmsh.h", {"meshes/gmsh", "tests/manual"}},
      {"toml++/", {"core"}},
      {"cholmod", {"core"}},
      {"metis.h", {"core"}},
      {"tbb/", {"core"}},
      {"suitesparse/umfpack", {"fem"}},
      {"nlohmann/", {"core", "report", "app", "twin"}},
      {"CLI/", {"app"}},
      {"spdlog/", {"app"}},
      {"mpi.h", {"fem"}},
      {"Spectra/", {"fem"}},
      {"boost/", {"app/study", "core/numerics", "dynamics", "twin/calibration", "twin/live", "twin/web/server"}},
      {"cvode/", {"dynamics"}},
      {"arkode/", {"dynamics"}},
      {"nvector/", {"dynamics"}},
      {"sunlinsol", {"dynamics"}},
      {"sunmatrix", {"dynamics"}},
      {"zip.h", {"dynamics/fmu"}},
      {"unzip.h", {"dynamics/fmu"}},
      {"openturns/", {"app/study/openturns"}},
      {"sqlite3.h", {"app/study/store"}},
      {"pybind11/", {"app/python"}},
      {"mosquitto.h", {"twin/live"}}};
  for (const Source &source : sources(stages))
    for (const std::string &include : includes(source))
      for (const auto &[library, folders] : owners)
        if (starts_with(include, library)) {
          EXPECT_TRUE(
              std::any_of(folders.begin(), folders.end(),
                          [&](const std::string &folder) { return starts_with(source.name, folder + "/"); }))
              << source.name << " includes " << include;
          EXPECT_FALSE(source.header && library != "nlohmann/" && library != "pybind11/")
              << source.name << " shows " << include << " to its users";
        }
}

// What calls Gmsh and deal.II is opened as a library of its own (core/process/own_library.h): it has plain structs
// on its border, throws nothing of ours, and has no second copy of what core/ holds once in a process.
TEST(Layers, TheOpenedLibraryKnowsItsBorderAlone)
{
  const std::set<std::string> border{"meshes/common/mesher.h", "meshes/common/section.h", "meshes/common/series.h",
                                     "fem/body/on_mesh.h", "core/base/vector_alignment.h"};
  std::size_t seen = 0;
  for (const Source &source : sources({"meshes", "fem"})) {
    if (!starts_with(source.name, "meshes/gmsh/") && !starts_with(source.name, "fem/dealii/"))
      continue;
    ++seen;
    for (const std::string &include : includes(source))
      for (const std::string &stage : stages)
        if (starts_with(include, stage + "/"))
          EXPECT_TRUE(border.count(include) || starts_with(include, "meshes/gmsh/") ||
                      starts_with(include, "fem/dealii/"))
              << source.name << " includes " << include;
  }
  EXPECT_GT(seen, 8u) << "the folders are no longer found";
}

// An exported unit carries the step on the curves of contacts: these files, side by side in one folder there,
// include each other and the standard library, whose headers have neither a folder nor an ending.
TEST(Layers, TheStepOnCurvesNeedsTheStandardLibraryAlone)
{
  const std::set<std::string> own{"spring_law.h", "curve_stand.h", "fixed_step.h"};
  std::size_t seen = 0;
  for (const Source &source : sources({"dynamics"})) {
    const fs::path path(source.name);
    if (path.parent_path() != "dynamics/nonlinear" || !own.count(path.stem().string() + ".h"))
      continue;
    ++seen;
    for (const std::string &include : includes(source))
      EXPECT_TRUE(own.count(include) || include.find_first_of("/.") == std::string::npos)
          << source.name << " includes " << include;
  }
  EXPECT_EQ(seen, 2 * own.size());
}

TEST(Layers, OnlyOneFileKnowsTheTomlParser)
{
  std::set<std::string> found;
  for (const Source &source : sources(stages))
    for (const std::string &include : includes(source))
      if (starts_with(include, "toml++"))
        found.insert(source.name);
  EXPECT_EQ(found, std::set<std::string>{"core/case/case_file.cpp"});
}

TEST(Headers, DoubleMembersStateTheirUnit)
{
  // Public data of the hand-over records and stage headers: "double name = 0;  ///< m, ..." on the line itself.
  const std::regex member(R"(^  double\s+[a-z_0-9A-Z]+(\s*=[^;()]*)?(,[^;()]*)?;)");
  int seen = 0;
  for (const Source &source : sources({"core", "meshes", "fem", "reduce", "dynamics", "twin"})) {
    if (!source.header)
      continue;
    bool hidden = false, body = false;  // private data; the body of an inline function
    for (std::size_t i = 0; i < source.lines.size(); ++i) {
      const std::string &line = source.lines[i];
      body                    = line == "{" || (body && line != "}");
      hidden                  = line.find("private:") != std::string::npos ||
               (hidden && !starts_with(line, "};") && line.find("public:") == std::string::npos);
      if (hidden || body || !finds(line, {"double"}, member))
        continue;
      ++seen;
      EXPECT_NE(line.find("///<"), std::string::npos) << source.name << ":" << i + 1 << ": " << line;
    }
  }
  EXPECT_GT(seen, 100) << "the pattern no longer finds the members";
}

TEST(Headers, AreGuardedAndOpenNoNamespace)
{
  for (const Source &source : sources(stages))
    if (source.header) {
      ASSERT_FALSE(source.lines.empty()) << source.name;
      EXPECT_EQ(source.lines[0], "#pragma once") << source.name;
      for (const std::string &line : source.lines)
        EXPECT_FALSE(starts_with(line, "using namespace")) << source.name;
    }
}

TEST(Library, NeverPrintsExitsOrReadsTheEnvironment)
{
  const std::regex forbidden(R"(std::c(out|err)\b|\bgetenv\b|\bstd::exit\b|[^fns]printf\s*\()");
  for (const Source &source : sources({"core", "meshes", "fem", "reduce", "dynamics", "twin", "report"}))
    for (std::size_t i = 0; i < source.lines.size(); ++i)
      EXPECT_FALSE(finds(source.lines[i], {"std::c", "getenv", "exit", "printf"}, forbidden))
          << source.name << ":" << i + 1 << ": " << source.lines[i];
}

// A signal ends an iterator of the C++ library with an exception; names_in() of core/base/files reads on.
TEST(Library, ReadsFoldersThroughOneFunction)
{
  const std::regex iterator(R"(\b(recursive_)?directory_iterator\b)");
  for (const Source &source : sources(stages))
    for (std::size_t i = 0; i < source.lines.size(); ++i)
      EXPECT_FALSE(finds(source.lines[i], {"directory_iterator"}, iterator))
          << source.name << ":" << i + 1 << ": use names_in() of core/base/files.h";
}

// An assert is gone in what users run; core/base/require.h is not.
TEST(Library, ChecksWhatItReliesOnInEveryBuild)
{
  for (const Source &s : sources(stages))
    for (const std::string &include : includes(s)) {
      EXPECT_NE(include, "cassert") << s.name;
      EXPECT_NE(include, "assert.h") << s.name;
    }
}

// A curve is written and read by its kind (core/records/result_names.h): a name that is spelled out may differ
// from that of the other side.
TEST(Stages, NameCurvesByTheirKind)
{
  const std::regex spelled(R"re(\b(write|table)\((std::string\()?"curves/(?!models\.json|.*\.json)[^)]*\))re");
  for (const Source &source : sources({"app/stages", "report"}))
    for (std::size_t i = 0; i < source.lines.size(); ++i)
      EXPECT_FALSE(finds(source.lines[i], {"curves/"}, spelled))
          << source.name << ":" << i + 1 << ": " << source.lines[i];
}

TEST(Tests, EveryTestExpectsSomething)
{
  for (const Source &source : sources({"tests"})) {
    if (source.name.find("_test.cpp") == std::string::npos)
      continue;
    std::string open;  // name of the test we are in
    bool expects     = true;
    const auto close = [&] { EXPECT_TRUE(expects) << source.name << ": " << open << " expects nothing"; };
    for (const std::string &line : source.lines) {
      if (starts_with(line, "TEST(") || starts_with(line, "TEST_F(") || starts_with(line, "TEST_P(")) {
        close();
        open    = line;
        expects = false;
      }
      if (line.find("EXPECT_") != std::string::npos || line.find("ASSERT_") != std::string::npos ||
          line.find("FAIL()") != std::string::npos || line.find("expect_") != std::string::npos)
        expects = true;
    }
    close();
  }
}

// Two numbers are compared by near() of tests/support/near.h, which refuses a tolerance without a reason.
TEST(Tests, AToleranceHasItsReason)
{
  const std::vector<std::string> bare{std::string("EXPECT_") + "NEAR(", std::string("ASSERT_") + "NEAR("};
  std::size_t with_reason = 0;
  for (const Source &source : sources({"tests"}))
    for (std::size_t i = 0; i < source.lines.size(); ++i) {
      for (const std::string &word : bare)
        EXPECT_EQ(source.lines[i].find(word), std::string::npos)
            << source.name << ":" << i + 1 << ": write EXPECT_TRUE(near(.., within(.., \"reason\")))";
      with_reason += source.lines[i].find("within") != std::string::npos;
    }
  EXPECT_GT(with_reason, 1000u) << "the comparisons are no longer found";
}

// A reference file says where its numbers come from, and what it names is in the tree.
TEST(Tests, AReferenceFileNamesItsSource)
{
  const std::regex from(R"re("(source|generator)": "[^"]{20,})re"),
      script(R"re("(generator|recomputed_by)": "([^"]*)")re");
  std::size_t seen = 0;
  for (const auto &entry : fs::directory_iterator(root / "tests/reference")) {
    if (entry.path().extension() != ".json")
      continue;
    ++seen;
    std::ifstream in(entry.path());
    std::string head;  // the members before the entries
    for (std::string line; std::getline(in, line) && line.find("\"entries\"") == std::string::npos;)
      head += line + "\n";
    EXPECT_TRUE(std::regex_search(head, from)) << entry.path() << ": a member source or generator is missing";
    for (std::sregex_iterator it(head.begin(), head.end(), script), end; it != end; ++it)
      EXPECT_TRUE(fs::is_regular_file(root / (*it)[2].str())) << entry.path() << " names " << (*it)[2];
  }
  EXPECT_GE(seen, 4u);
}

TEST(Tree, HasNoPathOfAMachineAndNothingLeftOpen)
{
  const std::regex machine("(^|[^.a-zA-Z0-9])/(work|home|root|tmp|farm)/[a-z]");
  const std::vector<std::string> words{std::string("TO") + "DO", std::string("FIX") + "ME",
                                       std::string("not imple") + "mented"};
  const std::regex open("\\b(" + words[0] + "|" + words[1] + "|" + words[2] + ")\\b");
  auto all = stages;
  all.insert(all.end(), {"tests", "cases"});
  for (const Source &source : sources(all)) {
    if (source.name == "tests/rules/tree/repo_rules_test.cpp")
      continue;
    for (std::size_t i = 0; i < source.lines.size(); ++i) {
      EXPECT_FALSE(finds(source.lines[i], {"/work", "/home", "/root", "/tmp", "/farm"}, machine))
          << source.name << ":" << i + 1 << ": " << source.lines[i];
      EXPECT_FALSE(finds(source.lines[i], words, open)) << source.name << ":" << i + 1 << ": " << source.lines[i];
    }
  }
}

TEST(Docs, EquationNumbersThatTheCodeCitesExist)
{
  std::string theory;
  for (const auto &chapter : fs::directory_iterator(root / "docs/theory")) {
    std::stringstream text;
    text << std::ifstream(chapter.path()).rdbuf();
    theory += text.str();
  }
  ASSERT_FALSE(theory.empty()) << "docs/theory/";
  // "(2.4)" and "(3.5b)" anywhere in the sources; a line with a year, "(1985), (2.22)", cites a publication.
  const std::regex number(R"((^|[^\w\])])\(([1-9]\d?\.\d{1,2}[a-d]?)\))"), year(R"(\((18|19|20)\d\d\))");
  auto all = stages;
  all.push_back("tests");
  std::size_t seen = 0;
  for (const Source &source : sources(all))
    for (std::size_t i = 0; i < source.lines.size(); ++i) {
      const std::string &line = source.lines[i];
      if (line.find('(') == std::string::npos || line.find('.') == std::string::npos || finds(line, {"("}, year))
        continue;
      for (std::sregex_iterator it(line.begin(), line.end(), number), end; it != end; ++it, ++seen)
        EXPECT_NE(theory.find("\\tag{" + (*it)[2].str() + "}"), std::string::npos)
            << source.name << ":" << i + 1 << ": equation " << (*it)[2] << " is not in docs/theory/";
    }
  EXPECT_GT(seen, 800u) << "the pattern no longer finds the citations";
}

// A reader goes from the page of a run to docs/report.md by the title of the section.
TEST(Docs, EverySectionOfThePageOfARunIsExplained)
{
  std::stringstream explained;
  explained << std::ifstream(root / "docs/report.md").rdbuf();
  const std::regex section(R"re(page\.section\("[^"]+", "([^"]+)")re");
  std::size_t seen = 0;
  for (const Source &source : sources({"report"})) {
    if (source.name.rfind("report/twin/", 0) == 0 || source.name.rfind("report/study/", 0) == 0 ||
        source.name.rfind("report/compare/", 0) == 0)
      continue;  // pages of other verbs
    for (const std::string &line : source.lines)
      if (std::smatch found;
          line.find("page.section(") != std::string::npos && std::regex_search(line, found, section)) {
        ++seen;
        EXPECT_NE(explained.str().find("**" + found[1].str()), std::string::npos)
            << source.name << ": section '" << found[1] << "' is not in docs/report.md";
      }
  }
  EXPECT_GT(seen, 18u) << "the pattern does not find the sections";
}

TEST(Tree, LongFilesAreListed)
{
  // Not a failure: a long table is fine, a long function is not.
  auto all = stages;
  all.push_back("tests");
  std::vector<std::pair<std::size_t, std::string>> lengths;
  for (const Source &source : sources(all))
    lengths.push_back({source.lines.size(), source.name});
  std::sort(lengths.rbegin(), lengths.rend());
  for (const auto &[n, name] : lengths)
    if (n > 500)
      std::printf("  %zu lines: %s\n", n, name.c_str());
  EXPECT_LT(lengths[lengths.size() / 2].first, 150u) << "median file length";
}
