#pragma once
#include "core/base/choice.h"
#include <string>

namespace mill {
/// Words that --input, --speed and --listen take where a path, a number or an address is the rule.
enum class InputWord { lines };
constexpr auto words_of(InputWord)
{
  return choice_words<InputWord>("-");
}
enum class SpeedWord { max };
constexpr auto words_of(SpeedWord)
{
  return choice_words<SpeedWord>("max");
}
enum class ListenWord { none };
constexpr auto words_of(ListenWord)
{
  return choice_words<ListenWord>("none");
}

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
