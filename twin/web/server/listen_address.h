#pragma once
#include <string>

namespace mill::web {
/// An address with a port.
struct AddressAndPort {
  std::string address;  ///< literal, brackets of IPv6 taken off
  int port = 0;
};
/// "127.0.0.1:8461", "[::1]:8461", ":8461".  @throws InputError  with the name of the option
AddressAndPort address_and_port(const std::string &option, const std::string &text, const std::string &sample);
}  // namespace mill::web
