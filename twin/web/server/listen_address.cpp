#include "twin/web/server/listen_address.h"
#include "core/base/errors.h"
#include "core/base/units.h"
#include "core/base/visible_text.h"
#include <cmath>
#include <fmt/format.h>

namespace mill::web {
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
}  // namespace mill::web
