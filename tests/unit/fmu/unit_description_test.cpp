// modelDescription.xml and the archive: the rules of both versions on the text that is written.
#include "core/base/errors.h"
#include "dynamics/fmu/archive.h"
#include "dynamics/fmu/description.h"
#include "dynamics/fmu/model_text.h"
#include "dynamics/fmu/unit_archive.h"
#include "tests/support/unit_client.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace {
using namespace mill;

// An element with its attributes; text between elements does not occur in these files.
struct Element {
  std::string name, parent;
  std::map<std::string, std::string> attributes;
};

std::vector<Element> elements_of(const std::string &xml)
{
  std::vector<Element> all;
  std::vector<std::string> open;
  const std::regex tag(R"(<(/?)([A-Za-z0-9]+)((?:\s+[A-Za-z0-9_]+="[^"<>]*")*)\s*(/?)>)");
  const std::regex attribute(R"re(([A-Za-z0-9_]+)="([^"]*)")re");
  std::size_t covered = xml.find("?>") + 2;
  for (std::sregex_iterator it(xml.begin() + long(covered), xml.end(), tag), end; it != end; ++it) {
    const std::smatch &m = *it;
    EXPECT_EQ(m.prefix().str().find_first_not_of(" \n"), std::string::npos) << m.prefix().str();
    if (m[1] == "/") {
      EXPECT_EQ(open.back(), m[2]);
      open.pop_back();
      continue;
    }
    Element e{m[2], open.empty() ? "" : open.back(), {}};
    const std::string text = m[3];
    for (std::sregex_iterator a(text.begin(), text.end(), attribute), none; a != none; ++a)
      EXPECT_TRUE(e.attributes.insert({(*a)[1], (*a)[2]}).second) << "attribute twice: " << (*a)[1];
    if (m[4] != "/")
      open.push_back(e.name);
    all.push_back(e);
  }
  EXPECT_TRUE(open.empty());
  return all;
}

bool has(const Element &e, const std::string &name)
{
  return e.attributes.count(name) > 0;
}
std::string value(const Element &e, const std::string &name)
{
  return has(e, name) ? e.attributes.at(name) : "";
}

// One variable as both versions describe it.
struct Described {
  Element outer, inner;
};
std::vector<Described> variables_in(const std::vector<Element> &all)
{
  std::vector<Described> found;
  for (const Element &e : all)
    if (e.parent == "ModelVariables")
      found.push_back({e, e});
    else if (e.parent == "ScalarVariable")
      found.back().inner = e;
  return found;
}

std::vector<fmu::ExportedModel> models()
{
  SampleStand with = sample_stand(ForceMeaning::published, 0.02, 1e6);
  carry(with.model, sample_force(50, 1e-3));
  return {sample_stand().model, with.model, in_modes(sample_stand())};
}
}  // namespace

TEST(UnitDescription, EveryVariableKeepsTheRules)
{
  const std::set<std::pair<std::string, std::string>> legal{
      {"parameter", "fixed"},           {"parameter", "tunable"},
      {"calculatedParameter", "fixed"}, {"calculatedParameter", "tunable"},
      {"input", "continuous"},          {"output", "continuous"},
      {"independent", "continuous"}};
  for (const int version : {2, 3})
    for (const fmu::ExportedModel &model : models()) {
      const auto all = elements_of(fmu::model_description(model, version));
      std::map<std::string, std::set<std::string>> units;
      std::string unit;
      for (const Element &e : all) {
        if (e.name == "Unit")
          units[unit = value(e, "name")];
        if (e.name == "DisplayUnit")
          units[unit].insert(value(e, "name"));
      }
      std::set<std::string> names, references, used;
      int times = 0;
      for (const auto &[outer, inner] : variables_in(all)) {
        const std::string name = value(outer, "name"), causality = value(outer, "causality");
        EXPECT_TRUE(names.insert(name).second) << name;
        EXPECT_TRUE(references.insert(value(outer, "valueReference")).second) << name;
        EXPECT_TRUE(legal.count({causality, value(outer, "variability")})) << name;
        EXPECT_FALSE(value(outer, "description").empty()) << name;
        const bool calculated = causality == "output" || causality == "calculatedParameter";
        EXPECT_EQ(value(outer, "initial"), causality == "parameter" ? "exact"
                                           : calculated             ? "calculated"
                                                                    : "")
            << name;
        EXPECT_EQ(has(inner, "start"), causality == "parameter" || causality == "input") << name;
        times += causality == "independent";
        EXPECT_EQ(inner.name, name == "use_stored_force" ? "Boolean" : version == 3 ? "Float64" : "Real") << name;
        if (inner.name == "Boolean")
          continue;
        ASSERT_TRUE(units.count(value(inner, "unit"))) << name;
        used.insert(value(inner, "unit"));
        EXPECT_TRUE(!has(inner, "displayUnit") ||
                    units.at(value(inner, "unit")).count(value(inner, "displayUnit")))
            << name;
        if (has(inner, "min")) {
          const double start = std::stod(value(inner, "start"));
          EXPECT_TRUE(start >= std::stod(value(inner, "min")) && start <= std::stod(value(inner, "max"))) << name;
        }
      }
      EXPECT_EQ(times, version == 3 ? 1 : 0);
      EXPECT_EQ(used.size(), units.size()) << "a unit that nothing is in";
    }
}

