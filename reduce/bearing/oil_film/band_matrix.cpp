#include "reduce/bearing/oil_film/band_matrix.h"
#include <algorithm>

namespace mill::bearing {
void BandMatrix::factor()
{
  const Eigen::Index stride = 2 * w + 1;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double *pivot_row  = entries.data() + k * stride + w;  // on its diagonal
    const double inverse     = 1 / *pivot_row;
    const Eigen::Index reach = std::min(w, n - 1 - k);
    for (Eigen::Index i = 1; i <= reach; ++i) {
      double *row = entries.data() + (k + i) * stride + w - i;  // at column k
      if (*row == 0)
        continue;
      const double share = *row *= inverse;
      for (Eigen::Index j = 1; j <= reach; ++j)
        row[j] -= share * pivot_row[j];
    }
  }
}

void BandMatrix::solve(Eigen::Ref<Eigen::VectorXd> x) const
{
  const Eigen::Index stride = 2 * w + 1;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double *row = entries.data() + i * stride + w - i;
    for (Eigen::Index j = std::max<Eigen::Index>(0, i - w); j < i; ++j)
      x[i] -= row[j] * x[j];
  }
  for (Eigen::Index i = n - 1; i >= 0; --i) {
    const double *row = entries.data() + i * stride + w - i;
    for (Eigen::Index j = i + 1; j <= std::min(n - 1, i + w); ++j)
      x[i] -= row[j] * x[j];
    x[i] /= row[i];
  }
}
}  // namespace mill::bearing
