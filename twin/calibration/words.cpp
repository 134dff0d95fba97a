#include "twin/calibration/words.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill::twin {
namespace {
constexpr double half_told = 1.7320508075688772;  // singular value at which sd is half of the prior's

std::string words_of(const Told &told, const Eigen::Index column, const FittedStand &stand,
                     const bool unseen = true)
{
  std::vector<std::pair<double, std::string>> parts;
  for (Eigen::Index i = 0; i < told.direction.rows(); ++i)
    if (std::abs(told.direction(i, column)) > 0.15)
      parts.emplace_back(told.direction(i, column), told.names[std::size_t(i)]);
  std::sort(parts.begin(), parts.end(), [](const auto &a, const auto &b) { return a.second < b.second; });
  if (parts.empty())
    return "many unknowns together";
  const double sign = parts.front().first < 0 ? -1 : 1;
  std::string sum;
  for (const auto &[weight, name] : parts) {
    const double w = sign * weight;
    sum += sum.empty() ? "" : w < 0 ? " - " : " + ";
    sum += fmt::format("{:.2f} ln {}", std::abs(w), name);
  }
  if (!unseen)
    return sum;
  if (parts.size() == 1)
    return sum + ": " + parts[0].second + " is hardly seen";
  if (parts.size() == 2 && parts[0].first * parts[1].first < 0 &&
      share_a_part(stand, parts[0].second, parts[1].second))
    return sum + ": only their series is seen";
  return sum + ": only what else they do is seen, not this combination";
}
}  // namespace

std::vector<std::string> unseen_directions(const Told &told, const FittedStand &stand)
{
  std::vector<std::string> all;
  for (Eigen::Index i = told.singular.size() - 1; i >= 0 && told.singular[i] < half_told; --i)
    all.push_back(words_of(told, i, stand));
  return all;
}

ShownChange shown_change(const Calibrated &unknown)
{
  const bool delay     = unknown.name == "delay";
  const auto in_unit   = [&](const double theta) { return delay ? 1e3 * theta : 100 * std::expm1(theta); };
  const double width   = in_unit(unknown.high) - in_unit(unknown.low);
  const int decimals   = width > 0 ? std::clamp(int(std::ceil(1.5 - std::log10(width))), 0, 8) : 2;
  const auto formatted = [&](const double theta) {
    return fmt::format("{:+.{}f} {}", in_unit(theta), decimals, delay ? "ms" : "%");
  };
  return {formatted(unknown.kept), formatted(unknown.estimate), formatted(unknown.low), formatted(unknown.high)};
}

std::string without_force_words()
{
  return "no force was recorded; the force was eliminated: at each frequency the ratios of the accelerations "
         "count, and their level as far as the force is smooth over a third octave. Where a channel holds the "
         "force, name it with --channel AI_01=force";
}

std::string weakest_direction(const Told &told, const FittedStand &stand)
{
  return words_of(told, told.singular.size() - 1, stand, false);
}
}  // namespace mill::twin