TEST(UnitDescription, StructureListsOutputsAndInitialUnknowns)
{
  for (const int version : {2, 3})
    for (const fmu::ExportedModel &model : models()) {
      const auto all = elements_of(fmu::model_description(model, version));
      std::vector<std::string> outputs, unknowns, listed_outputs, listed_unknowns;
      std::size_t index = 0;
      for (const auto &[outer, inner] : variables_in(all)) {
        const std::string id = version == 2 ? std::to_string(++index) : value(outer, "valueReference");
        if (value(outer, "causality") == "output")
          outputs.push_back(id);
        if (value(outer, "initial") == "calculated")
          unknowns.push_back(id);
      }
      for (const Element &e : all) {
        const std::string id = value(e, version == 2 ? "index" : "valueReference");
        if (e.parent == "Outputs" || e.name == "Output") {
          listed_outputs.push_back(id);
          EXPECT_TRUE(has(e, "dependencies")) << "left out: depends on all";
        }
        if (e.parent == "InitialUnknowns" || e.name == "InitialUnknown") {
          listed_unknowns.push_back(id);
          EXPECT_TRUE(has(e, "dependencies")) << "left out: depends on all";
        }
      }
      EXPECT_EQ(listed_outputs, outputs);
      EXPECT_EQ(listed_unknowns, unknowns);
    }
}

namespace {
// Names of the variables that a description lists as dependencies of one of its unknowns.
std::set<std::string> dependencies_of(const std::vector<Element> &all, const std::string &element,
                                      const std::string &unknown, const int version)
{
  std::map<std::string, std::string> name_of;
  std::size_t index = 0;
  for (const auto &[outer, inner] : variables_in(all))
    name_of[version == 2 ? std::to_string(++index) : value(outer, "valueReference")] = value(outer, "name");
  std::set<std::string> names;
  for (const Element &e : all) {
    const bool listed = version == 2 ? e.name == "Unknown" && e.parent == element : e.name == element;
    if (!listed || name_of[value(e, version == 2 ? "index" : "valueReference")] != unknown)
      continue;
    std::istringstream words(value(e, "dependencies"));
    for (std::string id; words >> id;)
      names.insert(name_of.at(id));
  }
  return names;
}
}  // namespace

