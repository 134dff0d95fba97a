#include "app/twin/live/live_metrics.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
enum class Metric { counter, gauge };
constexpr auto words_of(Metric)
{
  return choice_words<Metric>("counter", "gauge");
}

// A family of one kind; rows of it follow each other, as the format wants it.
class Family {
public:
  Family(std::string &text, std::string name, const Metric kind)
      : text_(text), name_(std::move(name)), counter_(kind == Metric::counter)
  {
    text_ += fmt::format("# TYPE millstand_{} {}\n", name_, word_of(kind));
  }
  template <class Value> void row(const std::string &labels, const Value &value)
  {
    text_ += fmt::format("millstand_{}{}{} {}\n", name_, counter_ ? "_total" : "",
                         labels.empty() ? "" : "{" + labels + "}", value);
  }

private:
  std::string &text_;
  std::string name_;
  bool counter_;
};

std::string label(const std::string &name, const std::string &value)
{
  std::string clean;  // escaped as the format has it, so that two names stay two
  for (const char letter : value)
    if (letter == '\n')
      clean += "\\n";
    else {
      if (letter == '"' || letter == '\\')
        clean += '\\';
      clean += (unsigned char)letter < ' ' ? '_' : letter;
    }
  return fmt::format("{}=\"{}\"", name, clean);
}

void add_account(std::string &text, const MetricsInput &input)
{
  const auto family = [&](const char *name, std::int64_t live::ChannelAccount::*member) {
    Family rows(text, name, Metric::counter);
    for (std::size_t c = 0; c < input.source->channels.size(); ++c)
      rows.row(label("channel", input.source->channels[c].name), input.book->channels()[c].*member);
  };
  if (input.source && input.book) {
    family("samples_offered", &live::ChannelAccount::offered);
    family("samples_processed", &live::ChannelAccount::processed);
    family("samples_missing", &live::ChannelAccount::missing);
    family("samples_rejected", &live::ChannelAccount::rejected);
    family("samples_overrun", &live::ChannelAccount::overrun);
  }
  Family(text, "samples_doubled", Metric::counter).row("", input.book ? input.book->doubled() : 0);
  Family(text, "gaps", Metric::counter).row("", input.book ? input.book->gaps() : 0);
  Family(text, "lines_refused", Metric::counter).row("", input.refused_lines);
  Family(text, "queue_samples", Metric::gauge).row("", input.queued);
  Family(text, "states_written", Metric::counter).row("", input.states);
  if (std::isfinite(input.arrival_rate))
    Family(text, "arrival_rate_hertz", Metric::gauge).row("", fmt::format("{:.6g}", input.arrival_rate));
}

void add_alarms(std::string &text, std::vector<live::PageAlarm> open)
{
  Family rows(text, "alarms_open", Metric::gauge);
  for (const std::string level : {"alarm", "warning"})
    for (const std::string kind : {"chatter", "drift", "gap", "recording", "source"})
      rows.row(label("level", level) + "," + label("kind", kind),
               std::count_if(open.begin(), open.end(), [&](const live::PageAlarm &alarm) {
                 return alarm.level == level && alarm.kind == kind;
               }));
}

void add_comparison(std::string &text, const live::Comparison &comparison)
{
  const auto tracked = comparison.drift();
  const auto number  = [](const double value) { return fmt::format("{:.6g}", value); };
  const auto &rule   = twin::CusumRule{};
  {
    Family rows(text, "mode_drift_share", Metric::gauge);  // of the sum at which it is an alarm
    for (std::size_t m = 0; m < tracked.modes.size(); ++m) {
      const auto &sums = tracked.modes[m].watch.sums;
      rows.row(label("mode", std::to_string(m + 1)), number(std::max(sums.up, sums.down) / rule.threshold));
    }
  }
  const auto bands  = comparison.bands();
  const auto family = [&](const char *name, double live::ChatterBand::*member) {
    Family rows(text, name, Metric::gauge);
    for (const live::ChatterBand &band : bands)
      if (std::isfinite(band.*member))
        rows.row(label("band", fmt::format("{} {:.1f} Hz", band.name, band.frequency)), number(band.*member));
  };
  family("band_amplitude_metres_per_second_squared", &live::ChatterBand::amplitude);
  family("band_baseline_metres_per_second_squared", &live::ChatterBand::baseline);
  family("band_growth_per_second", &live::ChatterBand::growth);
  family("band_growth_high_per_second", &live::ChatterBand::growth_high);
  const auto &proposals = comparison.proposals();
  Family rows(text, "proposals", Metric::gauge);
  for (const live::ProposalState state : every<live::ProposalState>())
    rows.row(label("state", word_of(state)),
             std::count_if(proposals.begin(), proposals.end(),
                           [&](const live::Proposal &p) { return p.state == state; }));
}
}  // namespace

std::string metrics_text(const MetricsInput &input)
{
  std::string text;
  add_account(text, input);
  auto open = input.own_alarms;
  if (input.comparison) {
    const auto more = input.comparison->open_alarms();
    open.insert(open.end(), more.begin(), more.end());
  }
  add_alarms(text, std::move(open));
  if (input.comparison)
    add_comparison(text, *input.comparison);
  if (input.limit)
    Family(text, "limit_metres_per_second_squared", Metric::gauge).row("", fmt::format("{:.6g}", *input.limit));
  Family(text, "springs_adopted", Metric::gauge)
      .row(input.adopted.empty() ? "" : label("file", input.adopted), input.adopted.empty() ? 0 : 1);
  return text;
}
}  // namespace mill
