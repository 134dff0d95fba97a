#pragma once
#include "app/command/command_line.h"
#include "core/model/monitoring.h"
#include "twin/records/raw_record.h"
#include <optional>
#include <string>

// What the verbs that read records share.
namespace mill {
/// A quantity above zero of the command line, SI.
/// @param sample  "4 m/s": says the unit, and stands in the message
/// @throws InputError
double option_quantity(const std::string &option, const std::string &text, const std::string &sample);

/// m/s2, 0-peak, the mill's own limit of a vibration: --limit, or else monitoring.limit; nothing without either.
/// @throws InputError  the option is no acceleration
std::optional<double> own_limit(const CommandLine &command, const Monitoring &monitoring);

/// --rate, --zone, --channel and --unit; names of channels that the case has, where the command line has no other.
twin::ReadOptions read_options(const CommandLine &command, const Monitoring &monitoring);
}  // namespace mill