// By the equations (35.1): the bite acts on the work rolls alone, and rest is decided by force and springs.
TEST(UnitDescription, DependenciesAreThoseOfTheEquations)
{
  using Names = std::set<std::string>;
  const Names springs{"K1", "K2", "K3", "K4", "K5", "K6", "K7"}, masses{"M1", "M2", "M3", "M4", "M5", "M6"};
  const auto with = [](Names all, const Names &more) {
    all.insert(more.begin(), more.end());
    return all;
  };
  for (const int version : {2, 3}) {
    const auto all       = elements_of(fmu::model_description(sample_stand().model, version));
    const auto at_points = [&](const std::string &name) {
      return dependencies_of(all, version == 2 ? "Outputs" : "Output", name, version);
    };
    const auto at_start = [&](const std::string &name) {
      return dependencies_of(all, version == 2 ? "InitialUnknowns" : "InitialUnknown", name, version);
    };
    EXPECT_EQ(at_start("a_upper_work_roll"), Names()) << "at rest";
    EXPECT_EQ(at_start("y_upper_frame"), with(springs, {"F_roll", "F_mean"}));
    EXPECT_EQ(at_start("F_cell"), with(springs, {"F_roll", "F_mean"}));
    EXPECT_EQ(at_start("f3"), with(springs, masses));
    EXPECT_EQ(at_points("y_upper_work_roll"), Names());
    if (version == 2) {  // inputs alone
      EXPECT_EQ(at_points("a_upper_work_roll"), Names{"F_roll"});
      EXPECT_EQ(at_points("a_upper_frame"), Names());
      EXPECT_EQ(at_points("F_cell"), Names());
    } else {
      const Names stand = with(with(springs, masses), {"modal_damping"});
      EXPECT_EQ(at_points("a_upper_work_roll"), with(stand, {"F_roll", "F_mean", "C"}));
      EXPECT_EQ(at_points("a_upper_frame"), stand);
      EXPECT_EQ(at_points("F_cell"), (Names{"F_mean", "K7"})) << "the spring below the stand";
    }
  }
  SampleStand recorded = sample_stand();
  carry(recorded.model, sample_force(50, 1e-3));
  const auto all = elements_of(fmu::model_description(recorded.model, 3));
  EXPECT_EQ(dependencies_of(all, "InitialUnknown", "y_lower_frame", 3),
            with(springs, {"F_roll", "F_mean", "use_stored_force", "time"}));
  const auto modes = elements_of(fmu::model_description(in_modes(sample_stand()), 3));
  EXPECT_EQ(dependencies_of(modes, "InitialUnknown", "f3", 3), Names()) << "given";
  EXPECT_EQ(dependencies_of(modes, "Output", "a_upper_frame", 3), Names{"modal_damping"});
  EXPECT_EQ(dependencies_of(modes, "Output", "a_lower_work_roll", 3),
            (Names{"F_roll", "F_mean", "C", "modal_damping"}));
}

TEST(UnitDescription, RootAndCapabilitiesAreThoseOfTheVersion)
{
  const auto model = sample_stand().model;
  const auto two   = elements_of(fmu::model_description(model, 2)),
             three = elements_of(fmu::model_description(model, 3));
  EXPECT_EQ(value(two[0], "fmiVersion"), "2.0");
  EXPECT_EQ(value(two[0], "guid"), model.data.guid);
  EXPECT_EQ(value(two[0], "modelName"), "sample &amp; &lt;stand&gt;");
  EXPECT_FALSE(has(two[0], "generationDateAndTime")) << "the bytes would differ every time";
  EXPECT_EQ(value(two[0], "license"), "runtime: MIT; model and its data: property of their owner");
  EXPECT_EQ(value(two[0], "version"), model.data.guid.substr(1, 8)) << "of the model";
  EXPECT_NE(value(elements_of(fmu::model_description(in_modes(sample_stand()), 2))[0], "version"),
            value(two[0], "version"));
  EXPECT_EQ(value(two[1], "canBeInstantiatedOnlyOncePerProcess"), "false");
  EXPECT_EQ(value(two[1], "canGetAndSetFMUstate"), "true");
  EXPECT_EQ(value(two[1], "canNotUseMemoryManagementFunctions"), "true");
  EXPECT_EQ(value(three[0], "fmiVersion"), "3.0");
  EXPECT_EQ(value(three[0], "instantiationToken"), model.data.guid);
  EXPECT_FALSE(has(three[0], "guid"));
  EXPECT_EQ(value(three[1], "hasEventMode"), "false");
  EXPECT_EQ(value(three[1], "providesIntermediateUpdate"), "true");
  for (const auto &all : {two, three}) {
    std::vector<std::string> order;
    for (const Element &e : all)
      if (e.parent == "fmiModelDescription")
        order.push_back(e.name);
    EXPECT_EQ(order, (std::vector<std::string>{"CoSimulation", "UnitDefinitions", "LogCategories",
                                               "DefaultExperiment", "ModelVariables", "ModelStructure"}));
  }
}

TEST(UnitDescription, WrittenNumbersGiveTheSameNumbersBack)
{
  for (const double number : {0.1, 1.0 / 3, 4.02e10, 9.80665e-17, -2.5, 1e15})
    EXPECT_EQ(std::stod(fmu::exact_number(number)), number);
  const auto model = sample_stand().model;
  const auto back  = fmu::read_model(fmu::model_json(model.data));
  EXPECT_EQ(fmu::model_json(back), fmu::model_json(model.data));
  const auto force = sample_force(20, 1.0 / 3e3);
  EXPECT_NE(fmu::series_csv(force).find("\n" + fmu::exact_number(force.time[7]) + ","), std::string::npos);
}

