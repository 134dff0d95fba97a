#include "fem/contact/set_by_continuation.h"
#include "fem/contact/active_factor.h"
#include "fem/contact/continuation.h"
#include "fem/contact/reachable.h"
#include <algorithm>

namespace mill::contact {
namespace {
void project_out(Eigen::MatrixXd &rows, const int i)
{
  const Eigen::RowVectorXd direction = rows.row(i).normalized();
  if (direction.allFinite())
    rows -= (rows * direction.transpose()).eval() * direction;
}

// Pressing forces with the resultants, and nodes without force until the free motions are determined: each time
// the one whose arm differs most from those taken.
Support balanced(const Eigen::MatrixXd &G, const Eigen::VectorXd &resultant)
{
  Support out          = pressing_support(G, resultant);
  Eigen::MatrixXd rest = G;
  for (const int i : out.nodes)
    project_out(rest, i);
  while (Eigen::Index(out.nodes.size()) < G.cols()) {
    int far = 0;
    if (rest.rowwise().norm().maxCoeff(&far) < 1e-10)  // scaled to 1: the others add nothing
      break;
    out.nodes.push_back(far);
    project_out(rest, far);
  }
  return out;
}
}  // namespace

std::vector<int> set_by_continuation(const Problem &p, const ScaledModes &modes, const Loading &loading)
{
  const int n = int(p.C.rows()), k = modes.k;
  std::vector<int> imposed;
  for (int j = 0; j < k; ++j)
    if (!loading.prescribed[j])
      imposed.push_back(j);
  Support support;
  if (!imposed.empty())
    support = balanced(modes.rhs(Eigen::all, imposed), loading.value(imposed));

  Eigen::VectorXd nodal = Eigen::VectorXd::Zero(n);
  for (int i = 0; i < support.force.size(); ++i)
    nodal[support.nodes[i]] = support.force[i];
  ModeState start;
  start.motion    = loading.value;
  start.resultant = modes.rhs.leftCols(k).transpose() * nodal;
  for (const int j : imposed) {
    start.motion[j]    = 0;
    start.resultant[j] = loading.value[j];
  }
  // The gap that closes exactly on the nodes taken and nowhere else, and what it lacks of the true one.
  const Eigen::VectorXd closed =
      modes.rhs.leftCols(k) * start.motion - modes.rhs.middleCols(k, k) * start.resultant - p.C * nodal;
  const double away = std::max({closed.cwiseAbs().maxCoeff(), p.initial_gap.cwiseAbs().maxCoeff(), 1e-300});
  Eigen::MatrixXd gaps(n, 2);
  gaps.col(0) = closed.array() + away;
  for (const int i : support.nodes)
    gaps(i, 0) = closed[i];
  gaps.col(1) = p.initial_gap - gaps.col(0);

  const ScaledModes path = scaled_modes(p.G, p.W, modes.compliance, gaps);
  ActiveFactor factor(p.C, path.rhs);
  factor.reset(support.nodes);
  Loading still = loading;
  still.value.setZero();
  const std::vector<int> idle(support.nodes.begin() + support.force.size(), support.nodes.end());
  follow_path(factor, path, loading, still, start, idle, [](const PathStep &) {});
  return factor.order();
}
}  // namespace mill::contact
