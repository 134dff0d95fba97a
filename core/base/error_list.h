#pragma once
#include "core/base/errors.h"
#include <string>
#include <vector>

namespace mill {
/// Problems shown of one list. Who mends fifty knows what was wrong with the rest.
constexpr std::size_t most_problems_shown = 50;

/// The problems as `render` shows each, one below the other, and how many more there are. Ends with a line break.
/// Cost: each file is read once, whatever the number of problems.
std::string render_list(const std::vector<Problem> &problems);

/// From now on problems in a file show the lines of this text: it was read in the place of the file's.  Any thread
/// may call it.
void show_lines_of(const std::string &path, const std::string &text);

/// First characters of a text with " ..." behind them, never half of a UTF-8 character; as it is when it is short.
std::string shortened(const std::string &text);
}  // namespace mill
