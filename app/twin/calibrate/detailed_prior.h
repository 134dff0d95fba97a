#pragma once
#include "app/command/command_line.h"
#include "app/twin/calibrate/calibrated_case.h"
#include <map>
#include <string>

namespace mill {
/// Does the case drive rolls as beams or component modes, computed or from files?
bool is_detailed(const Case &the_case);

/// Its connections before the records: a four-high by its stages at the load, files as they are.
/// @param load  N, of the records; NaN: that of the first pass
/// @throws InputError  files that do not say their connections; as the stages
PriorChain detailed_prior(const CommandLine &command, const Case &the_case, double load);

/// calibrated.toml and the files of the model that it names, by their paths in the folder: connections by what is
/// identified, bodies as they were.
std::map<std::string, std::string> calibrated_model(const PriorChain &stand, const Case &origin,
                                                    const twin::Calibration &result,
                                                    const std::vector<std::string> &files, bool accepted,
                                                    const std::string &directory);
}  // namespace mill
