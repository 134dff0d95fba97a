#include "core/base/parameter.h"

namespace mill {
const char *name_of(const Source source)
{
  switch (source) {
  case Source::computed:
    return "computed";
  case Source::given:
    return "given";
  case Source::published:
    return "published";
  case Source::measured:
    return "measured";
  case Source::assumed:
    return "assumed";
  case Source::estimated:
    return "estimated";
  }
  return "";
}

std::string source_text(const Parameter &parameter)
{
  std::string text = name_of(parameter.source);
  if (!parameter.method.empty())
    text += ": " + parameter.method;
  if (const std::size_t n = parameter.estimated.size(); n > 0)
    text += (parameter.method.empty() ? ": " : "; ") + std::to_string(n) +
            (n == 1 ? " of its inputs is estimated" : " of its inputs are estimated");
  return text;
}
}  // namespace mill
