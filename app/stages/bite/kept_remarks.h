#pragma once
#include "core/base/warning.h"
#include <string>
#include <vector>

namespace mill {
/// Warnings of a bite in a kept result, as the text of a JSON record.
std::string text_of_remarks(const std::vector<Warning> &remarks);
/// @throws InputError  not such a text
std::vector<Warning> remarks_of_text(const std::string &text);
}  // namespace mill
