#pragma once
#include "core/base/parameter.h"
#include <optional>
#include <string>

namespace mill {
/// What the text of source_text() says.
struct SourceOfText {
  std::optional<Source> source;  ///< nothing: a word that this version does not know
  std::string method;            ///< what follows the word; all of the text without one
};
SourceOfText source_in(const std::string &source_text);
}  // namespace mill
