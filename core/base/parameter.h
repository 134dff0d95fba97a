#pragma once
#include "core/base/operating_point.h"
#include <limits>
#include <string>
#include <vector>

namespace mill {
/// Where a number comes from.  Computed and published values differ by factors here, so they never mix unseen.
enum class Source {
  computed,   ///< by this program, method named
  given,      ///< in [given] of the case file, replaces what would be computed
  published,  ///< as given, and marked by the user as a published value
  measured,   ///< from a measured record
  assumed,    ///< not known; the report names the value as an assumption
  estimated   ///< by a formula or rule from what is known, for what a drawing or a catalogue hides
};
const char *name_of(Source source);

/// A value that a number is compared with: a closed form, a standard, a published or measured value.
struct Check {
  std::string name;  ///< "Hertz line contact, axis to axis (3.5b)"
  double value = 0;  ///< in the unit of the number that is compared with it
  std::string note;  ///< why it may differ; may be empty
};

/// One number with its proof.  Everything the program reports is made of these.
struct Parameter {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< SI
  std::string unit;                                         ///< SI unit as text: "N/m", "kg", "Hz", "m/s2", "1"
  Source source = Source::computed;
  std::string method;  ///< "contact FEM", "series springs"; empty when given
  OperatingPoint at;   ///< load or state it belongs to, "976.2 kN"; empty when it has none
  double error_estimate = std::numeric_limits<double>::quiet_NaN();  ///< relative; NaN: none can be stated
  /// Why none can be stated: keys of the case file, or results, whose own error is not known.  Empty with a
  /// number.
  std::vector<std::string> error_lacks;
  std::vector<std::string> inputs;  ///< keys of the case file it was made from, "work_roll.barrel_diameter"
  std::vector<Check> checks;
  std::vector<std::string> estimated;  ///< those of the inputs that the case leaves to an estimate
};

/// "computed: contact FEM", "given", "assumed: F/20"
std::string source_text(const Parameter &parameter);
}  // namespace mill
