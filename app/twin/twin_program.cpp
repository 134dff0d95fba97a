#include "app/hand_over.h"
#include "app/twin/twin_command.h"

namespace mill {
int twin_command(const CommandLine &command)
{
  hand_over("millstand-twin", command.arguments, "millstand " + command.verb);
}
}  // namespace mill
