#include "fem/stack/contact_stations.h"
#include <algorithm>
#include <cmath>

namespace mill::fem {
using Eigen::Index;
using Eigen::VectorXd;

namespace {
constexpr double overlap_ignored = 1e-6;  // m
constexpr double finest          = 0.5;   // of the longest station, where the load has an end or a kink
constexpr double grading         = 0.3;   // length over the distance from there

double wanted_length(const double z, const double from, const double to, const double longest)
{
  return std::clamp(grading * std::min(z - from, to - z), finest * longest, longest);
}

// Pieces between two ends, in steps that follow wanted_length().
void add_pieces(std::vector<double> &z, const double from, const double to, const double longest)
{
  constexpr int samples = 200;
  std::vector<double> count{0};
  const double step = (to - from) / samples;
  for (int i = 0; i < samples; ++i)
    count.push_back(count.back() + step / wanted_length(from + (i + 0.5) * step, from, to, longest));
  const int pieces = std::max(1, int(std::lround(count.back())));
  std::vector<double> places;
  std::size_t i = 0;
  for (int k = 1; k < pieces; ++k) {
    const double wanted = count.back() * k / pieces;
    while (count[i + 1] < wanted)
      ++i;
    places.push_back(from + step * (double(i) + (wanted - count[i]) / (count[i + 1] - count[i])));
  }
  for (std::size_t k = 0; k < places.size(); ++k)  // the same from both ends to the last digit
    z.push_back((places[k] + (from + to - places[places.size() - 1 - k])) / 2);
  z.push_back(to);
}
}  // namespace

ContactStations stations_in(const std::vector<std::array<double, 2>> &zones, const StackStrip &strip,
                            const double longest)
{
  std::vector<double> from, to;
  for (const auto &[start, end] : zones) {
    std::vector<double> breaks{start};
    for (const double edge : {strip.offset - strip.width / 2, strip.offset + strip.width / 2})
      if (edge > start + longest && edge < end - longest)
        breaks.push_back(edge);
    breaks.push_back(end);
    std::vector<double> z{start};
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
      add_pieces(z, breaks[i], breaks[i + 1], longest);
    from.insert(from.end(), z.begin(), z.end() - 1);
    to.insert(to.end(), z.begin() + 1, z.end());
  }
  return {Eigen::Map<VectorXd>(from.data(), Index(from.size())),
          Eigen::Map<VectorXd>(to.data(), Index(to.size()))};
}

Eigen::SparseMatrix<double> spread_on_roll(const ContactStations &stations, const VectorXd &edge,
                                           const double shift)
{
  const Index M     = edge.size() - 1;
  const auto centre = [&](const Index i) { return (edge[i] + edge[i + 1]) / 2; };
  std::vector<Eigen::Triplet<double>> entries;
  for (Index k = 0; k < stations.size(); ++k) {
    const double from = stations.from[k] - shift, to = stations.to[k] - shift;
    Index first = std::upper_bound(edge.begin(), edge.end(), from + overlap_ignored) - edge.begin() - 1;
    first       = std::clamp<Index>(first, 0, M - 1);
    Index last  = first;
    while (last + 1 < M && edge[last + 1] < to - overlap_ignored)
      ++last;
    VectorXd share(last - first + 1);
    double lever = 0;
    for (Index i = first; i <= last; ++i) {
      share[i - first] = (std::min(to, edge[i + 1]) - std::max(from, edge[i])) / (to - from);
      lever += share[i - first] * centre(i);
    }
    // What covers a station in part moves its resultant: a pair of forces moves it back.
    const double moment = (from + to) / 2 - lever;
    for (Index i = first; i <= last; ++i)
      entries.emplace_back(i, k, share[i - first]);
    if (std::abs(moment) > 1e-15) {
      // Within one station, its neighbour on the side to which the resultant has to move.
      const bool up     = moment > 0;
      const Index one   = first == last && (!up || last + 1 == M) && first > 0 ? first - 1 : first,
                  other = first == last && one == first ? first + 1 : last;
      const double pair = moment / (centre(other) - centre(one));
      entries.emplace_back(one, k, -pair);
      entries.emplace_back(other, k, pair);
    }
  }
  Eigen::SparseMatrix<double> T(M, stations.size());
  T.setFromTriplets(entries.begin(), entries.end());
  return T;
}
}  // namespace mill::fem
