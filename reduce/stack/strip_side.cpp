#include "reduce/stack/strip_side.h"
#include <algorithm>
#include <utility>

namespace mill::reduce {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
double mean_departure(const StackRoll &roll, const double z1, const double z2)
{
  double mean = 0;
  for (int g = 0; g < UnitGauss::n; ++g)
    mean += UnitGauss::weight[g] * radius_departure(roll, z1 + (z2 - z1) * UnitGauss::place[g]);
  return mean;
}
}  // namespace

StripSide::StripSide(const Stack &s, RollGroup &of, const std::size_t work_roll, const double direction,
                     VectorXd edges, const Flattening law)
    : group(of), stack(s), roll(work_roll), sign(direction)
{
  const double offset = stack.strip.offset;
  const Index n       = edges.size() - 1;
  ground.resize(n);
  for (Index i = 0; i < n; ++i) {
    rows.push_back(group.integral(roll, edges[i] + offset, edges[i + 1] + offset, sign));
    ground[i] = mean_departure(stack.rolls[roll], edges[i] + offset, edges[i + 1] + offset);
  }
  flattened = {std::move(edges), stack.rolls[roll].diameter / 2, stack.strip.arc, stack.rolls[roll].material, law};
  flattening = flattening_matrix(flattened);
}

const MatrixXd &StripSide::flexibility()
{
  const Index n = Index(rows.size());
  MatrixXd half = MatrixXd::Zero(group.size(), n);
  // Loads lie from station to station: columns in packs, each from the first row that one of them loads.
  constexpr Index pack = 16;
  for (Index first = 0; first < n; first += pack) {
    const Index k = std::min(pack, n - first);
    for (Index i = first; i < first + k; ++i)
      rows[std::size_t(i)].add_to(half.col(i), 1);
    const auto &of_first = rows[std::size_t(first)].unknown;
    group.stiffness.forward(half.middleCols(first, k), *std::min_element(of_first.begin(), of_first.end()));
  }
  by_axis = MatrixXd::Zero(n, n);
  by_axis.selfadjointView<Eigen::Lower>().rankUpdate(half.transpose());
  by_axis.triangularView<Eigen::StrictlyUpper>() = by_axis.transpose();
  return by_axis;
}

VectorXd StripSide::respond(const VectorXd &residual, const VectorXd &q) const
{
  VectorXd x = residual;
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i].add_to(x, q[Index(i)]);
  group.stiffness.forward(x);
  group.stiffness.backward(x);
  return x;
}

VectorXd StripSide::integrals(const VectorXd &u) const
{
  VectorXd b(Index(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    b[Index(i)] = rows[i].dot(u);
  return b;
}

double StripSide::opening(const VectorXd &u, const VectorXd &q, const double z1, const double z2,
                          const bool with_ground) const
{
  const double offset = stack.strip.offset;
  const double axis   = group.integral(roll, z1 + offset, z2 + offset, sign / (z2 - z1)).dot(u);
  const double flat   = flattening_between(flattened, z1, z2).dot(q);
  return axis + flat - (with_ground ? mean_departure(stack.rolls[roll], z1 + offset, z2 + offset) : 0);
}
}  // namespace mill::reduce
