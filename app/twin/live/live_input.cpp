#include "app/twin/live/live_input.h"
#include "core/base/errors.h"
#include "core/base/units.h"
#include "core/base/visible_text.h"
#include <cmath>
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
  if (kind.empty() && (ending == ".csv" || ending == ".txt" || ending == ".tsv" || ending == ".asc" || ending == ".dat"))
    return {LiveInput::Kind::replay, text};
  throw InputError(
      fmt::format("--input \"{}\": a record (FILE.csv), a growing one (tail:FILE.csv), - for lines on "
                  "standard input, tcp:127.0.0.1:8461 or mqtt:127.0.0.1:1883/STAND is needed",
                  visible(text, true)));
}

AddressAndPort address_and_port(const std::string &option, const std::string &text, const std::string &sample)
{
  const auto colon    = text.rfind(':');
  std::string address = text.substr(0, colon == std::string::npos ? 0 : colon);
  if (address.size() > 2 && address.front() == '[' && address.back() == ']')
    address = address.substr(1, address.size() - 2);
  double port = 0;
  if (colon == std::string::npos || !parse_number(text.substr(colon + 1), port) || port != std::floor(port) ||
      !(port >= 0 && port <= 65535))
    throw InputError(fmt::format("{} \"{}\": an address and a port are needed, for example {} {}", option,
                                 visible(text, true), option, sample));
  return {address.empty() ? "127.0.0.1" : address, int(port)};
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
