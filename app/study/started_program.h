#pragma once
#include <string>
#include <sys/types.h>
#include <vector>

namespace mill {
/// A program in the folder of this one.
std::string program_path(const std::string &name);

/// Starts a program without a shell; its output is that of this one.  When the calling thread ends before it, even
/// by a kill, it gets SIGTERM, so that no worker goes on for a study whose command has ended.
/// @throws InputError  it cannot be started
pid_t start_program(const std::string &file, const std::vector<std::string> &arguments, const std::string &what);

/// Waits for it: its exit code, or 128 and the number of the signal that ended it.
int wait_for(pid_t process);

/// Both.
int run_program(const std::string &file, const std::vector<std::string> &arguments, const std::string &what);
}  // namespace mill
