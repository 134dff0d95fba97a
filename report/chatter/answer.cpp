#include "core/records/published_quantity.h"
#include "report/chatter/figures.h"
#include "report/plot/number.h"
#include <algorithm>
#include <cctype>
#include <cmath>

namespace mill::report {
namespace {
std::string lead(const ChatterCondition &c)
{
  if (std::string sentence = c.critical.sentence; !sentence.empty()) {
    sentence[0] = char(std::toupper(static_cast<unsigned char>(sentence[0])));
    return sentence + (sentence.back() == '.' ? "" : ".");
  }
  std::string text = "Condition " + c.name + ": " + verdict_in_words(c.critical.verdict, c.critical.speed);
  if (std::isfinite(c.critical.frequency))
    text += " with " + fixed(c.critical.frequency, 1) + " Hz";
  return c.critical.verdict.empty() ? "" : text + ".";
}

std::string distance(const ChatterCondition &c)
{
  const double away = c.critical.speed - c.speed;
  if (std::isfinite(away)) {
    // Two decimals say nothing about a stand that works at its limit.
    const std::string size = std::abs(away) < 0.05 ? fixed(std::abs(away), 3) : fixed(std::abs(away), 2);
    return "The working speed of " + fixed(c.speed, 2) + " m/s is " + size + " m/s (" +
           percent(std::abs(away) / c.critical.speed).substr(away == 0 ? 0 : 1) + ") " +
           (away >= 0 ? "below" : "above") + " the critical one";
  }
  if (std::isfinite(c.critical.margin) && std::isfinite(c.critical.margin_speed))
    return std::string(c.critical.margin < 0 ? "The least damped state" : "The least unstable state") +
           " of the range is that at " + fixed(c.critical.margin_speed, 1) + " m/s, with a growth rate of " +
           significant(c.critical.margin, 3) + " 1/s";
  return std::isfinite(c.speed) ? "The working speed is " + fixed(c.speed, 2) + " m/s" : "";
}

// "a disturbance halves in 27 s, 3500 periods".
std::string pace(const ChatterCondition &c)
{
  // Without a critical speed the sentence before speaks of the speed of the margin.
  const double growth = std::isfinite(c.critical.speed) ? c.critical.growth_at_working : c.critical.margin;
  if (!std::isfinite(growth))
    return "";
  if (growth == 0)
    return "a disturbance there keeps its size";
  const double time = std::log(2.0) / std::abs(growth);
  std::string text  = std::string("a disturbance there ") + (growth < 0 ? "halves" : "doubles") + " in " +
                     significant(time, 2) + " s";
  if (std::isfinite(c.critical.frequency))
    text += ", " + significant(time * c.critical.frequency, 2) + " periods of the chatter";
  return text;
}

std::string change(const double relative)
{
  return std::isfinite(relative) ? percent(relative) : "no crossing";
}

double weight(const ChatterSensitivity &s)
{
  const auto size = [](const double v) { return std::isfinite(v) ? std::abs(v) : 0; };
  return std::max(size(s.lowered.critical_speed), size(s.raised.critical_speed));
}

std::string what_moves_it(const ChatterCondition &c)
{
  std::vector<ChatterSensitivity> all = c.sensitivities;
  std::stable_sort(all.begin(), all.end(), [](const auto &a, const auto &b) { return weight(a) > weight(b); });
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, all.size()); ++i)
    if (weight(all[i]) > 5e-4)
      text += (text.empty() ? "" : "; ") + (all[i].name.empty() ? all[i].key : all[i].name) + " (" +
              change(all[i].lowered.critical_speed) + " when 10\u00a0% lower, " +
              change(all[i].raised.critical_speed) + " when 10\u00a0% higher)";
  return text.empty() ? "" : "Inputs with the largest effect on the limit: " + text + ".";
}

// "18.20 .. 18.21 m/s", with what found no crossing.
std::string spread(const std::vector<ChatterVariantInfo> &all)
{
  double low = not_given, high = not_given;
  std::string without;
  for (const ChatterVariantInfo &one : all)
    if (std::isfinite(one.critical_speed)) {
      low  = std::isfinite(low) ? std::min(low, one.critical_speed) : one.critical_speed;
      high = std::isfinite(high) ? std::max(high, one.critical_speed) : one.critical_speed;
    } else
      without += (without.empty() ? "" : ", ") + one.name + " " + verdict_in_words(one.verdict, not_given);
  std::string text;
  if (std::isfinite(low))
    text = fixed(low, 2) + (fixed(high, 2) != fixed(low, 2) ? " \u2026 " + fixed(high, 2) : "") + " m/s";
  return text + (without.empty() ? "" : (text.empty() ? "" : "; ") + without);
}

std::string how_sure(const ChatterCondition &c)
{
  std::string text;
  const auto add = [&](const std::string &what, const std::vector<ChatterVariantInfo> &all) {
    if (all.size() > 1)
      text += (text.empty() ? "" : ". ") + what + ": " + spread(all);
  };
  add("How certain this is: critical speed by the " + std::to_string(c.schemes.size()) + " linearisations",
      c.schemes);
  add(text.empty() ? "How certain this is: critical speed by other variants of the stand"
                   : "By the " + std::to_string(c.variants.size()) + " variants of the stand",
      c.variants);
  add("By the models of the stand", c.structures);
  for (const ChatterPublished &entry : c.published)
    if (entry.quantity == word_of(PublishedQuantity::critical_speed) && std::isfinite(entry.measured))
      text += (text.empty() ? "" : ". ") + std::string("Measured: ") + fixed(entry.measured, 2) + " m/s";
  return text.empty() ? "" : text + ".";
}
}  // namespace

std::vector<std::string> chatter_answer(const ChatterCondition &condition)
{
  std::vector<std::string> sentences;
  const std::string away = distance(condition), speed = pace(condition);
  for (const std::string &sentence :
       {lead(condition), away.empty() ? "" : away + (speed.empty() ? "" : "; " + speed) + ".",
        what_moves_it(condition), how_sure(condition)})
    if (!sentence.empty())
      sentences.push_back(sentence);
  return sentences;
}
}  // namespace mill::report
