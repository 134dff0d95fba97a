#include "report/results/named_mode.h"
#include "core/base/source_text.h"

namespace mill::report {
std::string method_of(const Result &result)
{
  const auto [source, method] = source_in(result.source);
  return source == Source::computed && !method.empty() ? method : result.source;
}

NamedMode named_mode(const Result &mode)
{
  return named_mode_of(method_of(mode));
}
}  // namespace mill::report
