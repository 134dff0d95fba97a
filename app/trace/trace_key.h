#pragma once
#include "app/trace/closed_form_parts.h"
#include "core/case/case_file.h"
#include "core/case/fields.h"
#include "core/model/strip.h"
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mill {
struct Case;

/// One input of a case: its row, its value, and how it is changed.
struct TraceKey {
  std::string name;  ///< "backup_roll.barrel_diameter", "pass.0.load"
  std::string path;  ///< as --set addresses it; names with dots in quotes
  Row row{"", Kind::text, "text", {}, absent, "", ""};
  std::optional<Node> value;  ///< as written, as the default, or what represents it; nothing: not given
  std::string shown;          ///< "1450 mm", "not given"
  bool stands_in = false;     ///< the value is what the program takes where the key is not given
  std::string origin;         ///< "cases/four-high-1400.toml:33", "default", "--set ...", or what represents it
};

/// What the program takes for a key that is not given, where that has a size.
struct StandIn {
  double value;        ///< SI
  std::string origin;  ///< "not given: the entry thickness"
};

/// Number of the pass that a key belongs to.
std::optional<std::size_t> pass_of(const TraceKey &key);
/// A result in the place of a given value.
std::optional<StandIn> computed_instead(const std::vector<ClosedFormResult> &closed, const std::string &name);
/// A value of [strip] in the place of that of a pass.
std::optional<StandIn> strip_instead(const Strip &strip, const TraceKey &key);

/// Every input that a case of this kind may have, with its bearings and passes; without values.
std::vector<TraceKey> keys_of(const Case &the_case);

/// One of them with its value.
/// @param sets   as given to read_case
/// @param closed  results of the case: they give a value that is not given but computed
/// @throws InputError  unknown key, with the nearest known one
TraceKey find_key(const Case &the_case, const std::vector<std::string> &sets, const std::string &name,
                  const std::vector<ClosedFormResult> &closed);

/// resolved.toml, full key -> value as TOML: what is given, defaults, what the reader filled in.
std::map<std::string, std::string> resolved_values(const std::string &text);

/// The value with every number changed by `change`, as TOML.
/// @param change  number as written -> number
std::string changed_toml(const Node &value, const std::function<double(double)> &change);

/// First number of a value as written, and its unit ("" for a bare number).
double first_number(const Node &value);
std::string unit_written(const Node &value);
}  // namespace mill
