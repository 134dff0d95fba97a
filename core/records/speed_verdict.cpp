#include "core/records/speed_verdict.h"
#include "core/base/short_number.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill {
namespace {
// Half of the wider side of the interval over the value; an end beyond the range is taken to be at the range.
double relative_error(const SpeedVerdict &v)
{
  const double low = std::isnan(v.low) ? v.range[0] : v.low, high = std::isnan(v.high) ? v.range[1] : v.high;
  return std::max(v.critical - low, high - v.critical) / v.critical;
}

// Digits of the ends of an interval: those that half its width allows.
std::string end_text(const double end, const double width)
{
  return number_within(end, 0.5 * width / end, 3);
}

std::string critical_text(const SpeedVerdict &v)
{
  const std::string interval = interval_text(v);
  return speed_digits(v) + " m/s" + (interval.empty() ? "" : " (" + interval + ")");
}

// "16.0 m/s"; a record without its speed says so in words.
std::string speed_text(const double speed)
{
  return std::isnan(speed) ? "the working speed" : number_within(speed, 0.005, 3) + " m/s";
}

// "15 % " before "below" or "above".
std::string apart_text(const SpeedVerdict &v)
{
  return std::isnan(v.speed) ? "" : margin_text(v) + " ";
}

std::string range_text(const SpeedVerdict &v)
{
  if (!(v.range[1] > 0))
    return "of the range that was searched";
  return fmt::format("from {} to {} m/s", short_number(v.range[0], 3), short_number(v.range[1], 3));
}

std::string keys_text(const std::vector<std::string> &keys)
{
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i)
    text += (i == 0 ? "" : i + 1 == keys.size() ? " and " : ", ") + keys[i];
  return text;
}

std::string why_not_searched(const SpeedVerdict &v)
{
  if (v.missing.empty())
    return v.cause;
  return fmt::format("{} {} not given", keys_text(v.missing), v.missing.size() == 1 ? "is" : "are");
}

std::string gap_text(const SpeedVerdict &v)
{
  return fmt::format("the critical speed lies between {:.3f} and {:.3f} m/s, where the search has no answer",
                     v.gap[0], v.gap[1]);
}

std::string unstable_sentence(const SpeedVerdict &v)
{
  if (!std::isnan(v.gap[0]))
    return fmt::format("Unstable: the {} grows at {}; {}.", v.mode, speed_text(v.speed), gap_text(v));
  if (v.speed < v.critical || std::isnan(v.critical))
    return fmt::format("Unstable: the {} grows at {}; no speed {} is critical.", v.mode, speed_text(v.speed),
                       range_text(v));
  return fmt::format("Unstable: {} is {}above the critical speed of {}; the {} becomes unstable first.",
                     speed_text(v.speed), apart_text(v), critical_text(v), v.mode);
}
}  // namespace

double SpeedVerdict::margin() const
{
  return 1 - speed / critical;
}

bool SpeedVerdict::is_doubtful() const
{
  return finding == SpeedFinding::below && !std::isnan(speed) && !(low > speed);
}

std::string speed_digits(const SpeedVerdict &v)
{
  return number_within(v.critical, 0.1 * relative_error(v), 4);
}

std::string interval_text(const SpeedVerdict &v)
{
  const double low = std::isnan(v.low) ? v.range[0] : v.low, high = std::isnan(v.high) ? v.range[1] : v.high;
  const double width = high - low;
  if (!(width > 0))
    return "";
  return fmt::format("{}{} to {}{}", std::isnan(v.low) ? "below " : "", end_text(low, width),
                     std::isnan(v.high) ? "above " : "", end_text(high, width));
}

std::string margin_text(const SpeedVerdict &v)
{
  const double percent = std::abs(100 * v.margin());
  return fmt::format("{} %", percent < 0.95 ? short_number(percent, 1) : short_number(percent, 2));
}

void worst_first(std::vector<SpeedVerdict> &verdicts)
{
  const auto rank = [](const SpeedVerdict &v) {
    return v.finding == SpeedFinding::unstable ? 0
           : v.finding == SpeedFinding::below  ? 1
           : v.finding == SpeedFinding::stable ? 2
                                               : 3;
  };
  std::stable_sort(verdicts.begin(), verdicts.end(), [&](const SpeedVerdict &a, const SpeedVerdict &b) {
    return rank(a) != rank(b) ? rank(a) < rank(b) : a.margin() < b.margin();
  });
}

