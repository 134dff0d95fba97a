#pragma once
#include <map>
#include <string>

namespace mill {
/// Names of the sections of a resolved.toml, from its header lines in their order.
class ResolvedSections {
public:
  /// "roll.1.saddles." for "[roll.saddles]" below the second "[[roll]]", "pass.0." for the first "[[pass]]";
  /// without the quotes of a name.
  /// @param header  line that begins with '['
  std::string prefix(const std::string &header);

private:
  std::map<std::string, int> listed_;  // sections of each name in double brackets so far
};
}  // namespace mill
