#include "twin/calibration/words.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill::twin {
namespace {
constexpr double half_identified  = 1.7320508075688772;  // singular value at which sd is half of the prior's
constexpr double deviations_of_95 = 1.96;

std::string words_of(const Identification &identification, const Eigen::Index column, const FittedStand &stand,
                     const bool unseen = true)
{
  std::vector<std::pair<double, std::string>> parts;
  for (Eigen::Index i = 0; i < identification.direction.rows(); ++i)
    if (std::abs(identification.direction(i, column)) > 0.15)
      parts.emplace_back(identification.direction(i, column), identification.names[std::size_t(i)]);
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
    return sum + ": these records hardly depend on " + parts[0].second;
  if (parts.size() == 2 && parts[0].first * parts[1].first < 0 &&
      share_a_part(stand, parts[0].second, parts[1].second))
    return sum + ": these records depend on the two springs in series alone";
  return sum + ": these records hardly depend on this combination";
}
}  // namespace

std::vector<std::string> unseen_directions(const Identification &identification, const FittedStand &stand)
{
  std::vector<std::string> all;
  for (Eigen::Index i = identification.singular.size() - 1; i >= 0 && identification.singular[i] < half_identified;
       --i)
    all.push_back(words_of(identification, i, stand));
  return all;
}

ChangeInterval change_interval(const Calibrated &u, const bool written)
{
  if (!written)
    return {u.estimate, u.low, u.high};
  const double reach = deviations_of_95 * (u.kept_sd > 0 ? u.kept_sd : u.sd);
  return {u.kept, std::min(u.low, u.kept - reach), std::max(u.high, u.kept + reach)};
}

double deviation_of(const ChangeInterval &change)
{
  return std::max(change.high - change.value, change.value - change.low) / deviations_of_95;
}

ShownChange shown_change(const Calibrated &unknown, const bool written)
{
  const ChangeInterval change = change_interval(unknown, written);
  const bool delay            = moves(unknown) == Moves::delay;
  const auto in_unit          = [&](const double theta) { return delay ? 1e3 * theta : 100 * std::expm1(theta); };
  const double width          = in_unit(change.high) - in_unit(change.low);
  const int decimals          = width > 0 ? std::clamp(int(std::ceil(1.5 - std::log10(width))), 0, 8) : 2;
  const auto formatted        = [&](const double theta) {
    return fmt::format("{:+.{}f} {}", in_unit(theta), decimals, delay ? "ms" : "%");
  };
  return {formatted(change.value), formatted(change.low), formatted(change.high)};
}

std::string without_force_words()
{
  return "no force was recorded, so the fit eliminates it: at each frequency it uses the ratios of the "
         "accelerations, and their level as far as the force is smooth over a third octave. Where a channel holds "
         "the force, name it with --channel AI_01=force";
}

std::string weakest_direction(const Identification &identification, const FittedStand &stand)
{
  return words_of(identification, identification.singular.size() - 1, stand, false);
}
}  // namespace mill::twin
