#include "fem/body/free_unknowns.h"

namespace mill::fem {
FreeUnknowns free_unknowns(const SymmetricSparse &K, const std::vector<char> &held)
{
  FreeUnknowns f;
  f.place.assign(K.rows(), -1);
  for (int i = 0; i < K.rows(); ++i)
    if (!held[i]) {
      f.place[i] = int(f.unknown.size());
      f.unknown.push_back(i);
      f.node.push_back(i / 3);
    }
  const int n = int(f.unknown.size());
  std::vector<int> start(n + 1, 0), rows;
  std::vector<double> values;
  rows.reserve(K.nonZeros());
  values.reserve(K.nonZeros());
  for (int j = 0; j < n; ++j) {
    for (SymmetricSparse::InnerIterator it(K, f.unknown[j]); it; ++it)
      if (f.place[it.row()] >= 0) {
        rows.push_back(f.place[it.row()]);
        values.push_back(it.value());
      }
    start[j + 1] = int(rows.size());
  }
  f.K = Eigen::Map<SymmetricSparse>(n, n, int(rows.size()), start.data(), rows.data(), values.data());
  return f;
}

Eigen::MatrixXd rows_and_columns(const Eigen::MatrixXd &C, const std::vector<int> &rows,
                                 const std::vector<int> &columns)
{
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(Eigen::Index(rows.size()), Eigen::Index(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i] >= 0 && columns[j] >= 0)
        out(Eigen::Index(i), Eigen::Index(j)) = C(rows[i], columns[j]);
  return out;
}
}  // namespace mill::fem
