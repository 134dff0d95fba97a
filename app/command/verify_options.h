#pragma once
#include <string>
#include <vector>

namespace mill {
/// What `millstand verify` was asked for.
struct VerifyOptions {
  std::vector<std::string> names;  ///< cases to run; empty: all
  bool list  = false;              ///< only name, kind and problem of each
  bool quiet = false;              ///< no progress, no tables of cases that pass
  std::string markdown;            ///< file for the page of the manual; empty: none
  int threads = 0;                 ///< 0: all processors
};

/// Runs cases of the verification manual and prints them.  Returns 0 when all pass, 3 when one does not, 4 when
/// none fails but some were skipped because a program they compare with is not installed (the summary says which).
/// @throws InputError  an unknown name, with the nearest known one; --markdown with only some of the cases; a file
/// that
///                     cannot be written
int verify_command(const VerifyOptions &options);
}  // namespace mill
