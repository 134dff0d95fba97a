#pragma once
#include <string>

// The parts of the sentence of a problem, for a program that reads it: "KEY = VALUE is wrong; what to change".
namespace mill {
/// The value as written, "14500 mm", "[1.05, 0.95]"; empty: the sentence names none.
std::string value_in_message(const std::string &message);

/// What to change: behind the last semicolon, or the allowed range; the whole sentence where it has neither.
std::string remedy_in_message(const std::string &message);
}  // namespace mill
