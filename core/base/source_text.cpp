#include "core/base/source_text.h"

namespace mill {
SourceOfText source_in(const std::string &source_text)
{
  const auto colon       = source_text.find(": ");
  const std::string word = source_text.substr(0, colon);
  for (const Source source :
       {Source::computed, Source::given, Source::published, Source::measured, Source::assumed, Source::estimated})
    if (word == name_of(source))
      return {source, colon == std::string::npos ? "" : source_text.substr(colon + 2)};
  return {std::nullopt, source_text};
}
}  // namespace mill
