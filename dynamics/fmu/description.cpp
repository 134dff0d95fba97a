#include "dynamics/fmu/description.h"
#include "core/records/xml_text.h"
#include "dynamics/fmu/dependencies.h"
#include "dynamics/fmu/embedded.h"
#include "dynamics/fmu/model_text.h"
#include "dynamics/fmu/runtime/log.h"
#include "dynamics/fmu/source_names.h"
#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace mill::fmu {
Attributes &Attributes::add(const char *name, const std::string &value)
{
  text_ += fmt::format(" {}=\"{}\"", name, escaped(value));
  return *this;
}

Attributes &Attributes::add(const char *name, const double value)
{
  return add(name, exact_number(value));
}

Attributes &Attributes::add_if(const bool wanted, const char *name, const std::string &value)
{
  return wanted ? add(name, value) : *this;
}

std::string Attributes::element(const std::string &name) const
{
  return fmt::format("<{}{}/>", name, text_);
}

std::string Attributes::opening(const std::string &name) const
{
  return fmt::format("<{}{}>", name, text_);
}

namespace {
std::string root_of(const ExportedModel &model, const bool three)
{
  Attributes root;
  root.add("fmiVersion", three ? "3.0" : "2.0")
      .add("modelName", model.title)
      .add(three ? "instantiationToken" : "guid", model.data.guid)
      .add("description", model.method + ", " + model.origin)
      .add("version", version_of(model))
      .add("license", "runtime: MIT; model and its data: property of their owner")
      .add("generationTool", model.program)
      .add("variableNamingConvention", "flat");
  return root.opening("fmiModelDescription");
}

std::string capabilities(const ExportedModel &model, const bool three)
{
  const bool chatter = model.data.kind == StandKind::chatter;
  const char *derive = chatter ? "false" : "true";
  Attributes a;
  a.add("modelIdentifier", model.identifier).add("canHandleVariableCommunicationStepSize", "true");
  a.add("maxOutputDerivativeOrder", chatter ? "0" : "1").add("canBeInstantiatedOnlyOncePerProcess", "false");
  a.add(three ? "canGetAndSetFMUState" : "canGetAndSetFMUstate", "true");
  a.add(three ? "canSerializeFMUState" : "canSerializeFMUstate", "true");
  a.add(three ? "providesDirectionalDerivatives" : "providesDirectionalDerivative", derive);
  a.add("needsExecutionTool", "false");
  if (three) {
    a.add("providesAdjointDerivatives", derive).add("providesIntermediateUpdate", "true");
    a.add("mightReturnEarlyFromDoStep", chatter ? "true" : "false")
        .add("canReturnEarlyAfterIntermediateUpdate", "false");
    a.add("hasEventMode", "false");
    return "  " + a.element("CoSimulation") + "\n";
  }
  a.add("canInterpolateInputs", "true").add("canRunAsynchronuously", "false");
  a.add("canNotUseMemoryManagementFunctions", "true");
  std::string text = "  " + a.opening("CoSimulation") + "\n    <SourceFiles>\n";
  for (const EmbeddedFile &file : source_files())
    if (is_compiled(file.name))
      text += "      " + Attributes().add("name", file.name).element("File") + "\n";
  return text + "    </SourceFiles>\n  </CoSimulation>\n";
}

// Those that a variable names, and no others.
std::string units(const std::vector<DescribedVariable> &variables)
{
  std::set<std::string> named;
  for (const DescribedVariable &v : variables)
    if (v.variable.type == Type::real)
      named.insert(v.variable.unit);
  std::string text = "  <UnitDefinitions>\n";
  for (const UnitRow &unit : unit_rows()) {
    if (!named.count(unit.name))
      continue;
    Attributes base;
    for (const auto &[name, exponent] : {std::pair("kg", unit.kg), std::pair("m", unit.m), std::pair("s", unit.s)})
      base.add_if(exponent != 0, name, std::to_string(exponent));
    text += "    " + Attributes().add("name", unit.name).opening("Unit") + base.element("BaseUnit");
    for (const auto &[name, factor] : unit.displays)
      text += Attributes().add("name", name).add("factor", factor).element("DisplayUnit");
    text += "</Unit>\n";
  }
  return text + "  </UnitDefinitions>\n";
}

std::string categories()
{
  std::string text = "  <LogCategories>\n";
  for (const LogCategory &category : log_categories())
    text += "    " +
            Attributes().add("name", category.name).add("description", category.description).element("Category") +
            "\n";
  return text + "  </LogCategories>\n";
}

std::string experiment(const ExportedModel &model)
{
  const auto n = model.series.time.size();
  return "  " +
         Attributes()
             .add("startTime", n > 0 ? model.series.time[0] : 0)
             .add("stopTime", n > 0 ? model.series.time[n - 1] : 1)
             .add("stepSize", model.step)
             .element("DefaultExperiment") +
         "\n";
}

// Unit, range and start, which both versions write into the element of the type.
Attributes &add_values(Attributes &a, const Variable &v)
{
  if (v.type != Type::real)  // no count has a start value
    return a.add_if(v.has_start(), "start", v.start != 0 ? "true" : "false");
  a.add("unit", v.unit).add_if(*v.display_unit, "displayUnit", v.display_unit);
  if (v.bounded())
    a.add("min", v.low).add("max", v.high);
  if (v.nominal > 0)
    a.add("nominal", v.nominal);
  return v.has_start() ? a.add("start", v.start) : a;
}

Attributes identity(const DescribedVariable &described)
{
  const Variable &v = described.variable;
  Attributes a;
  a.add("name", v.name).add("valueReference", std::to_string(described.reference));
  a.add("description", described.text).add("causality", name_of(v.causality));
  a.add("variability", name_of(v.variability));
  a.add_if(!initial_of(v).empty(), "initial", initial_of(v));
  return a;
}

std::string type_of(const Variable &v, const bool three)
{
  if (v.type == Type::boolean)
    return "Boolean";
  if (v.type == Type::whole)
    return three ? "Int32" : "Integer";
  return three ? "Float64" : "Real";
}

std::string variable_2(const DescribedVariable &described)
{
  Attributes values;
  return identity(described).opening("ScalarVariable") +
         add_values(values, described.variable).element(type_of(described.variable, false)) + "</ScalarVariable>";
}

std::string variable_3(const DescribedVariable &described)
{
  Attributes a = identity(described);
  a.add_if(described.variable.role == Role::bite_force, "intermediateUpdate", "true");
  return add_values(a, described.variable).element(type_of(described.variable, true));
}

bool is_output(const Variable &v)
{
  return v.causality == Causality::output;
}

// What version 2 calls a variable is its place in the description, in version 3 its reference.
std::string named_by(const std::vector<DescribedVariable> &variables, const std::vector<unsigned> &references,
                     const bool three)
{
  std::string text;
  for (std::size_t i = 0; i < variables.size(); ++i)
    for (const unsigned reference : references)
      if (variables[i].reference == reference)
        text += (text.empty() ? "" : " ") + std::to_string(three ? reference : unsigned(i + 1));
  return text;
}

std::string structure(const std::vector<DescribedVariable> &variables, const Dependencies &depends,
                      const bool three)
{
  const char *id = three ? "valueReference" : "index";
  std::string outputs, unknowns;
  for (const DescribedVariable &described : variables) {
    const Variable &v      = described.variable;
    const std::string name = named_by(variables, {described.reference}, three);
    const auto row         = [&](const std::vector<unsigned> &knowns, const char *element) {
      return std::string(three ? "    " : "      ") +
             Attributes().add(id, name).add("dependencies", named_by(variables, knowns, three)).element(element) +
             "\n";
    };
    if (is_output(v)) {
      const auto knowns = depends.at_communication(v);
      outputs += row(three ? knowns : depends.inputs_of(knowns), three ? "Output" : "Unknown");
    }
    if (is_calculated(v))
      unknowns += row(depends.at_start(v), three ? "InitialUnknown" : "Unknown");
  }
  if (three)
    return "  <ModelStructure>\n" + outputs + unknowns + "  </ModelStructure>\n";
  return "  <ModelStructure>\n    <Outputs>\n" + outputs + "    </Outputs>\n    <InitialUnknowns>\n" + unknowns +
         "    </InitialUnknowns>\n  </ModelStructure>\n";
}
}  // namespace

