#include "twin/modes/decimated.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
// Parts of the grid that are in pieces of all channels.
std::vector<Span> shared_pieces(const std::vector<const CleanChannel *> &channels)
{
  std::vector<Span> shared = channels.front()->pieces;
  for (const CleanChannel *channel : channels) {
    std::vector<Span> both;
    for (const Span &a : shared)
      for (const Span &b : channel->pieces)
        if (const Span c{std::max(a.begin, b.begin), std::min(a.end, b.end)}; c.begin < c.end)
          both.push_back(c);
    shared = std::move(both);
  }
  return shared;
}

Eigen::VectorXd low_pass_of_factor(const Eigen::Index factor)
{
  const Eigen::Index half = 6 * factor;
  Eigen::VectorXd taps(2 * half + 1);
  for (Eigen::Index i = -half; i <= half; ++i) {
    const double x = double(i) / double(factor);  // cut at half of the new rate
    taps[i + half] = (i == 0 ? 1 : std::sin(M_PI * x) / (M_PI * x)) *
                     (0.54 + 0.46 * std::cos(M_PI * double(i) / double(half + 1)));
  }
  return taps / taps.sum();
}
}  // namespace

double DecimatedRecord::duration() const
{
  double n = 0;
  for (const auto &part : piece)
    n += double(part.cols());
  return n / rate;
}

DecimatedRecord decimated(const std::vector<const CleanChannel *> &channels, const double rate,
                          const double highest)
{
  const auto factor          = std::max<Eigen::Index>(1, Eigen::Index(rate / (4 * highest) + 1e-6));
  const Eigen::VectorXd taps = low_pass_of_factor(factor);
  DecimatedRecord result{rate / double(factor), {}};
  for (const Span &span : shared_pieces(channels)) {
    const Eigen::Index used = factor == 1 ? 1 : taps.size(), n = (span.size() - used) / factor + 1;
    if (span.size() < used || n < 512)
      continue;
    Eigen::MatrixXd part(Eigen::Index(channels.size()), n);
    for (std::size_t c = 0; c < channels.size(); ++c)
      for (Eigen::Index k = 0; k < n; ++k)
        part(Eigen::Index(c), k) = factor == 1
                                       ? channels[c]->value[span.begin + k]
                                       : channels[c]->value.segment(span.begin + k * factor, used).dot(taps);
    result.piece.push_back(std::move(part));
  }
  return result;
}

std::vector<DecimatedRecord> halves(const DecimatedRecord &record)
{
  Eigen::Index all = 0;
  for (const auto &part : record.piece)
    all += part.cols();
  std::vector<DecimatedRecord> result{{record.rate, {}}, {record.rate, {}}};
  Eigen::Index before = 0;
  for (const auto &part : record.piece) {
    const Eigen::Index first = std::clamp<Eigen::Index>(all / 2 - before, 0, part.cols());
    if (first > 0)
      result[0].piece.push_back(part.leftCols(first));
    if (first < part.cols())
      result[1].piece.push_back(part.rightCols(part.cols() - first));
    before += part.cols();
  }
  return result;
}
}  // namespace mill::twin
