#pragma once
#include <string>
#include <utility>
#include <vector>

namespace mill::fmu {
/// A value of a JSON file, as far as resources/model.json needs it.
struct Json {
  enum class Kind { nothing, boolean, number, text, list, object };
  Kind kind     = Kind::nothing;
  bool truth    = false;
  double number = 0;  ///< as written
  std::string text;
  std::vector<Json> items;                            ///< of a list
  std::vector<std::pair<std::string, Json>> members;  ///< of an object, in the order of the file
  const Json *find(const std::string &name) const;    ///< nullptr when absent
};

/// @throws std::runtime_error  the text is not JSON: what is wrong, and at which byte
Json read_json(const std::string &text);

/// A decimal number, read alike in every locale.  False: the text is not a number, or something follows it.
bool read_number(const char *begin, const char *end, double &value);
}  // namespace mill::fmu
