#pragma once
#include <Eigen/Core>
#include <vector>

namespace mill::fem {
/// Symmetric matrix of blocks on a graph, eliminated node by node without pivots: each node is definite, positive
/// or negative, once those before it are eliminated. Only blocks that fill are stored.  theory.md (51.18)
class BlockFactors {
public:
  /// The graph and who is eliminated first.
  /// @param neighbours  of each node, both ways
  /// @param positive    of each node: sign of its diagonal block when its turn comes
  /// @param order       nodes, the first one eliminated first; nodes that are not in it remain
  BlockFactors() = default;
  BlockFactors(const std::vector<std::vector<std::size_t>> &neighbours, std::vector<char> positive,
               std::vector<std::size_t> order);

  /// Blocks of these sizes; those of positive nodes and of neighbours have no value yet, all others are zero.
  void resize(const std::vector<Eigen::Index> &sizes);
  /// Block (i, j) of a node and one of its neighbours or itself, to be filled before factorise(); of two nodes
  /// that remain, afterwards what remains for them.  Of a node itself the lower triangle is read and written.
  /// `turned`: the block is that of (j, i).
  struct Block {
    Eigen::Ref<Eigen::MatrixXd> values;
    bool turned;
  };
  Block block(std::size_t i, std::size_t j);

  /// @return  the node that is not definite; nodes.size() where all are
  std::size_t factorise();

  /// One vector for each node.  From right sides to those that remain after elimination.
  void forward(std::vector<Eigen::VectorXd> &x) const;
  /// From solutions of the remaining nodes, and forward()'s vectors, to solutions.
  void backward(std::vector<Eigen::VectorXd> &x) const;

private:
  struct Node {
    std::vector<std::size_t> later;    // neighbours when its turn comes, in the order of elimination
    std::vector<char> fills;           // of each of them: it becomes one by the elimination of others
    std::vector<Eigen::Index> column;  // of each of them in `others`; then their sum
    Eigen::MatrixXd pivot, others;     // (n, n) lower; (n, sum of later): L^-1 of the block, L^-1 times the others
  };
  std::vector<Node> nodes;
  std::vector<char> is_positive;
  std::vector<std::size_t> turns, turn_of;  // turn_of a node that remains: after all others
  std::vector<Eigen::Index> size;
};
}  // namespace mill::fem
