#pragma once
#include <string>

namespace mill {
/// As write_atomically(), for a file that the user wrote: a link is followed and stays, and the file keeps its
/// mode and, where the system allows it, its owner.
/// @throws SystemError, InputError  as write_atomically()
void save_in_place(const std::string &path, const std::string &text);
}  // namespace mill
