#pragma once
#include <string>

// Which file the results of a folder were made of: its name alone may be that of many.
namespace mill {
/// Key of run.json and analysis.json: the absolute path of the case or the record.
constexpr const char *source_location = "source_location";

/// What source_location holds for a file: its path without links.
std::string location_of(const std::string &path);

/// The other file that a folder was made of.  Empty: it was `source`, or one that has been moved since, or it is
/// not stated.
/// @param proof  run.json or analysis.json of the folder
std::string other_source(const std::string &proof, const std::string &source);
}  // namespace mill