TEST(UnitDescription, BrokenTablesAreNamed)
{
  auto model                  = sample_stand().model;
  model.data.springs[2].start = 0;
  try {
    fmu::unit_archive(model, 2);
    FAIL() << "a spring of zero stiffness";
  } catch (const InputError &e) {
    EXPECT_STREQ(e.what(),
                 "error: the model cannot be exported as a functional mock-up unit: K3: the start value 0 N/m is "
                 "out of the range 1000 .. 1e+15");
  }
  auto variables                    = fmu::described_variables(sample_stand().model, 3);
  variables[3].variable.unit        = "furlong";
  variables[4].variable.variability = fmu::Variability::continuous;
  variables[5].variable.name        = variables[6].variable.name;
  variables[7].reference            = variables[6].reference;
  EXPECT_EQ(fmu::broken_rules(variables),
            (std::vector<std::string>{"M1: the unit \"furlong\" is not defined",
                                      "M2: parameter and continuous cannot be combined",
                                      "M4: the name is not unique", "M5: the value reference is not unique"}));
  EXPECT_TRUE(fmu::broken_rules(fmu::described_variables(sample_stand().model, 2)).empty());
}

TEST(UnitArchive, HoldsWhatTheStandardAsksForAndTheSameBytesEachTime)
{
  const auto model = sample_stand().model;
  for (const int version : {2, 3}) {
    const std::string archive = fmu::unit_archive(model, version);
    EXPECT_EQ(archive, fmu::unit_archive(model, version));
    EXPECT_EQ(archive.substr(0, 4), "PK\3\4");
    EXPECT_EQ(archive[4], 20) << "version needed 2.0";
    EXPECT_EQ(archive.substr(6, 2), std::string(2, '\0')) << "no flags";
    std::set<std::string> names;
    for (const auto &entry : fmu::entries_of(archive)) {
      EXPECT_TRUE(names.insert(entry.name).second);
      EXPECT_EQ(entry.name.find('\\'), std::string::npos);
      EXPECT_EQ(entry.executable, entry.name.find("binaries/") == 0) << entry.name;
    }
    for (const std::string name :
         {"modelDescription.xml", "resources/model.json", "documentation/index.html",
          "documentation/externalDependencies.txt", "documentation/licenses/license.txt",
          "documentation/staticLinking.txt", "sources/fmi2.cpp", "sources/buildDescription.xml",
          "sources/function_prefix.h", version == 3 ? "terminalsAndIcons/terminalsAndIcons.xml" : "model.png",
          version == 3 ? "binaries/x86_64-linux/sample_stand.so" : "binaries/linux64/sample_stand.so"})
      EXPECT_TRUE(names.count(name)) << name;
    EXPECT_FALSE(names.count("resources/force.csv"));
    // what the description lists as source is there
    for (const Element &e : elements_of(fmu::model_description(model, 2)))
      EXPECT_TRUE(e.name != "File" || names.count("sources/" + value(e, "name"))) << value(e, "name");
    for (const Element &e : elements_of(fmu::build_description(model)))
      EXPECT_TRUE(e.name != "SourceFile" || names.count("sources/" + value(e, "name"))) << value(e, "name");
  }
}

namespace {
std::string entry_of(const fmu::ExportedModel &model, const int version, const std::string &name)
{
  for (const auto &entry : fmu::entries_of(fmu::unit_archive(model, version)))
    if (entry.name == name)
      return entry.bytes;
  ADD_FAILURE() << "no " << name;
  return "";
}

// Kinds of the chunks of a PNG file, whose lengths must lead from one to the next.
std::vector<std::string> chunks_of(const std::string &png)
{
  std::vector<std::string> kinds;
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  for (std::size_t position = 8; position + 12 <= png.size();) {
    std::size_t length = 0;
    for (int i = 0; i < 4; ++i)
      length = 256 * length + static_cast<unsigned char>(png[position + std::size_t(i)]);
    kinds.push_back(png.substr(position + 4, 4));
    position += 12 + length;
    EXPECT_LE(position, png.size());
  }
  return kinds;
}
}  // namespace

