#pragma once
#include "app/command/command_line.h"
#include "app/run/run_context.h"
#include <string>

namespace mill {
/// Name of that folder in the folder of a run or a study.
constexpr const char *usual_cache = "cache";

/// Folder in which parts outlive a run, so that another load or crown of the same rolls finds them.
/// @param fallback  where neither the command nor the environment names one
std::string cache_folder(const CommandLine &command, const std::string &fallback);

/// Makes the cache folder; where it cannot be created, the run says so and keeps nothing.
/// @param instead  folder of this run alone
void open_cache(RunContext &run, const std::string &instead);

/// As many threads as were asked for, fit into the address space and start; the BLAS works with one in each.
/// @return  the number that was wanted
int set_up_threads(RunContext &run, const CommandLine &command);

std::string local_time();  ///< "2026-01-31 12:00:00"
}  // namespace mill
