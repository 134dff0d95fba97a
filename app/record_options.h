#pragma once
#include "app/command_line.h"
#include "twin/records/raw_record.h"
#include <string>

namespace mill {
/// A quantity of the command line above zero, SI.
/// @param sample  "4 m/s": its unit says what is needed
/// @throws InputError
double quantity_of_option(const std::string &option, const std::string &text, const std::string &sample);

/// What --rate, --zone, --channel and --unit say of records.  @throws InputError
twin::ReadOptions record_options(const CommandLine &command);
}  // namespace mill
