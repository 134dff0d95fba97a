#pragma once
#include "twin/records/named_arrays.h"
#include <string>

namespace mill::twin {
/// Everything a MATLAB file of level 5 holds: arrays of real numbers, those in fields of structures ("run.a") and
/// in cells ("run_1"), compressed or not. Source: The MathWorks, MAT-File Format, level 5 (public description,
/// 2019), chapter 1.
/// @param bytes  of the whole file
/// @throws InputError  not such a file, cut off, damaged, or one that unpacks to more than memory holds
NamedArrays mat_arrays(const std::string &file, const std::string &bytes);
}  // namespace mill::twin
