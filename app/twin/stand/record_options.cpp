#include "app/twin/stand/record_options.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/base/valid_text.h"
#include "twin/records/channel_names.h"
#include "twin/records/channel_scale.h"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <vector>

namespace fs = std::filesystem;

namespace mill {
namespace {
// "AI_07=upper_work_roll"
std::map<std::string, std::string> pairs_of(const std::string &option, const std::vector<std::string> &texts,
                                            const char *sample)
{
  std::map<std::string, std::string> pairs;
  for (const std::string &text : texts) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw InputError(fmt::format("{} \"{}\": a name and what it stands for are needed, for example {} {}",
                                   option, text, option, sample));
    pairs[valid_text(text.substr(0, equals))] = valid_text(text.substr(equals + 1));
  }
  return pairs;
}
// "50 mV/g" for all voltages, "AI_07=50 mV/g" for one column.
void read_scales(const CommandLine &command, twin::ReadOptions &options)
{
  for (const std::string &text : command.scales) {
    const auto equals        = text.find('=');
    const std::string column = equals == std::string::npos ? "" : valid_text(text.substr(0, equals));
    const std::string scale  = valid_text(equals == std::string::npos ? text : text.substr(equals + 1));
    twin::unit_by_scale(scale, column);  // refused here, before a record is read
    options.scales[column] = scale;
    if (!column.empty())
      options.asked.push_back(column);
  }
}

// The command line as it can be copied, without the end of it.
std::string typed_command(const CommandLine &command)
{
  std::string text = "millstand";
  for (char **word = command.arguments ? command.arguments + 1 : nullptr; word && *word; ++word)
    text += " " + twin::shell_word(valid_text(*word));
  return text;
}
}  // namespace

double option_quantity(const std::string &option, const std::string &text, const std::string &sample)
{
  const ParsedQuantity parsed = parse_quantity(text);
  const Unit &wanted          = unit(sample.substr(sample.find(' ') + 1));
  if (parsed.fault != ParsedQuantity::Fault::none || !(parsed.unit->dimension == wanted.dimension) ||
      !(parsed.value() > 0))
    throw InputError(fmt::format("{} \"{}\": {} above zero is needed, for example {} \"{}\"", option, text,
                                 wanted.quantity, option, sample));
  return parsed.value();
}

std::optional<double> own_limit(const CommandLine &command, const Monitoring &monitoring)
{
  if (!command.limit.empty())
    return option_quantity("--limit", command.limit, "2 g");
  return std::isnan(monitoring.limit) ? std::nullopt : std::optional(monitoring.limit);
}

twin::ReadOptions read_options(const CommandLine &command, const Monitoring &monitoring)
{
  twin::ReadOptions options;
  if (!command.record_rate.empty()) {
    double rate = 0;
    if (!parse_number(command.record_rate, rate))
      rate = option_quantity("--rate", command.record_rate, "20000 Hz");
    options.rate = rate;
  }
  options.zone     = command.zone;
  options.channels = monitoring.channels();
  for (const auto &[column, place] : pairs_of("--channel", command.channels, "AI_07=upper_work_roll")) {
    options.channels[column] = place;
    options.asked.push_back(column);
  }
  options.units = pairs_of("--unit", command.channel_units, "AI_07=g");
  for (const auto &[column, unit] : options.units)
    options.asked.push_back(column);
  read_scales(command, options);
  options.several = command.verb != Verb::analyse || command.names.size() > 1;
  options.command = typed_command(command);
  return options;
}
}  // namespace mill
