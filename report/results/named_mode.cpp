#include "report/results/named_mode.h"
#include "core/base/source_text.h"

namespace mill::report {
std::string method_of(const Result &result)
{
  const auto [source, method] = source_in(result.source);
  return source == Source::computed && !method.empty() ? method : result.source;
}

std::string mode_in_words(const std::string &method)
{
  return method.substr(0, method.find(": "));
}

NamedMode named_mode(const Result &mode)
{
  const std::string text = method_of(mode);  // "NAME: DECIDED; method of the frequency"
  const auto colon = text.find(": "), end = text.rfind("; ");
  NamedMode named{mode_in_words(text), "", ""};
  if (colon != std::string::npos)
    named.why = text.substr(colon + 2, end == std::string::npos ? end : end - colon - 2);
  if (end != std::string::npos)
    named.model = text.substr(end + 2);
  return named;
}
}  // namespace mill::report
