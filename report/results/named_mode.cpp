#include "report/results/named_mode.h"

namespace mill::report {
NamedMode named_mode(const Result &mode)
{
  // "computed: NAME: DECIDED; method of the frequency"
  const std::string start = "computed: ";
  const std::string text  = mode.source.rfind(start, 0) == 0 ? mode.source.substr(start.size()) : mode.source;
  const auto colon = text.find(": "), end = text.rfind("; ");
  NamedMode named{text.substr(0, colon), "", ""};
  if (colon != std::string::npos)
    named.why = text.substr(colon + 2, end == std::string::npos ? end : end - colon - 2);
  if (end != std::string::npos)
    named.model = text.substr(end + 2);
  return named;
}
}  // namespace mill::report
