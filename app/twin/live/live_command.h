#pragma once
#include "app/command/command_line.h"

namespace mill {
struct Case;

/// millstand live: the chain of a case in parallel with the mill, driven by what a source sends, until the source
/// ends or a signal asks for the end.
/// @throws InputError  a case that cannot be stepped, a source, an address or an option that is wrong
int live_command(const CommandLine &command, const Case &the_case);
}  // namespace mill