std::string escaped(const std::string &text)
{
  std::string plain = text;
  std::replace_if(
      plain.begin(), plain.end(), [](const char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return xml_text(plain);
}

std::string version_of(const ExportedModel &model)
{
  return model.data.guid.substr(1, 8);  // behind the bracket
}

std::string model_description(const ExportedModel &model, const int fmi_version)
{
  const bool three     = fmi_version == 3;
  const auto variables = described_variables(model, fmi_version);
  std::string text     = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + root_of(model, three) + "\n" +
                     capabilities(model, three) + units(variables) + categories() + experiment(model) +
                     "  <ModelVariables>\n";
  for (const DescribedVariable &v : variables)
    text += "    " + (three ? variable_3(v) : variable_2(v)) + "\n";
  return text + "  </ModelVariables>\n" + structure(variables, Dependencies(model.data), three) +
         "</fmiModelDescription>\n";
}

std::string build_description(const ExportedModel &model)
{
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiBuildDescription fmiVersion=\"3.0\">\n  " +
                     Attributes()
                         .add("modelIdentifier", model.identifier)
                         .add("description", "C++17, no other library")
                         .opening("BuildConfiguration") +
                     "\n    " + Attributes().add("language", "C++17").opening("SourceFileSet") + "\n";
  for (const EmbeddedFile &file : source_files())
    if (is_compiled(file.name))
      text += "      " + Attributes().add("name", file.name).element("SourceFile") + "\n";
  return text + "    </SourceFileSet>\n  </BuildConfiguration>\n</fmiBuildDescription>\n";
}
}  // namespace mill::fmu
