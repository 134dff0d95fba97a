#pragma once
#include <string>

namespace mill {
/// Where samples come from.
struct LiveInput {
  enum class Kind { replay, tail, lines, tcp, mqtt } kind = Kind::tcp;
  std::string target = "127.0.0.1:8461";  ///< path, ADDR:PORT, HOST:PORT/STAND
};
/// @throws InputError  not one of them
LiveInput live_input(const std::string &text);

/// An address with a port.
struct AddressAndPort {
  std::string address;  ///< literal, brackets of IPv6 taken off
  int port = 0;
};
/// "127.0.0.1:8461", "[::1]:8461", ":8461".  @throws InputError  with the name of the option
AddressAndPort address_and_port(const std::string &option, const std::string &text, const std::string &sample);

/// "1", "10", "max".  @throws InputError
double replay_speed(const std::string &text);
}  // namespace mill
