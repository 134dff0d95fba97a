#pragma once
#include <string>

/// What a run of the built program left behind.
struct Outcome {
  int exit_code;
  std::string out;  ///< standard output
  std::string err;  ///< standard error
};

/// Runs `millstand <arguments>` in the given folder.
/// @param before  command of the shell that goes before it, "ulimit -v 600000"
Outcome millstand(const std::string &arguments, const std::string &folder = MILLSTAND_SOURCE_DIR,
                  const std::string &before = "true");

/// Runs a command of the shell in the given folder.
Outcome shell(const std::string &command, const std::string &folder);

/// A folder of this test alone, removed at the end of the program.
std::string scratch(const std::string &name);

/// The cache that all tests of one run of CTest share, empty when it begins; without CTest a folder of this
/// program. For tests in which what is kept only saves time.
std::string shared_cache();
