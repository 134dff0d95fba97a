#include "fem/stack/block_factors.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <set>

namespace mill::fem {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
constexpr double singular = 1e-7;  // smallest over largest entry of the diagonal of a factor
}  // namespace

BlockFactors::BlockFactors(const std::vector<std::vector<std::size_t>> &neighbours, std::vector<char> positive,
                           std::vector<std::size_t> order)
    : nodes(neighbours.size()), is_positive(std::move(positive)), turns(std::move(order)),
      turn_of(neighbours.size())
{
  std::size_t next = turns.size();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto turn = std::find(turns.begin(), turns.end(), i);
    turn_of[i]      = turn == turns.end() ? next++ : std::size_t(turn - turns.begin());
  }
  std::vector<std::set<std::size_t>> graph;
  for (const auto &list : neighbours)
    graph.emplace_back(list.begin(), list.end());
  const auto in_turn = [&](const std::size_t a, const std::size_t b) { return turn_of[a] < turn_of[b]; };
  std::vector<std::size_t> all(nodes.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = i;
  std::sort(all.begin(), all.end(), in_turn);
  for (const std::size_t i : all) {
    Node &node = nodes[i];
    for (const std::size_t j : graph[i])
      if (j != i && in_turn(i, j))
        node.later.push_back(j);
    std::sort(node.later.begin(), node.later.end(), in_turn);
    for (const std::size_t j : node.later)
      node.fills.push_back(std::find(neighbours[i].begin(), neighbours[i].end(), j) == neighbours[i].end());
    if (turn_of[i] < turns.size())  // all that are left become neighbours
      for (const std::size_t j : node.later)
        for (const std::size_t k : node.later)
          graph[j].insert(k);
  }
}

void BlockFactors::resize(const std::vector<Index> &sizes)
{
  size = sizes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Node &node = nodes[i];
    node.pivot.resize(size[i], size[i]);
    if (!is_positive[i] || turn_of[i] >= turns.size())
      node.pivot.setZero();
    node.column.assign(1, 0);
    for (const std::size_t j : node.later)
      node.column.push_back(node.column.back() + size[j]);
    node.others.resize(size[i], node.column.back());
    for (std::size_t a = 0; a < node.later.size(); ++a)
      if (node.fills[a])
        node.others.middleCols(node.column[a], size[node.later[a]]).setZero();
  }
}

BlockFactors::Block BlockFactors::block(const std::size_t i, const std::size_t j)
{
  if (i == j)
    return {nodes[i].pivot, false};
  const bool turned    = turn_of[i] > turn_of[j];
  Node &node           = nodes[turned ? j : i];
  const auto neighbour = std::find(node.later.begin(), node.later.end(), turned ? i : j);
  const auto place     = std::size_t(neighbour - node.later.begin());
  return {node.others.middleCols(node.column[place], node.column[place + 1] - node.column[place]), turned};
}

std::size_t BlockFactors::factorise()
{
  for (const std::size_t i : turns) {
    Node &node = nodes[i];
    if (size[i] == 0)
      continue;
    if (!is_positive[i])
      node.pivot = -node.pivot;
    Eigen::LLT<Eigen::Ref<MatrixXd>> factor(node.pivot);
    const auto diagonal = node.pivot.diagonal().array();
    if (factor.info() != Eigen::Success || !(diagonal.minCoeff() > singular * diagonal.maxCoeff()))
      return i;
    // Products are quicker than solutions, and the other side has several times as many columns.
    MatrixXd inverse = MatrixXd::Identity(size[i], size[i]);
    node.pivot.triangularView<Eigen::Lower>().solveInPlace(inverse);
    node.pivot  = inverse.triangularView<Eigen::Lower>();
    node.others = node.pivot.triangularView<Eigen::Lower>() * node.others;
    MatrixXd update(node.others.cols(), node.others.cols());
    update.triangularView<Eigen::Lower>() = (is_positive[i] ? -1 : 1) * node.others.transpose() * node.others;
    for (std::size_t a = 0; a < node.later.size(); ++a)
      for (std::size_t b = a; b < node.later.size(); ++b) {
        const Index m = size[node.later[a]], n = size[node.later[b]];
        if (m == 0 || n == 0)
          continue;
        const auto part = update.block(node.column[b], node.column[a], n, m);  // of the lower triangle
        if (a == b)
          nodes[node.later[a]].pivot.triangularView<Eigen::Lower>() += part;
        else
          block(node.later[a], node.later[b]).values += part.transpose();
      }
  }
  return nodes.size();
}

void BlockFactors::forward(std::vector<VectorXd> &x) const
{
  for (const std::size_t i : turns) {
    const Node &node = nodes[i];
    if (size[i] == 0)
      continue;
    x[i] = node.pivot.triangularView<Eigen::Lower>() * x[i];
    for (std::size_t a = 0; a < node.later.size(); ++a)
      if (const std::size_t j = node.later[a]; size[j] > 0)
        x[j].noalias() -=
            (is_positive[i] ? 1 : -1) * (node.others.middleCols(node.column[a], size[j]).transpose() * x[i]);
  }
}

void BlockFactors::backward(std::vector<VectorXd> &x) const
{
  for (auto turn = turns.rbegin(); turn != turns.rend(); ++turn) {
    const Node &node = nodes[*turn];
    if (size[*turn] == 0)
      continue;
    for (std::size_t a = 0; a < node.later.size(); ++a)
      if (const std::size_t j = node.later[a]; size[j] > 0)
        x[*turn].noalias() -= node.others.middleCols(node.column[a], size[j]) * x[j];
    x[*turn] = node.pivot.triangularView<Eigen::Lower>().transpose() * x[*turn];
    if (!is_positive[*turn])
      x[*turn] = -x[*turn];
  }
}
}  // namespace mill::fem
