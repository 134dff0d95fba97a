#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mill {
struct Case;

/// Scalars that an earlier run of a case left behind.
struct StoredRun {
  std::string folder;
  bool same_inputs = true;                                 ///< it was made from this very case
  std::map<std::string, double> values;                    ///< SI, by name
  std::map<std::string, double> errors;                    ///< relative, of those that state one
  std::map<std::string, std::vector<std::string>> inputs;  ///< keys of the case behind each
};

/// The folder that was named, else that of a run: out/<case name>.
std::string folder_of_run(const std::string &named, const Case &the_case);

/// Nothing where the folder holds no results.
/// @throws InputError  files of two runs, or of one that is being published
std::optional<StoredRun> stored_run(const std::string &folder, const Case &the_case);
}  // namespace mill
