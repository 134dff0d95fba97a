#include "dynamics/fmu/description.h"
#include "core/records/xml_text.h"
#include "dynamics/fmu/embedded.h"
#include "dynamics/fmu/model_text.h"
#include "dynamics/fmu/runtime/log.h"
#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace mill::fmu {
namespace {
// name="value" pairs of one element.
class Attributes {
public:
  Attributes &add(const char *name, const std::string &value)
  {
    text_ += fmt::format(" {}=\"{}\"", name, escaped(value));
    return *this;
  }
  Attributes &add(const char *name, const double value)
  {
    return add(name, exact_number(value));
  }
  Attributes &add_if(const bool wanted, const char *name, const std::string &value)
  {
    return wanted ? add(name, value) : *this;
  }
  std::string element(const char *name) const
  {
    return fmt::format("<{}{}/>", name, text_);
  }
  std::string opening(const char *name) const
  {
    return fmt::format("<{}{}>", name, text_);
  }

private:
  std::string text_;
};

std::string root_of(const ExportedModel &model, const bool three)
{
  Attributes root;
  root.add("fmiVersion", three ? "3.0" : "2.0")
      .add("modelName", model.title)
      .add(three ? "instantiationToken" : "guid", model.data.guid)
      .add("description", model.method + ", " + model.origin)
      .add("version", runtime_version)
      .add("license", "MIT")
      .add("generationTool", model.program)
      .add("variableNamingConvention", "flat");
  return root.opening("fmiModelDescription");
}

std::string capabilities(const ExportedModel &model, const bool three)
{
  const bool linear  = model.data.kind != "chatter";
  const char *derive = linear ? "true" : "false";
  Attributes a;
  a.add("modelIdentifier", model.identifier).add("canHandleVariableCommunicationStepSize", "true");
  a.add("maxOutputDerivativeOrder", linear ? "1" : "0").add("canBeInstantiatedOnlyOncePerProcess", "false");
  a.add(three ? "canGetAndSetFMUState" : "canGetAndSetFMUstate", "true");
  a.add(three ? "canSerializeFMUState" : "canSerializeFMUstate", "true");
  a.add(three ? "providesDirectionalDerivatives" : "providesDirectionalDerivative", derive);
  a.add("needsExecutionTool", "false");
  if (three) {
    a.add("providesAdjointDerivatives", derive).add("providesIntermediateUpdate", "true");
    a.add("mightReturnEarlyFromDoStep", "false").add("canReturnEarlyAfterIntermediateUpdate", "false");
    a.add("hasEventMode", "false");
    return "  " + a.element("CoSimulation") + "\n";
  }
  a.add("canInterpolateInputs", "true").add("canRunAsynchronuously", "false");
  a.add("canNotUseMemoryManagementFunctions", "true");
  std::string text = "  " + a.opening("CoSimulation") + "\n    <SourceFiles>\n";
  for (const EmbeddedFile &file : source_files())
    if (std::string(file.name).find(".cpp") != std::string::npos)
      text += "      " + Attributes().add("name", file.name).element("File") + "\n";
  return text + "    </SourceFiles>\n  </CoSimulation>\n";
}

// Those that a variable names, and no others.
std::string units(const std::vector<DescribedVariable> &variables)
{
  std::set<std::string> named;
  for (const DescribedVariable &v : variables)
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

// Unit, range, start: those of the element of the type in both versions.
Attributes &add_values(Attributes &a, const Variable &v)
{
  if (v.type != Type::real)
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

std::string variable_2(const DescribedVariable &described)
{
  Attributes values;
  return identity(described).opening("ScalarVariable") +
         add_values(values, described.variable)
             .element(described.variable.type == Type::real ? "Real" : "Boolean") +
         "</ScalarVariable>";
}

std::string variable_3(const DescribedVariable &described)
{
  Attributes a = identity(described);
  a.add_if(described.variable.role == Role::bite_force, "intermediateUpdate", "true");
  return add_values(a, described.variable).element(described.variable.type == Type::real ? "Float64" : "Boolean");
}

bool is_output(const Variable &v)
{
  return v.causality == Causality::output;
}

// Accelerations follow the force at once; displacements and the load cell do not.
bool feels_force_at_once(const Variable &v)
{
  return v.role == Role::acceleration;
}

std::string structure_2(const std::vector<DescribedVariable> &variables)
{
  std::string outputs, unknowns, force;
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (variables[i].variable.role == Role::bite_force)
      force = std::to_string(i + 1);
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const Variable &v       = variables[i].variable;
    const std::string index = std::to_string(i + 1);
    if (is_output(v))
      outputs += "      " +
                 Attributes()
                     .add("index", index)
                     .add("dependencies", feels_force_at_once(v) ? force : "")
                     .element("Unknown") +
                 "\n";
    if (initial_of(v) == "calculated")
      unknowns += "      " + Attributes().add("index", index).element("Unknown") + "\n";
  }
  return "  <ModelStructure>\n    <Outputs>\n" + outputs + "    </Outputs>\n    <InitialUnknowns>\n" + unknowns +
         "    </InitialUnknowns>\n  </ModelStructure>\n";
}

std::string structure_3(const std::vector<DescribedVariable> &variables)
{
  std::string outputs, unknowns, force;
  for (const DescribedVariable &described : variables)
    if (described.variable.role == Role::bite_force)
      force = std::to_string(described.reference);
  for (const DescribedVariable &described : variables) {
    const Variable &v           = described.variable;
    const std::string reference = std::to_string(described.reference);
    if (is_output(v))
      outputs += "    " +
                 Attributes()
                     .add("valueReference", reference)
                     .add("dependencies", feels_force_at_once(v) ? force : "")
                     .element("Output") +
                 "\n";
    if (initial_of(v) == "calculated")
      unknowns += "    " + Attributes().add("valueReference", reference).element("InitialUnknown") + "\n";
  }
  return "  <ModelStructure>\n" + outputs + unknowns + "  </ModelStructure>\n";
}
}  // namespace

std::string escaped(const std::string &text)
{
  std::string plain = text;
  std::replace_if(
      plain.begin(), plain.end(), [](const char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return xml_text(plain);
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
  return text + "  </ModelVariables>\n" + (three ? structure_3(variables) : structure_2(variables)) +
         "</fmiModelDescription>\n";
}

std::string build_description(const ExportedModel &model)
{
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiBuildDescription fmiVersion=\"3.0\">\n  " +
                     Attributes()
                         .add("modelIdentifier", model.identifier)
                         .add("description", "C++17, no other library; every file into one shared library")
                         .opening("BuildConfiguration") +
                     "\n    " + Attributes().add("language", "C++17").opening("SourceFileSet") + "\n";
  for (const EmbeddedFile &file : source_files())
    if (std::string(file.name).find(".cpp") != std::string::npos)
      text += "      " + Attributes().add("name", file.name).element("SourceFile") + "\n";
  return text + "    </SourceFileSet>\n  </BuildConfiguration>\n</fmiBuildDescription>\n";
}
}  // namespace mill::fmu
