#pragma once
#include <string>

namespace mill {
/// Folder of the program that this code is part of, or of the library where it was loaded as one (Python): what it
/// opens and starts is in the same folder.
std::string own_folder();

/// The library that holds what is made of Gmsh and deal.II.  Opening it takes some tenths of a second, which a
/// program without finite elements does not spend.
inline constexpr const char *finite_elements = "millstand-fem.so";

/// A function of a library that was built with this program and is in the same folder or in one that the program
/// was linked with (RUNPATH); opened at the first call and never closed, since what it made lives on.
/// @throws SystemError     it is not there, cannot be opened or is of another build; with the path and the remedy
/// @throws std::bad_alloc  no room for it (ulimit -v)
void *function_of_own_library(const char *library, const char *function);
}  // namespace mill
