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
  const std::regex tag(R"(<(/?)([A-Za-z0-9]+)((?:\s+[A-Za-z0-9]+="[^"<>]*")*)\s*(/?)>)");
  const std::regex attribute(R"re(([A-Za-z0-9]+)="([^"]*)")re");
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
  SampleStand with = sample_stand("published", 0.02, 1e6);
  carry(with.model, sample_force(50, 1e-3));
  return {sample_stand().model, with.model, in_modes(sample_stand())};
}
}  // namespace

TEST(UnitDescription, EveryVariableKeepsTheRules)
{
  const std::set<std::pair<std::string, std::string>> legal{
      {"parameter",           "fixed"     },
      {"parameter",           "tunable"   },
      {"calculatedParameter", "fixed"     },
      {"calculatedParameter", "tunable"   },
      {"input",               "continuous"},
      {"output",              "continuous"},
      {"independent",         "continuous"}
  };
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
      std::string force;
      std::size_t index = 0;
      for (const auto &[outer, inner] : variables_in(all)) {
        const std::string id = version == 2 ? std::to_string(++index) : value(outer, "valueReference");
        if (value(outer, "causality") == "output")
          outputs.push_back(id);
        if (value(outer, "initial") == "calculated")
          unknowns.push_back(id);
        if (value(outer, "causality") == "input")
          force = id;
      }
      for (const Element &e : all) {
        const std::string id = value(e, version == 2 ? "index" : "valueReference");
        if (e.parent == "Outputs" || e.name == "Output") {
          listed_outputs.push_back(id);
          EXPECT_TRUE(value(e, "dependencies") == force || value(e, "dependencies").empty());
        }
        if (e.parent == "InitialUnknowns" || e.name == "InitialUnknown") {
          listed_unknowns.push_back(id);
          EXPECT_FALSE(has(e, "dependencies")) << "left out: depends on all";
        }
      }
      EXPECT_EQ(listed_outputs, outputs);
      EXPECT_EQ(listed_unknowns, unknowns);
    }
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
                                      "M2: parameter and continuous do not go together",
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
          "documentation/externalDependencies.txt", "documentation/licenses/license.txt", "sources/fmi2.cpp",
          "sources/buildDescription.xml",
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

TEST(UnitArchive, IdentifiersAreThoseOfC)
{
  EXPECT_EQ(fmu::identifier_of("four-high-1400"), "four_high_1400");
  EXPECT_EQ(fmu::identifier_of("1400 mm / F4"), "stand_1400_mm_F4");
  EXPECT_EQ(fmu::identifier_of("\xC3\xBC"), "stand_");
  EXPECT_EQ(fmu::identifier_of(std::string(200, 'x')).size(), 60u);
}