TEST(UnitArchive, TerminalsNameVariablesOfTheDescriptionAndHaveTheirPicture)
{
  for (const fmu::ExportedModel &model : models()) {
    std::set<std::string> variables, terminals, members;
    for (const auto &[outer, inner] : variables_in(elements_of(fmu::model_description(model, 3))))
      variables.insert(value(outer, "name"));
    std::set<std::string> shown;
    std::string terminal;
    for (const Element &e : elements_of(fmu::terminals_and_icons(model))) {
      if (e.name == "Terminal") {
        terminal = value(e, "name");
        EXPECT_TRUE(terminals.insert(terminal).second) << terminal;
        EXPECT_EQ(value(e, "matchingRule"), "bus");
      }
      if (e.name == "TerminalMemberVariable") {
        EXPECT_EQ(variables.count(value(e, "variableName")), 1u) << value(e, "variableName");
        EXPECT_TRUE(members.insert(terminal + "." + value(e, "memberName")).second) << "unique in its terminal";
        EXPECT_EQ(value(e, "variableKind"), "signal");
        shown.insert(value(e, "variableName"));
      }
      if (e.name == "TerminalGraphicalRepresentation") {
        EXPECT_EQ(value(e, "iconBaseName"), "terminal");
        EXPECT_LE(std::abs(std::stod(value(e, "y1"))), 100);
      }
    }
    for (const char *name : {"F_roll", "F_cell", "a_upper_work_roll", "y_lower_frame"})
      EXPECT_EQ(shown.count(name), 1u) << name;
  }
  const std::vector<std::string> kinds{"IHDR", "IDAT", "IEND"};
  const auto model = sample_stand().model;
  EXPECT_EQ(chunks_of(entry_of(model, 2, "model.png")), kinds);
  for (const char *name : {"terminalsAndIcons/icon.png", "terminalsAndIcons/terminal.png"})
    EXPECT_EQ(chunks_of(entry_of(model, 3, name)), kinds);
}

TEST(UnitArchive, AnotherModelHasAnotherIdentity)
{
  std::set<std::string> seen;
  for (const fmu::ExportedModel &model : models())
    EXPECT_TRUE(seen.insert(fmu::identity_of(model)).second);
  auto changed                  = sample_stand().model;
  changed.data.springs[0].start = std::nextafter(changed.data.springs[0].start, 1e99);
  EXPECT_TRUE(seen.insert(fmu::identity_of(changed)).second) << "a last digit";
  for (const std::string &identity : seen)
    EXPECT_TRUE(std::regex_match(
        identity, std::regex(R"(\{[0-9a-f]{8}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{12}\})")))
        << identity;
}

TEST(UnitArchive, IdentifiersAreThoseOfCAndOfNoNameEmpty)
{
  EXPECT_EQ(fmu::identifier_of("four-high-1400"), "four_high_1400");
  EXPECT_EQ(fmu::identifier_of("1400 mm / F4"), "stand_1400_mm_F4");
  EXPECT_EQ(fmu::identifier_of("F-mill 4 (\xC3\xBC"
                               "bung)"),
            "F_mill_4_uebung");
  EXPECT_EQ(fmu::identifier_of("\xC3\xBC"), "ue");
  EXPECT_EQ(fmu::identifier_of("\xD0\xA1\xD1\x82\xD0\xB0\xD0\xBD"), "Stan") << "Cyrillic";
  EXPECT_EQ(fmu::identifier_of("\xCE\x9A\xCF\x8D\xCE\xBB"), "Kyl") << "Greek with an accent";
  EXPECT_EQ(fmu::identifier_of(std::string(200, 'x')).size(), 60u);
  // From scripts without a table, from signs and from nothing: numbers, different for different names.
  std::set<std::string> numbered;
  for (const char *name : {"\xE5\x9B\x9B\xE8\xBE\x8A", "\xE5\x85\xAD\xE8\xBE\x8A", "---", "+", ""}) {
    const std::string identifier = fmu::identifier_of(name);
    EXPECT_TRUE(std::regex_match(identifier, std::regex("stand_[0-9a-f]{8}"))) << name << ": " << identifier;
    EXPECT_EQ(fmu::identifier_of(identifier), identifier);
    EXPECT_TRUE(numbered.insert(identifier).second) << name;
  }
  EXPECT_TRUE(fmu::is_transliterated("\xC3\xBC"));
  EXPECT_FALSE(fmu::is_transliterated("stand 4"));
}
