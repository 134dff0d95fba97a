#pragma once
#include <string>

namespace mill {
/// Starts a program of the same folder in place of this one, with `arguments` as main() gets them; does not
/// return.
/// @param program  its file name, which is also the target that builds it
/// @param what     what it carries out, for the message
/// @throws InputError  it cannot be started; the message says what builds it
[[noreturn]] void hand_over(const std::string &program, char **arguments, const std::string &what);
}  // namespace mill
