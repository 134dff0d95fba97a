#pragma once
#include <string>

namespace mill::fmu {
/// Folder from what an FMI 2 client passes: a URI "file:///path", "file:/path" or "file://localhost/path" with %20
/// and the like, or, beyond the standard, a plain path.  Ends with one slash.
/// @throws std::runtime_error  another scheme, or a % without two hex digits
std::string folder_of_uri(const std::string &uri);

/// Folder from what an FMI 3 client passes: a path, ends with one slash.
std::string folder_of_path(const std::string &path);

/// Whole file.  @throws std::runtime_error  it cannot be read; the text names the path
std::string read_file(const std::string &path);
}  // namespace mill::fmu
