#pragma once
#include <functional>
#include <string>
#include <vector>

namespace mill {
/// A place in the names of results: "{pass}".
struct ResultPlace {
  const char *name;                                       ///< "pass"
  std::vector<std::string> on_page;                       ///< in the names of docs/output.md: "PASS"
  std::function<bool(const std::string &part)> takes;     ///< whether a part of a name may be in it
  std::function<std::string(const std::string &)> words;  ///< the part in a sentence: "3" -> "row 3"
  bool takes_rest = false;  ///< all that follows, points in it too: a key of the case
};

/// The word of docs/output.md for a key of the case.
constexpr const char *any_key = "KEY";

/// The place of this name; an unknown one is our bug.  @throws std::logic_error
const ResultPlace &result_place(const std::string &name);
const std::vector<ResultPlace> &result_places();
}  // namespace mill
