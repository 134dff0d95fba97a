#include "core/records/parameter.h"

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
  const std::string name = name_of(parameter.source);
  return parameter.method.empty() ? name : name + ": " + parameter.method;
}
}  // namespace mill