SpeedVerdict not_searched(const std::string &pass, const double speed, const std::vector<std::string> &missing)
{
  SpeedVerdict v;
  v.pass    = pass;
  v.speed   = speed;
  v.missing = missing;
  v.remedy  = std::string("Add ") + (missing.size() == 1 ? "it" : "them") +
             " to the case to have the critical speed searched.";
  return v;
}

Warning warning_of(const SpeedVerdict &v, const Place &place)
{
  return {WarningId::critical_speed_not_searched,
          v.pass,
          "critical speed not searched",
          why_not_searched(v),
          std::string("add ") + (v.missing.size() == 1 ? "it" : "them") + " to the case",
          {v.pass},
          "",
          place};
}

const char *id_of(const SpeedFinding finding)
{
  switch (finding) {
  case SpeedFinding::below:
    return "below";
  case SpeedFinding::unstable:
    return "unstable";
  case SpeedFinding::stable:
    return "stable";
  case SpeedFinding::not_searched:
    break;
  }
  return "not-searched";
}

std::string sentence_of(const SpeedVerdict &v)
{
  switch (v.finding) {
  case SpeedFinding::below:
    return fmt::format("At {}, {}below the critical speed of {}; the {} becomes unstable first.",
                       speed_text(v.speed), apart_text(v), critical_text(v), v.mode);
  case SpeedFinding::unstable:
    return unstable_sentence(v);
  case SpeedFinding::stable:
    if (!std::isnan(v.critical))
      return fmt::format("At {}, stable again above the critical speed of {}; the {} becomes unstable there.",
                         speed_text(v.speed), critical_text(v), v.mode);
    if (!std::isnan(v.gap[0]))
      return fmt::format("At {}, stable; {}; the {} has the least damping.", speed_text(v.speed), gap_text(v),
                         v.mode);
    return fmt::format("At {}, without a critical speed {}; the {} has the least damping.", speed_text(v.speed),
                       range_text(v), v.mode);
  case SpeedFinding::not_searched:
    break;
  }
  return "Critical speed not searched: " + why_not_searched(v) + ".";
}

nlohmann::ordered_json json_of(const SpeedVerdict &v)
{
  nlohmann::ordered_json json;
  json["id"]       = id_of(v.finding);
  json["pass"]     = v.pass;
  json["sentence"] = sentence_of(v);
  const auto add   = [&](const char *name, const double value) {
    if (!std::isnan(value))
      json[name] = value;
  };
  add("speed", v.speed);
  add("critical_speed", v.critical);
  add("critical_speed_low", v.low);
  add("critical_speed_high", v.high);
  add("margin", v.margin());
  add("frequency", v.frequency);
  add("gap_mode_damping", v.damping);
  add("growth_rate", v.growth);
  add("critical_speed_low_by_inputs", v.by_inputs[0]);
  add("critical_speed_high_by_inputs", v.by_inputs[1]);
  for (const SpeedInput &input : v.inputs)
    json["inputs"].push_back({{"name", input.name}, {"error", input.error}, {"slope", input.slope}});
  if (!std::isnan(v.gap[0]))
    json["critical_speed_between"] = v.gap;
  if (v.range[1] > 0)
    json["range"] = v.range;
  if (!v.mode.empty())
    json["mode"] = v.mode;
  if (!v.missing.empty())
    json["missing"] = v.missing;
  if (!v.cause.empty())
    json["cause"] = v.cause;
  if (!v.remedy.empty())
    json["remedy"] = v.remedy;
  return json;
}

SpeedVerdict speed_verdict_of(const nlohmann::json &json)
{
  SpeedVerdict v;
  const std::string id = json.value("id", "");
  for (const SpeedFinding finding : {SpeedFinding::below, SpeedFinding::unstable, SpeedFinding::stable})
    if (id == id_of(finding))
      v.finding = finding;
  v.pass      = json.value("pass", "");
  v.mode      = json.value("mode", "");
  v.cause     = json.value("cause", "");
  v.remedy    = json.value("remedy", "");
  v.missing   = json.value("missing", std::vector<std::string>());
  v.range     = json.value("range", v.range);
  v.gap       = json.value("critical_speed_between", v.gap);
  v.speed     = json.value("speed", v.speed);
  v.critical  = json.value("critical_speed", v.critical);
  v.low       = json.value("critical_speed_low", v.low);
  v.high      = json.value("critical_speed_high", v.high);
  v.frequency = json.value("frequency", v.frequency);
  v.damping   = json.value("gap_mode_damping", v.damping);
  v.growth    = json.value("growth_rate", v.growth);
  return v;
}
}  // namespace mill
