#pragma once
#include <string>

namespace mill {
std::string version();  ///< of the program, "0.1.0"
}  // namespace mill
