#pragma once
#include "dynamics/fmu/exported_model.h"
#include "dynamics/fmu/runtime/variables.h"
#include <string>
#include <vector>

namespace mill::fmu {
/// A variable with the words and the places that a description gives it.
struct DescribedVariable {
  Variable variable;
  std::string text;        ///< what it is, sign, where its value comes from
  unsigned reference = 0;  ///< its place in the table of the runtime
};

/// The variables that a version of the standard shows: FMI 2 without the time.
std::vector<DescribedVariable> described_variables(const ExportedModel &model, int fmi_version);

/// What the input is, its sign, and what it contains: "rolling force, positive pushes the work rolls apart: ...".
std::string force_text(const ExportedModel &model);

/// Version of the model: the first eight digits of its identity, which another model does not share.
std::string version_of(const ExportedModel &model);

/// Words of the standard.
const char *name_of(Causality causality);
const char *name_of(Variability variability);
/// "exact", "calculated", or empty for inputs and the time, which have none.
bool is_calculated(const Variable &variable);  ///< from the others when the unit starts
std::string initial_of(const Variable &variable);

/// name="value" pairs of one element of XML.
class Attributes {
public:
  Attributes &add(const char *name, const std::string &value);
  Attributes &add(const char *name, double value);
  Attributes &add_if(bool wanted, const char *name, const std::string &value);
  std::string element(const std::string &name) const;  ///< "<name a="1"/>"
  std::string opening(const std::string &name) const;  ///< "<name a="1">"

private:
  std::string text_;
};

/// modelDescription.xml of version 2 or 3.
std::string model_description(const ExportedModel &model, int fmi_version);
/// terminalsAndIcons/terminalsAndIcons.xml of version 3: which variables belong together, and where they are
/// drawn.
std::string terminals_and_icons(const ExportedModel &model);
/// Name of the picture of a terminal, without its ending.
constexpr const char *terminal_icon = "terminal";

/// sources/buildDescription.xml.
std::string build_description(const ExportedModel &model);
/// documentation/index.html.
std::string documentation_page(const ExportedModel &model, int fmi_version);
/// documentation/externalDependencies.txt.
std::string external_dependencies();
/// documentation/staticLinking.txt: how the sources become part of a program.
std::string static_linking(const ExportedModel &model);

/// Text for XML: & < > " and line ends escaped.
std::string escaped(const std::string &text);

/// Rules of the standard that a table of variables must keep: combinations of attributes, start values, ranges,
/// units, unique names.  One sentence for each that is broken.
std::vector<std::string> broken_rules(const std::vector<DescribedVariable> &variables);

/// A unit with its exponents of kg, m, s and the units that show it: displayed = factor * value.
struct UnitRow {
  const char *name;
  int kg, m, s;
  std::vector<std::pair<const char *, double>> displays;
};
const std::vector<UnitRow> &unit_rows();
}  // namespace mill::fmu
