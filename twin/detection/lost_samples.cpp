#include "twin/detection/lost_samples.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr std::size_t strongest_lines = 10;
constexpr Eigen::Index shortest_block = 8, longest_block = 1 << 16, fewest_blocks = 20;
constexpr double least_step          = 5;  // -, times the median of the other places of a block
constexpr std::ptrdiff_t most_places = 3;  // where a lost sample is seen in second differences: the border alone

// Mean square of the second difference at each place of a block; the largest over the median.  Zero where it is
// large over more than a border: impacts that come at this rate, as those of a bearing, ring on.
double step_at_borders(const CleanChannel &channel, const Eigen::Index block)
{
  std::vector<double> sum(std::size_t(block), 0.0), count(std::size_t(block), 0.0);
  for (const Span &piece : channel.pieces)
    for (Eigen::Index k = piece.begin + 2; k < piece.end; ++k) {
      const double bend = channel.value[k] - 2 * channel.value[k - 1] + channel.value[k - 2];
      sum[std::size_t(k % block)] += bend * bend;
      count[std::size_t(k % block)] += 1;
    }
  for (std::size_t i = 0; i < sum.size(); ++i)
    sum[i] /= std::max(1.0, count[i]);
  const double largest = *std::max_element(sum.begin(), sum.end());
  const auto middle    = sum.begin() + std::ptrdiff_t(sum.size() / 2);
  std::nth_element(sum.begin(), middle, sum.end());
  if (!(*middle > 0))
    return 0;
  const double between = std::sqrt(largest * *middle);
  const auto places    = std::count_if(sum.begin(), sum.end(), [&](const double s) { return s > between; });
  return places <= most_places ? largest / *middle : 0;
}

// Lines at |f + j d| of a line f.
std::vector<std::size_t> comb_of(const std::vector<SeenLine> &lines, const SeenLine &first, const double spacing)
{
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double reach = 5 * std::hypot(lines[i].deviation, first.deviation);
    for (const double sign : {-1.0, 1.0})
      if (const double away = std::remainder(lines[i].frequency - sign * first.frequency, spacing);
          std::abs(away) <= reach) {
        members.push_back(i);
        break;
      }
  }
  return members;
}
}  // namespace

std::optional<LostSamples> lost_samples(const CleanChannel &channel, const double rate,
                                        const std::vector<SeenLine> &lines)
{
  std::vector<std::size_t> strong(lines.size());
  for (std::size_t i = 0; i < strong.size(); ++i)
    strong[i] = i;
  std::sort(strong.begin(), strong.end(),
            [&](const auto a, const auto b) { return lines[a].power > lines[b].power; });
  strong.resize(std::min(strong.size(), strongest_lines));
  std::vector<Eigen::Index> tried;
  std::optional<LostSamples> best;
  for (const std::size_t a : strong)
    for (const std::size_t b : strong) {
      if (a == b)
        continue;
      for (const double apart :
           {std::abs(lines[a].frequency - lines[b].frequency), lines[a].frequency + lines[b].frequency}) {
        const double block = rate / apart, near = std::round(block);
        const double reach = 5 * block * std::hypot(lines[a].deviation, lines[b].deviation) / apart;
        if (near < double(shortest_block) || near > double(longest_block) ||
            std::abs(block - near) > std::min(0.2, reach))
          continue;
        const auto n = Eigen::Index(near);
        if (channel.n_used() < fewest_blocks * n || std::find(tried.begin(), tried.end(), n) != tried.end())
          continue;
        tried.push_back(n);
        const double spacing  = rate / near;
        const SeenLine &first = lines[strong.front()];
        if (std::abs(std::remainder(first.frequency, spacing)) < 5 * first.deviation)
          continue;  // harmonics of something at rate/block, no comb of a line
        auto members = comb_of(lines, first, spacing);
        if (members.size() < 3 || (best && members.size() <= best->members.size()))
          continue;  // a spacing of two combs holds fewer of the lines
        if (const double step = step_at_borders(channel, n); step > least_step)
          best = LostSamples{n, spacing, first.frequency, step, std::move(members)};
      }
    }
  return best;
}
}  // namespace mill::twin
