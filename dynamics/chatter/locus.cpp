#include "core/base/errors.h"
#include "dynamics/chatter/modes.h"
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace mill::dynamics {
namespace {
using Complex = std::complex<double>;

// Assignment of rows to columns with the least sum of costs, by shortest augmenting paths with potentials.
// Source: H. W. Kuhn, Naval Res. Logist. Q. 2 (1955) 83; R. Jonker, A. Volgenant, Computing 38 (1987) 325.
std::vector<int> assignment(const Eigen::MatrixXd &cost)
{
  const int n = int(cost.rows()), none = n;
  std::vector<double> row_price(std::size_t(n) + 1, 0), column_price(std::size_t(n) + 1, 0);
  std::vector<int> row_of(std::size_t(n) + 1, none), way(std::size_t(n) + 1, none);  // column n: the new row
  for (int row = 0; row < n; ++row) {
    row_of[std::size_t(n)] = row;
    std::vector<double> least(std::size_t(n) + 1, std::numeric_limits<double>::infinity());
    std::vector<bool> used(std::size_t(n) + 1, false);
    int column = n;
    do {
      used[std::size_t(column)] = true;
      const int r               = row_of[std::size_t(column)];
      double delta              = std::numeric_limits<double>::infinity();
      int next                  = none;
      for (int j = 0; j < n; ++j) {
        if (used[std::size_t(j)])
          continue;
        const double reduced = cost(r, j) - row_price[std::size_t(r)] - column_price[std::size_t(j)];
        if (reduced < least[std::size_t(j)]) {
          least[std::size_t(j)] = reduced;
          way[std::size_t(j)]   = column;
        }
        if (least[std::size_t(j)] < delta) {
          delta = least[std::size_t(j)];
          next  = j;
        }
      }
      for (int j = 0; j <= n; ++j)
        if (used[std::size_t(j)]) {
          row_price[std::size_t(row_of[std::size_t(j)])] += delta;
          column_price[std::size_t(j)] -= delta;
        } else
          least[std::size_t(j)] -= delta;
      column = next;
    } while (row_of[std::size_t(column)] != none);
    while (column != n) {
      const int before            = way[std::size_t(column)];
      row_of[std::size_t(column)] = row_of[std::size_t(before)];
      column                      = before;
    }
  }
  std::vector<int> column_of(static_cast<std::size_t>(n));
  for (int j = 0; j < n; ++j)
    column_of[std::size_t(row_of[std::size_t(j)])] = j;
  return column_of;
}

// Roots at one speed in the order of the branches, and how fast each moves.
struct Front {
  double speed;
  Eigen::VectorXcd root, slope;  ///< 1/s, 1/s per m/s; an empty slope: not known yet
};

std::optional<Eigen::VectorXcd> roots_at(const MatrixAtSpeed &matrix, const double speed)
{
  try {
    return eigenvalues(matrix(speed));
  } catch (const InputError &) {
    return {};
  } catch (const SolverError &) {
    return {};
  }
}

// The front moved to where it points, and its roots there; `clear` is whether every root ended nearer to its
// own prediction than half the distance to the next root.
Front advanced(const Front &from, const double speed, const Eigen::VectorXcd &roots, bool &clear)
{
  const double step     = speed - from.speed;
  Eigen::VectorXcd goal = from.root;
  if (from.slope.size())
    goal += step * from.slope;
  const Eigen::Index s = roots.size();
  Eigen::MatrixXd cost(s, s);
  for (Eigen::Index i = 0; i < s; ++i)
    for (Eigen::Index j = 0; j < s; ++j)
      cost(i, j) = std::abs(goal[i] - roots[j]);
  const std::vector<int> to = assignment(cost);
  Front next{speed, Eigen::VectorXcd(s), {}};
  clear = true;
  for (Eigen::Index i = 0; i < s; ++i) {
    const int root = to[std::size_t(i)];
    next.root[i]   = roots[root];
    for (Eigen::Index j = 0; j < s; ++j)
      clear = clear && (j == root || cost(i, root) < 0.5 * std::abs(roots[root] - roots[j]));
  }
  next.slope = (next.root - from.root) / step;
  return next;
}
}  // namespace

RootLocus root_locus(const MatrixAtSpeed &matrix, const Eigen::VectorXd &speeds)
{
  RootLocus locus;
  locus.speed = speeds;
  std::optional<Front> front;
  // From the front to a speed in halves while it is not clear which root is which.  Roots that meet (a pair that
  // turns into two real roots) never are; seven halvings leave the choice to the least sum of distances.
  const auto go = [&](const auto &self, const double to, const int depth) -> void {
    const auto roots = roots_at(matrix, to);
    if (!roots) {
      front.reset();
      return;
    }
    if (!front) {
      front = Front{to, *roots, {}};
      return;
    }
    bool clear       = false;
    const Front next = advanced(*front, to, *roots, clear);
    if (clear || depth == 7) {
      front = next;
      return;
    }
    self(self, 0.5 * (front->speed + to), depth + 1);
    self(self, to, depth + 1);
  };
  for (Eigen::Index k = 0; k < speeds.size(); ++k) {
    go(go, speeds[k], 0);
    if (!front)
      continue;
    if (locus.branch.size() == 0)
      locus.branch = Eigen::MatrixXcd::Constant(front->root.size(), speeds.size(), Complex(not_given, not_given));
    locus.branch.col(k) = front->root;
  }
  return locus;
}
}  // namespace mill::dynamics
