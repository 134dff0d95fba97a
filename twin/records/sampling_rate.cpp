#include "twin/records/sampling_rate.h"
#include "twin/records/channel_names.h"
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double least_rate = 1e-3, largest_rate = 1e8;  // Hz
constexpr double same_rate = 1e-3;                       // relative

std::string letters_of(const std::string &name)
{
  const std::string last = name.substr(name.find_last_of('.') + 1);  // of "run.fs"
  std::string letters;
  for (const char c : lower(last))
    if (c >= 'a' && c <= 'z')
      letters += c;
  return letters;
}
}  // namespace

RateName rate_name(const std::string &name)
{
  const std::string word = letters_of(name);
  for (const char *known :
       {"fs", "sr", "samplerate", "samplingrate", "samplefrequency", "samplingfrequency", "samplefreq",
        "samplingfreq", "fsample", "fsamp", "abtastrate", "samplespersecond", "fshz"})
    if (word == known)
      return RateName::frequency;
  for (const char *known :
       {"dt", "ts", "deltat", "timestep", "tsample", "sampletime", "samplingtime", "sampleperiod",
        "samplinginterval", "sampleinterval", "samplingperiod", "abtastzeit", "tinterval"})
    if (word == known)
      return RateName::step;
  for (const char *known : {"rate", "frequency", "freq"})
    if (word == known)
      return RateName::unclear;
  return RateName::none;
}

double sampling_rate(const std::string &file, const std::vector<RateCandidate> &candidates,
                     const std::string &time_name, const double time_rate, const ReadOptions &options,
                     std::vector<std::string> &notes)
{
  struct Source {
    std::string text;
    double rate;
  };
  std::vector<Source> sources;
  std::string unclear;
  for (const RateCandidate &one : candidates) {
    const RateName kind = rate_name(one.name);
    const auto text     = fmt::format("'{}' = {:.9g}", one.name, one.number);
    if (kind == RateName::unclear)
      unclear += (unclear.empty() ? "" : ", ") + text;
    else if (kind != RateName::none && one.number > 0)
      sources.push_back({text, kind == RateName::step ? 1 / one.number : one.number});
  }
  if (std::isfinite(time_rate))
    sources.push_back({fmt::format("the step of '{}'", time_name), time_rate});
  if (options.rate) {
    for (const Source &source : sources)
      if (std::abs(source.rate - *options.rate) > same_rate * *options.rate)
        notes.push_back(fmt::format("--rate {:.9g} was taken, although {} says {:.9g} samples per second",
                                    *options.rate, source.text, source.rate));
    return *options.rate;
  }
  for (const Source &other : sources)
    if (std::abs(other.rate - sources.front().rate) > same_rate * sources.front().rate)
      throw InputError(
          fmt::format("{}: the sampling rate is {:.9g} Hz by {} and {:.9g} Hz by {}, which disagree{}", file,
                      sources.front().rate, sources.front().text, other.rate, other.text,
                      by_option(options, file, "; say which one is right",
                                fmt::format("--rate {:.9g}", sources.front().rate))));
  if (sources.empty())
    return std::numeric_limits<double>::quiet_NaN();
  if (!unclear.empty())
    notes.push_back(fmt::format("{} was not taken as the sampling rate, which is {:.9g} Hz by {}", unclear,
                                sources.front().rate, sources.front().text));
  return sources.front().rate;
}

void require_possible_rate(const double rate, const std::string &source)
{
  if (!(rate >= least_rate && rate <= largest_rate))
    throw InputError(fmt::format("{}: {:.6g} samples per second are not possible; {:g} to {:g} are read", source,
                                 rate, least_rate, largest_rate));
}
}  // namespace mill::twin
