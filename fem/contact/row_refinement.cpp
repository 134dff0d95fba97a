#include "fem/contact/row_refinement.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace mill::contact {
namespace {
// Rows in which the line load bends, and their neighbours.
std::vector<char> bent_rows(const QuarterGrid &grid, const HalfSpaceState &state, const double bend)
{
  const Eigen::VectorXd &load = state.line_load;
  const Eigen::Index n        = load.size();
  const double limit          = bend * load.maxCoeff();
  std::vector<char> bent(std::size_t(n), 0);
  for (Eigen::Index j = 0; j < n; ++j) {
    // A quarter continues as its mirror image below the first row; nothing is known beyond an end of the face.
    const double below = j > 0 ? load[j - 1] : load[j], above = j + 1 < n ? load[j + 1] : load[j];
    if ((grid.half && j == 0) || j + 1 == n || std::abs(below - 2 * load[j] + above) <= limit)
      continue;
    for (Eigen::Index k = std::max<Eigen::Index>(0, j - 1); k <= j + 1; ++k)
      bent[std::size_t(k)] = 1;
  }
  return bent;
}
}  // namespace

Eigen::VectorXd refined_rows(const QuarterGrid &grid, const HalfSpaceState &state, const double bend,
                             const double least)
{
  const int n             = int(grid.z.size()) - 1;
  const auto length       = [&](const int row) { return grid.z[row + 1] - grid.z[row]; };
  std::vector<char> split = bent_rows(grid, state, bend);
  for (int j = 0; j < n; ++j)
    if (length(j) < 2 * least)
      split[std::size_t(j)] = 0;
  const auto new_length = [&](const int row) { return length(row) / (split[std::size_t(row)] ? 2 : 1); };
  for (bool changed = true; changed;) {
    changed = false;
    for (int j = 0; j < n; ++j)
      for (const int neighbour : {j - 1, j + 1})
        if (neighbour >= 0 && neighbour < n && !split[std::size_t(j)] &&
            length(j) > 2.05 * new_length(neighbour)) {  // 2.05: two is allowed, up to rounding
          split[std::size_t(j)] = 1;
          changed               = true;
        }
  }
  std::vector<double> edges{grid.z[0]};
  for (int j = 0; j < n; ++j) {
    if (split[std::size_t(j)])
      edges.push_back(0.5 * (grid.z[j] + grid.z[j + 1]));
    edges.push_back(grid.z[j + 1]);
  }
  return Eigen::Map<Eigen::VectorXd>(edges.data(), Eigen::Index(edges.size()));
}
}  // namespace mill::contact
