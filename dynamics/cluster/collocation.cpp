#include "dynamics/cluster/collocation.h"
#include <array>
#include <cmath>

namespace mill::cluster {
namespace {
constexpr int s = Collocation::stages;

// Legendre polynomials of 0 .. 1, P_0 .. P_s.
std::array<double, s + 1> legendre(const double x)
{
  const double t = 2 * x - 1;
  std::array<double, s + 1> P{};
  P[0] = 1;
  P[1] = t;
  for (std::size_t k = 1; k < s; ++k)
    P[k + 1] = ((2. * double(k) + 1) * t * P[k] - double(k) * P[k - 1]) / (double(k) + 1);
  return P;
}
}  // namespace

Collocation::Collocation()
{
  for (int i = 0; i < s; ++i) {
    double t = -std::cos(M_PI * (i + 0.75) / (s + 0.5)), slope = 0;
    for (int k = 0; k < 50; ++k) {  // Newton on P_s
      const auto P        = legendre(0.5 * (t + 1));
      slope               = s * (t * P[s] - P[s - 1]) / (t * t - 1);
      const double change = P[s] / slope;
      t -= change;
      if (std::abs(change) < 1e-16)
        break;
    }
    c[i] = 0.5 * (t + 1);
    b[i] = 1 / ((1 - t * t) * slope * slope);
  }
  for (int i = 0; i < s; ++i)
    A.row(i) = up_to(c[i]);
  AA = A * A;
  bA = b * A;
  for (int j = 0; j < s; ++j)
    last[j] = (2 * s - 1) * b[j] * legendre(c[j])[s - 1];
}

Collocation::Row Collocation::up_to(const double x) const
{
  const auto basis = legendre(x);
  Row row;
  for (int j = 0; j < s; ++j) {
    const auto P = legendre(c[j]);
    double sum   = x;
    for (std::size_t k = 1; k < s; ++k)
      sum += 0.5 * P[k] * (basis[k + 1] - basis[k - 1]);
    row[j] = b[j] * sum;
  }
  return row;
}
}  // namespace mill::cluster
