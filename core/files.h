#pragma once
#include <string>

namespace mill {
/// Writes beside the target and renames, so that an interrupted run leaves the old file or the new one, never
/// half.
/// @throws InputError when the folder cannot be written, with the path and the system's reason
void write_atomically(const std::string &path, const std::string &text);

/// Whole file as text.  @throws InputError
std::string read_text(const std::string &path);

/// 64-bit FNV-1a as 16 hex digits: names caches and notices changes, not for security.
std::string hash_of(const std::string &bytes);

/// "pass 1" -> "pass-1": letters, digits and dashes, for file names.
std::string slug(const std::string &name);
}  // namespace mill
