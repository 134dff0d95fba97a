#pragma once
#include "core/process/memory.h"
#include <string>

namespace mill {
/// What std::bad_alloc means to the user: the stage, what is in use, what sets the end, what would make the need
/// smaller.
/// @param stage  where it happened; "" where no stage runs
OutOfMemory out_of_memory(const std::string &stage);

/// The stage that runs, the innermost one, or that an exception has left; "" where none does. (StageTimer tells.)
std::string stage_in_progress();

/// From now on an exception that cannot be caught, for instance in a thread of a library, and a library that calls
/// exit end the program with a sentence and an exit code of this program.
void end_with_a_sentence();
/// The program is ending now; an exit that follows is not that of a library.
void begin_normal_exit();
}  // namespace mill
