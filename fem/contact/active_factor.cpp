#include "fem/contact/active_factor.h"
#include "core/base/errors.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace mill::contact {
namespace {
using Eigen::Lower;
using Eigen::Upper;

// Lower Cholesky factor in place; the upper triangle is left alone.
void factorise(Eigen::Ref<Eigen::MatrixXd> block)
{
  Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(block);
  if (llt.info() != Eigen::Success)
    throw SolverError({"contact: the compliance is not positive definite", "while its active part was factorised",
                       "a body that is not held, an operator that is not symmetric, or a node that occurs twice",
                       "check the condensation of the bodies", ""});
}
}  // namespace

ActiveFactor::ActiveFactor(const Eigen::MatrixXd &C, Eigen::MatrixXd rhs)
    : C_(&C), B_(std::move(rhs)), X_(C.rows(), B_.cols()), position_(C.rows(), -1)
{
}

void ActiveFactor::reserve(const int size)
{
  if (L_.rows() >= size)
    return;
  const int a        = int(order_.size());
  const int capacity = std::min(int(C_->rows()), size + size / 4 + 16);
  Eigen::MatrixXd larger(capacity, capacity);
  larger.topLeftCorner(a, a) = L_.topLeftCorner(a, a);
  L_.swap(larger);
}

// Rows from `from` on: L11 and X1 stand, L21 stands, the rest follows from C.
void ActiveFactor::rebuild(const int from)
{
  const int a = int(order_.size()), t = a - from;
  if (t == 0)
    return;
  auto L22 = L_.block(from, from, t, t);
  for (int j = 0; j < t; ++j) {
    const double *column = C_->col(order_[from + j]).data();
    for (int i = j; i < t; ++i)
      L22(i, j) = column[order_[from + i]];
  }
  auto X2 = X_.middleRows(from, t);
  for (int i = 0; i < t; ++i)
    X2.row(i) = B_.row(order_[from + i]);
  if (from > 0) {
    const auto L21 = L_.block(from, 0, t, from);
    L22.selfadjointView<Lower>().rankUpdate(L21, -1);
    X2.noalias() -= L21 * X_.topRows(from);
  }
  factorise(L22);
  L22.triangularView<Lower>().solveInPlace(X2);
}

void ActiveFactor::reset(const std::vector<int> &order)
{
  order_.clear();
  std::fill(position_.begin(), position_.end(), -1);
  reserve(int(order.size()));
  order_ = order;
  for (std::size_t i = 0; i < order_.size(); ++i)
    position_[order_[i]] = int(i);
  rebuild(0);
}

void ActiveFactor::remove(const std::vector<int> &nodes)
{
  if (nodes.empty())
    return;
  const int a = int(order_.size());
  int first   = a;
  for (const int node : nodes) {
    first           = std::min(first, position_[node]);
    position_[node] = -1;
  }
  std::vector<int> kept;  // rows that stay, behind the first that goes
  for (int i = first; i < a; ++i)
    if (position_[order_[i]] >= 0)
      kept.push_back(i);
  const int t = int(kept.size());
  for (int i = 0; i < t; ++i) {
    order_[first + i]          = order_[kept[i]];
    position_[order_[kept[i]]] = first + i;
  }
  order_.resize(first + t);
  for (int j = 0; j < first; ++j)
    for (int i = 0; i < t; ++i)
      L_(first + i, j) = L_(kept[i], j);
  // A rank-one update costs 4 t^2, the trailing block t^2 first + t^3 / 3 at some ten times the speed.
  if (40. * double(nodes.size()) > first + t / 3.) {
    rebuild(first);
    return;
  }
  // L22' L22'^T = L22 L22^T + l l^T for each column l that belongs to a row taken out: one rank-one update each.
  std::vector<int> gone;
  for (int i = first, next = 0; i < a; ++i)
    if (next < t && kept[next] == i)
      ++next;
    else
      gone.push_back(i);
  Eigen::MatrixXd l(t, gone.size());
  for (std::size_t g = 0; g < gone.size(); ++g)
    for (int i = 0; i < t; ++i)
      l(i, g) = kept[i] > gone[g] ? L_(kept[i], gone[g]) : 0.;
  for (int j = 0; j < t; ++j)
    for (int i = j; i < t; ++i)
      L_(first + i, first + j) = L_(kept[i], kept[j]);
  for (int g = 0; g < l.cols(); ++g)
    for (int j = 0; j < t; ++j) {
      if (l(j, g) == 0)
        continue;
      double &diagonal = L_(first + j, first + j);
      const double r   = std::hypot(diagonal, l(j, g));
      const double c = diagonal / r, s = l(j, g) / r;
      diagonal        = r;
      const int below = t - j - 1;
      auto column     = L_.col(first + j).segment(first + j + 1, below);
      auto rest       = l.col(g).tail(below);
      for (int i = 0; i < below; ++i) {
        const double old = column[i];
        column[i]        = c * old + s * rest[i];
        rest[i]          = c * rest[i] - s * old;
      }
    }
  auto X2 = X_.middleRows(first, t);
  for (int i = 0; i < t; ++i)
    X2.row(i) = B_.row(order_[first + i]);
  X2.noalias() -= L_.block(first, 0, t, first) * X_.topRows(first);
  L_.block(first, first, t, t).triangularView<Lower>().solveInPlace(X2);
}

