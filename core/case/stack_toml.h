#pragma once
#include <string>

namespace mill {
struct StackInput;

/// The text of a case of kind "stack", which reads to the same input.
/// @param directory  that the paths of the passes are made relative to
std::string stack_toml(const std::string &title, const StackInput &input, const std::string &directory);
}  // namespace mill
