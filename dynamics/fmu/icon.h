#pragma once
#include <string>

namespace mill::fmu {
/// Picture of a four-high stand with strip, 96 x 96 points, as the bytes of a PNG file; the same each time.
/// @throws std::runtime_error  zlib refuses it
std::string icon_png();
/// Picture of a terminal, 16 x 16 points.
std::string terminal_png();
}  // namespace mill::fmu
