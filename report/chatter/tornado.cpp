#include "report/chatter/figures.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/ticks.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
// One input as the chart shows it.
struct Bar {
  std::string name;
  double slope, minus, plus;  // -, relative changes
  bool curved;
};

constexpr double width = 1040, names = 250, bars = 268, bars_end = 800, slopes = 876, notes = 892, bar_row = 25,
                 head           = 56;
constexpr std::size_t most_bars = 16;

double size_of(const double value)
{
  return std::isfinite(value) ? std::abs(value) : 0;
}

double weight(const Bar &bar)
{
  const double change = std::max(size_of(bar.minus), size_of(bar.plus));
  return change > 0 ? change : 0.1 * size_of(bar.slope);
}

std::string note_of(const Bar &bar, const std::string &missing)
{
  if (!std::isfinite(bar.minus) && !std::isfinite(bar.plus))
    return missing + " at either";
  if (!std::isfinite(bar.minus) || !std::isfinite(bar.plus))
    return missing + (std::isfinite(bar.plus) ? " at \u221210 %" : " at +10 %");
  if (bar.minus * bar.plus > 0)
    return "curved: both one way";
  return bar.curved || std::abs(bar.minus + bar.plus) > 0.5 * weight(bar) ? "bent" : "";
}

void draw_head(Svg &svg, const std::string &title)
{
  svg.text(34, 15, title, "title");
  svg.rect(bars, 30, 24, 9, "bar pale");
  svg.text(bars + 30, 39, "input 10 % lower", "t");
  svg.rect(bars + 150, 30, 24, 9, "bar dark");
  svg.text(bars + 180, 39, "input 10 % higher", "t");
  svg.text(slopes, 39, "slope [%/%]", "axis", Anchor::end);
}

// Upper half of a bar_row: 10 % lower, lower half: 10 % higher.
std::string tornado(std::vector<Bar> all, const std::string &title, const std::string &quantity,
                    const std::string &missing)
{
  all.erase(std::remove_if(all.begin(), all.end(), [](const Bar &bar) { return !(weight(bar) > 5e-5); }),
            all.end());
  if (all.empty())
    return "";
  std::stable_sort(all.begin(), all.end(), [](const Bar &a, const Bar &b) { return weight(a) > weight(b); });
  all.resize(std::min(all.size(), most_bars));
  double low = 0, high = 0;
  for (const Bar &bar : all)
    for (const double change : {bar.minus, bar.plus})
      if (std::isfinite(change)) {
        low  = std::min(low, 100 * change);
        high = std::max(high, 100 * change);
      }
  if (!(low < high))
    high = low + 1;
  const double room = 0.03 * (high - low);
  const auto to_x   = [&, from = low - room, to = high + room](const double percent) {
    return bars + (percent - from) / (to - from) * (bars_end - bars);
  };
  const double bottom = head + bar_row * double(all.size());
  Svg svg(width, bottom + 46, title);
  draw_head(svg, title);
  const Ticks ticks = linear_ticks(low - room, high + room, 8);
  for (std::size_t i = 0; i < ticks.at.size(); ++i) {
    svg.line(to_x(ticks.at[i]), head, to_x(ticks.at[i]), bottom, "grid");
    svg.text(to_x(ticks.at[i]), bottom + 16, ticks.labels[i], "t tx", Anchor::middle);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double y  = head + bar_row * double(i);
    const auto draw = [&](const double change, const double offset, const char *pen) {
      if (std::isfinite(change))
        svg.rect(std::min(to_x(0), to_x(100 * change)), y + offset, std::abs(to_x(100 * change) - to_x(0)), 9,
                 std::string("bar ") + pen);
    };
    draw(all[i].minus, 3, "pale");
    draw(all[i].plus, 12, "dark");
    svg.text(names, y + 16, shortened(all[i].name, names - 10, 12), "t", Anchor::end);
    svg.text(slopes, y + 16, (all[i].slope > 0 ? "+" : "") + significant(all[i].slope, 3), "t", Anchor::end);
    svg.text(notes, y + 16, note_of(all[i], missing), "small");
  }
  svg.line(to_x(0), head, to_x(0), bottom, "frame");
  svg.rect(bars, head, bars_end - bars, bottom - head, "frame");
  svg.text((bars + bars_end) / 2, bottom + 36, "change of the " + quantity + " [%]", "axis", Anchor::middle);
  return svg.str();
}
}  // namespace

std::string tornado_of_speed(const ChatterCondition &condition)
{
  std::vector<Bar> all;
  for (const ChatterSensitivity &s : condition.sensitivities)
    all.push_back({s.name.empty() ? s.key : s.name, s.critical_speed, s.lowered.critical_speed,
                   s.raised.critical_speed, !s.monotone});
  return tornado(all, "Critical speed", "critical speed", "no crossing");
}

std::string tornado_of_friction(const ChatterCondition &condition)
{
  std::vector<Bar> all;
  for (const ChatterSensitivity &s : condition.sensitivities)
    if (size_of(s.friction) > 1e-6 || size_of(s.lowered.friction) > 1e-6 || size_of(s.raised.friction) > 1e-6)
      all.push_back({s.name.empty() ? s.key : s.name, s.friction, s.lowered.friction, s.raised.friction, false});
  return tornado(all, "Friction at the working speed", "friction", "no bite");
}
}  // namespace mill::report
