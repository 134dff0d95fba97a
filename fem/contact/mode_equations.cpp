#include "fem/contact/mode_equations.h"
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace mill::contact {
ScaledModes scaled_modes(const Eigen::MatrixXd &G, const Eigen::MatrixXd &W, const double compliance,
                         const Eigen::MatrixXd &gaps)
{
  ScaledModes out;
  out.k          = int(G.cols());
  out.compliance = compliance;
  out.scale.resize(out.k);
  out.rhs.setZero(G.rows(), 2 * out.k + gaps.cols());
  for (int j = 0; j < out.k; ++j) {
    const double largest = G.col(j).cwiseAbs().maxCoeff();
    out.scale[j]         = largest > 0 ? largest : 1.;
    out.rhs.col(j)       = G.col(j) / out.scale[j];
    if (W.size() > 0)
      out.rhs.col(out.k + j) = W.col(j) * out.scale[j];
  }
  out.rhs.rightCols(gaps.cols()) = gaps;
  return out;
}

Loading scaled(const Loading &loading, const ScaledModes &modes)
{
  Loading out = loading;
  out.prescribed.resize(modes.k, 0);
  for (int j = 0; j < modes.k; ++j)
    out.value[j] *= out.prescribed[j] ? modes.scale[j] : 1 / modes.scale[j];
  return out;
}

namespace {
// H in units of 1 / compliance and M, both without unit.
struct Reduced {
  Eigen::MatrixXd H, M;
};

Reduced reduced(const Eigen::MatrixXd &gram, const ScaledModes &modes)
{
  const int k       = modes.k;
  Eigen::MatrixXd M = gram.block(0, k, k, k);
  M.diagonal().array() += 1;
  return {gram.topLeftCorner(k, k) * modes.compliance, M};
}
}  // namespace

ModeState solve_modes(const Eigen::MatrixXd &gram, const ScaledModes &modes, const Loading &loading, const int gap,
                      const ModeState *near)
{
  const int k       = modes.k;
  const auto [H, M] = reduced(gram, modes);
  // Lengths in units of 1, forces in units of 1 / compliance.
  Eigen::VectorXd rhs = gram.block(0, 2 * k + gap, k, 1) * modes.compliance;
  Eigen::MatrixXd N(k, k);
  for (int j = 0; j < k; ++j)
    if (loading.prescribed[j]) {
      N.col(j) = -M.col(j);
      rhs -= H.col(j) * loading.value[j];
    } else {
      N.col(j) = H.col(j);
      rhs += M.col(j) * (loading.value[j] * modes.compliance);
    }
  ModeState out;
  Eigen::VectorXd unknown;
  Eigen::FullPivLU<Eigen::MatrixXd> lu(N);
  lu.setThreshold(1e-13);  // of the largest pivot: below, it is the rounding of the Gram matrix
  if (lu.rank() == k)
    unknown = lu.solve(rhs);
  else {
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> least(k, k);
    least.setThreshold(1e-13);
    least.compute(N);
    Eigen::VectorXd close = Eigen::VectorXd::Zero(k);
    if (near)
      for (int j = 0; j < k; ++j)
        close[j] = loading.prescribed[j] ? near->resultant[j] * modes.compliance : near->motion[j];
    unknown           = close + least.solve(Eigen::VectorXd(rhs - N * close));
    out.determined    = false;
    const double size = std::max(rhs.norm(), (N * close).norm());
    out.missing       = size > 0 ? (N * unknown - rhs).norm() / size : 0;
  }
  out.motion.resize(k);
  out.resultant.resize(k);
  for (int j = 0; j < k; ++j) {
    out.motion[j]    = loading.prescribed[j] ? loading.value[j] : unknown[j];
    out.resultant[j] = loading.prescribed[j] ? unknown[j] / modes.compliance : loading.value[j];
  }
  return out;
}

Eigen::VectorXd closing(const ModeState &state, const ScaledModes &modes, const int gap)
{
  Eigen::VectorXd out           = Eigen::VectorXd::Zero(modes.rhs.cols());
  out.head(modes.k)             = state.motion;
  out.segment(modes.k, modes.k) = -state.resultant;
  out[2 * modes.k + gap]        = -1;
  return out;
}

Tangents tangents(const Eigen::MatrixXd &gram, const ScaledModes &modes)
{
  const int k       = modes.k;
  const auto [H, M] = reduced(gram, modes);
  Tangents out;
  const auto units = modes.scale.asDiagonal();
  out.stiffness    = units * Eigen::MatrixXd(M.partialPivLu().solve(H) / modes.compliance) * units;
  Eigen::FullPivLU<Eigen::MatrixXd> lu(H);
  lu.setThreshold(1e-13);
  if (k > 0 && lu.rank() == k) {
    const auto per_unit = modes.scale.cwiseInverse();
    out.compliance =
        per_unit.asDiagonal() * Eigen::MatrixXd(lu.solve(M) * modes.compliance) * per_unit.asDiagonal();
  } else
    out.compliance = Eigen::MatrixXd::Constant(k, k, std::numeric_limits<double>::infinity());
  return out;
}

std::vector<char> candidates_in_contact(const Eigen::MatrixXd &S, const Eigen::MatrixXd &rhs,
                                        const Eigen::MatrixXd &gram, const ScaledModes &modes,
                                        const Loading &loading, std::vector<char> set, const double length,
                                        const int gap)
{
  const int m = int(S.rows());
  std::set<std::vector<char>> seen;
  bool one_by_one = false;
  for (int iteration = 0; iteration < 60 + 20 * m; ++iteration) {
    std::vector<int> in;
    for (int i = 0; i < m; ++i)
      if (set[i])
        in.push_back(i);
    const int a = int(in.size());
    Eigen::MatrixXd L(a, a), X(a, rhs.cols());
    for (int j = 0; j < a; ++j) {
      for (int i = j; i < a; ++i)
        L(i, j) = S(in[i], in[j]);
      X.row(j) = rhs.row(in[j]);
    }
    Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(L);
    if (llt.info() != Eigen::Success)
      return {};
    L.triangularView<Eigen::Lower>().solveInPlace(X);
    const ModeState state   = solve_modes(gram + X.transpose() * X, modes, loading, gap);
    const Eigen::VectorXd c = closing(state, modes, gap);
    Eigen::VectorXd force   = X * c;
    L.transpose().triangularView<Eigen::Upper>().solveInPlace(force);
    Eigen::VectorXd opening = -(rhs * c);
    for (int j = 0; j < a; ++j)
      opening += force[j] * S.col(in[j]);
    if (!opening.allFinite())
      return {};
    std::vector<char> next = set;
    for (int j = 0; j < a; ++j)
      next[in[j]] = force[j] >= 0;
    for (int i = 0; i < m; ++i)
      if (!set[i])
        next[i] = opening[i] < -1e-14 * length;
    if (next == set)
      return state.missing > 1e-9 ? std::vector<char>{} : set;
    one_by_one = one_by_one || !seen.insert(set).second;
    if (one_by_one) {
      const auto first = std::mismatch(set.begin(), set.end(), next.begin());
      *first.first     = *first.second;
    } else
      set = next;
  }
  return {};
}
}  // namespace mill::contact
