#include "report/results/named_mode.h"

namespace mill::report {
std::string mode_in_words(const std::string &method)
{
  return method.substr(0, method.find(": "));
}

NamedMode named_mode(const Result &mode)
{
  // "computed: NAME: DECIDED; method of the frequency"
  const std::string start = "computed: ";
  const std::string text  = mode.source.rfind(start, 0) == 0 ? mode.source.substr(start.size()) : mode.source;
  const auto colon = text.find(": "), end = text.rfind("; ");
  NamedMode named{mode_in_words(text), "", ""};
  if (colon != std::string::npos)
    named.why = text.substr(colon + 2, end == std::string::npos ? end : end - colon - 2);
  if (end != std::string::npos)
    named.model = text.substr(end + 2);
  return named;
}
}  // namespace mill::report
