#include "twin/onset/growth.h"
#include "twin/onset/onset_watch.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
using Complex = std::complex<double>;

constexpr int first_lag = 2;                                       // below: noise and filter
constexpr double reach = 0.7, longest = 2, shortest_sigma = 0.35;  // -, s, 1/s
constexpr double scatter_over_law = 1.6;                           // -

Complex correlation(const ComplexEnvelope &envelope, const Eigen::Index lag)
{
  Complex sum = 0;
  double n    = 0;
  for (const auto &z : envelope.z)
    if (z.size() > lag) {
      sum += z.head(z.size() - lag).dot(z.tail(z.size() - lag));  // the first factor is conjugated
      n += double(z.size() - lag);
    }
  return n > 0 ? sum / n : 0;
}

// lambda of one step from lags 2 .. m2.
Complex step_factor(const std::vector<Complex> &R, const int last)
{
  Complex sum   = 0;
  double weight = 0;
  for (int m = first_lag; m <= last && m + 1 < int(R.size()); ++m) {
    sum += R[std::size_t(m + 1)] * std::conj(R[std::size_t(m)]);
    weight += std::norm(R[std::size_t(m)]);
  }
  return weight > 0 ? sum / weight : 0;
}
}  // namespace

bool GrowthRate::near_instability() const
{
  return upper() > near_instability_from;
}

double GrowthRate::upper() const
{
  return sigma + 1.96 * scatter_over_law * law;
}

GrowthRate growth_rate(const ComplexEnvelope &envelope)
{
  GrowthRate growth;
  for (const auto &z : envelope.z)
    growth.duration += double(z.size()) / envelope.rate;
  const int most = int(longest * envelope.rate);
  std::vector<Complex> R;
  for (int m = 0; m <= most + 1; ++m)
    R.push_back(correlation(envelope, m));
  if (!(std::abs(R[0]) > 0) || growth.duration < 4 * longest)
    return growth;
  growth.kept  = std::abs(R[2]) / std::abs(R[0]);
  double sigma = -1 / longest;
  for (int i = 0; i < 8; ++i) {  // the reach of the lags follows the rate they tell
    const int last =
        std::clamp(int(reach / std::max(std::abs(sigma), shortest_sigma) * envelope.rate), first_lag + 1, most);
    const Complex lambda = step_factor(R, last);
    if (!(std::abs(lambda) > 0))
      return growth;
    sigma            = envelope.rate * std::log(std::abs(lambda));
    growth.frequency = envelope.frequency + std::arg(lambda) * envelope.rate / (2 * M_PI);
  }
  growth.sigma = sigma;
  growth.law   = std::sqrt(std::abs(sigma) / growth.duration);
  return growth;
}

std::vector<Alarm> alarms(const ComplexEnvelope &envelope, const AlarmSettings &settings)
{
  std::vector<Alarm> found;
  for (std::size_t p = 0; p < envelope.z.size(); ++p) {
    OnsetWatch watch(envelope.frequency, envelope.rate, settings);
    for (Eigen::Index k = 0; k < envelope.z[p].size(); ++k)
      if (const auto alarm = watch.take(envelope.start[p] + double(k) / envelope.rate, envelope.z[p][k]))
        found.push_back(*alarm);
  }
  return found;
}

double longest_lead(const double limit, const double threshold_level, const double sigma)
{
  return std::log(limit / threshold_level) / sigma;
}
}  // namespace mill::twin
