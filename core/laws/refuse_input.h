#pragma once
#include <string>

namespace mill {
/// How a law says no: InputError of the program (core/base/errors.cpp), std::runtime_error of an exported unit
/// (dynamics/fmu/runtime/refuse_input.cpp).
[[noreturn]] void refuse_input(const std::string &message);
}  // namespace mill
