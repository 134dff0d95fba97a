#pragma once
#include <map>
#include <string>
#include <vector>

namespace mill {
/// Completion of verbs, options, kinds and case files, to be sourced by a shell.
/// @param shell    "bash" or "zsh"
/// @param options  of each verb, "--output"
/// @throws InputError  another shell
std::string completion_script(const std::string &shell,
                              const std::map<std::string, std::vector<std::string>> &options);
}  // namespace mill
