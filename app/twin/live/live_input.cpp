#include "app/twin/live/live_input.h"
#include "core/base/errors.h"
#include "core/base/units.h"
#include "core/base/visible_text.h"
#include <fmt/format.h>
#include <limits>
#include <set>
#include <utility>

namespace mill {
LiveInput live_input(const std::string &text)
{
  if (text.empty())
    return {};
  if (text == word_of(InputWord::lines))
    return {LiveInput::Kind::lines, ""};
  const auto colon        = text.find(':');
  const std::string begin = colon == std::string::npos ? "" : text.substr(0, colon);
  const std::string rest  = colon == std::string::npos ? "" : text.substr(colon + 1);
  for (const auto &[word, kind] :
       {std::pair("tail", LiveInput::Kind::tail), std::pair("tcp", LiveInput::Kind::tcp),
        std::pair("mqtt", LiveInput::Kind::mqtt)})
    if (begin == word && (kind != LiveInput::Kind::tail || !rest.empty()))
      return {kind, rest};
  const auto dot           = text.rfind('.');
  const std::string ending = dot == std::string::npos ? "" : text.substr(dot);
  static const std::set<std::string> of_records{".csv", ".txt", ".tsv", ".asc", ".dat"};
  if (begin.empty() && of_records.count(ending))
    return {LiveInput::Kind::replay, text};
  throw InputError(
      fmt::format("--input \"{}\": a record (FILE.csv), a growing one (tail:FILE.csv), - for lines on "
                  "standard input, tcp:127.0.0.1:8461 or mqtt:127.0.0.1:1883/STAND is needed",
                  visible(text, true)));
}

double replay_speed(const std::string &text)
{
  if (text == word_of(SpeedWord::max))
    return std::numeric_limits<double>::infinity();
  double speed = 1;
  if (!text.empty() && (!parse_number(text, speed) || !(speed > 0)))
    throw InputError(
        fmt::format("--speed \"{}\": a number above zero (1 is real time) or max is needed", visible(text, true)));
  return speed;
}
}  // namespace mill