Border ActiveFactor::border(const std::vector<int> &nodes) const
{
  const int a = int(order_.size()), m = int(nodes.size());
  Border out;
  out.nodes = nodes;
  out.V.resize(a, m);
  out.S.resize(m, m);
  out.rhs.resize(m, B_.cols());
  for (int j = 0; j < m; ++j) {
    const double *column = C_->col(nodes[j]).data();
    for (int i = 0; i < a; ++i)
      out.V(i, j) = column[order_[i]];
    for (int i = 0; i < m; ++i)
      out.S(i, j) = column[nodes[i]];
    out.rhs.row(j) = B_.row(nodes[j]);
  }
  if (a > 0 && m > 0) {
    L_.topLeftCorner(a, a).triangularView<Lower>().solveInPlace(out.V);
    out.S.selfadjointView<Lower>().rankUpdate(out.V.transpose(), -1);
    out.S.triangularView<Eigen::StrictlyUpper>() = out.S.transpose();
    out.rhs.noalias() -= out.V.transpose() * X_.topRows(a);
  }
  return out;
}

void ActiveFactor::append(const Border &border, const std::vector<char> &chosen)
{
  std::vector<int> pick;
  for (std::size_t j = 0; j < chosen.size(); ++j)
    if (chosen[j])
      pick.push_back(int(j));
  const int a = int(order_.size()), m = int(pick.size());
  if (m == 0)
    return;
  reserve(a + m);
  auto L22 = L_.block(a, a, m, m);
  auto X2  = X_.middleRows(a, m);
  for (int j = 0; j < m; ++j) {
    L_.block(a + j, 0, 1, a) = border.V.col(pick[j]).transpose();
    for (int i = j; i < m; ++i)
      L22(i, j) = border.S(pick[i], pick[j]);
    X2.row(j) = border.rhs.row(pick[j]);
  }
  factorise(L22);
  L22.triangularView<Lower>().solveInPlace(X2);
  for (const int j : pick) {
    position_[border.nodes[j]] = int(order_.size());
    order_.push_back(border.nodes[j]);
  }
}

void ActiveFactor::set_rhs(const int j, const Eigen::VectorXd &column)
{
  B_.col(j)   = column;
  const int a = int(order_.size());
  auto x      = X_.col(j).head(a);
  for (int i = 0; i < a; ++i)
    x[i] = column[order_[i]];
  L_.topLeftCorner(a, a).triangularView<Lower>().solveInPlace(x);
}

std::vector<char> ActiveFactor::indicator() const
{
  std::vector<char> out(position_.size());
  std::transform(position_.begin(), position_.end(), out.begin(), [](const int p) { return char(p >= 0); });
  return out;
}

Eigen::MatrixXd ActiveFactor::gram() const
{
  const auto X = X_.topRows(order_.size());
  return X.transpose() * X;
}

Eigen::MatrixXd ActiveFactor::combine(const Eigen::MatrixXd &coefficients) const
{
  const auto a        = Eigen::Index(order_.size());
  Eigen::MatrixXd out = X_.topRows(a) * coefficients;
  L_.topLeftCorner(a, a).transpose().triangularView<Upper>().solveInPlace(out);
  return out;
}

Eigen::MatrixXd ActiveFactor::solve(const Eigen::MatrixXd &values) const
{
  const auto a        = Eigen::Index(order_.size());
  Eigen::MatrixXd out = values;
  L_.topLeftCorner(a, a).triangularView<Lower>().solveInPlace(out);
  L_.topLeftCorner(a, a).transpose().triangularView<Upper>().solveInPlace(out);
  return out;
}

Eigen::MatrixXd ActiveFactor::product(const Eigen::MatrixXd &values) const
{
  // Column by column of C, which is contiguous; four at a time, so that the result is written a quarter as often.
  const int a         = int(order_.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(C_->rows(), values.cols());
  for (int p = 0; p < values.cols(); ++p) {
    auto y = out.col(p);
    int j  = 0;
    for (; j + 4 <= a; j += 4)
      y += values(j, p) * C_->col(order_[j]) + values(j + 1, p) * C_->col(order_[j + 1]) +
           values(j + 2, p) * C_->col(order_[j + 2]) + values(j + 3, p) * C_->col(order_[j + 3]);
    for (; j < a; ++j)
      y += values(j, p) * C_->col(order_[j]);
  }
  return out;
}
}  // namespace mill::contact
