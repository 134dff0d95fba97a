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

/// "1", "10", "max".  @throws InputError
double replay_speed(const std::string &text);
}  // namespace mill
