#pragma once
#include "app/command/described_verbs.h"

namespace mill {
/// Completion of verbs, options, kinds and case files.  To be sourced by the shell, or to be a file in the folder
/// where the shell looks for completions: "millstand" of bash, "_millstand" of zsh, "millstand.fish".
/// @param shell  "bash", "fish" or "zsh"
/// @throws InputError  another shell
std::string completion_script(const std::string &shell, const std::vector<DescribedVerb> &verbs);
}  // namespace mill
