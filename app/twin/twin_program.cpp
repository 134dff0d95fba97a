#include "app/hand_over.h"
#include "app/twin/twin_command.h"

namespace mill {
int twin_command(const CommandLine &command)
{
  // Of the verb report only the pages of its folders are there.
  hand_over("millstand-twin", command.arguments,
            command.verb == "report" ? "the page of records" : "millstand " + command.verb);
}
}  // namespace mill
