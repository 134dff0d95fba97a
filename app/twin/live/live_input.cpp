#include "app/twin/live/live_input.h"
#include "core/base/errors.h"
#include "core/base/units.h"
#include "core/base/visible_text.h"
#include <fmt/format.h>
#include <limits>

namespace mill {
LiveInput live_input(const std::string &text)
{
  if (text.empty())
    return {};
  if (text == "-")
    return {LiveInput::Kind::lines, ""};
  const auto colon       = text.find(':');
  const std::string kind = colon == std::string::npos ? "" : text.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (kind == "tail" && !rest.empty())
    return {LiveInput::Kind::tail, rest};
  if (kind == "tcp")
    return {LiveInput::Kind::tcp, rest};
  if (kind == "mqtt")
    return {LiveInput::Kind::mqtt, rest};
  const auto dot           = text.rfind('.');
  const std::string ending = dot == std::string::npos ? "" : text.substr(dot);
  if (kind.empty() &&
      (ending == ".csv" || ending == ".txt" || ending == ".tsv" || ending == ".asc" || ending == ".dat"))
    return {LiveInput::Kind::replay, text};
  throw InputError(
      fmt::format("--input \"{}\": a record (FILE.csv), a growing one (tail:FILE.csv), - for lines on "
                  "standard input, tcp:127.0.0.1:8461 or mqtt:127.0.0.1:1883/STAND is needed",
                  visible(text, true)));
}

double replay_speed(const std::string &text)
{
  if (text == "max")
    return std::numeric_limits<double>::infinity();
  double speed = 1;
  if (!text.empty() && (!parse_number(text, speed) || !(speed > 0)))
    throw InputError(
        fmt::format("--speed \"{}\": a number above zero (1 is real time) or max is needed", visible(text, true)));
  return speed;
}
}  // namespace mill
