#include "core/model/stack_statics.h"
#include <Eigen/Dense>
#include <algorithm>

namespace mill {
namespace {
// Forces on a roll (column 0) and their moments about z = 0 (column 1), along x and y.
using Wrench = Eigen::Matrix2d;

std::vector<Wrench> applied_wrenches(const Stack &stack, const double force)
{
  std::vector<Wrench> wrenches(stack.rolls.size(), Wrench::Zero());
  for (std::size_t r = 0; r < stack.rolls.size(); ++r)
    for (const StackLoad &load : stack.rolls[r].loads) {
      const Eigen::Vector2d f(load.force[0], load.force[1]);
      wrenches[r].col(0) += f;
      wrenches[r].col(1) += f * (load.z + stack.rolls[r].shift);
    }
  for (const auto &[roll, sign] : {std::pair(stack.upper, 1.), std::pair(stack.lower, -1.)}) {
    wrenches[roll](1, 0) += sign * force;
    wrenches[roll](1, 1) += sign * force * stack.strip.offset;
  }
  return wrenches;
}
}  // namespace

std::vector<StackResultant> stack_resultants(const Stack &stack, const double force)
{
  std::vector<Wrench> wrenches = applied_wrenches(stack, force);
  std::vector<std::vector<std::size_t>> of_roll(stack.rolls.size());
  std::vector<int> open(stack.rolls.size(),
                        0);  // contacts through which a roll is loaded and that are not solved yet
  for (std::size_t c = 0; c < stack.contacts.size(); ++c) {
    of_roll[stack.contacts[c].a].push_back(c);
    ++open[stack.contacts[c].b];
  }
  std::vector<StackResultant> resultants(stack.contacts.size());
  std::vector<std::size_t> order{stack.upper, stack.lower};
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto &contacts = of_roll[order[i]];
    Eigen::Matrix2Xd directions(2, contacts.size());
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const auto &a = stack.rolls[order[i]].axis, &b = stack.rolls[stack.contacts[contacts[k]].b].axis;
      directions.col(Eigen::Index(k)) = Eigen::Vector2d(b[0] - a[0], b[1] - a[1]).normalized();
    }
    if (contacts.empty())
      continue;
    const Eigen::MatrixXd carried = directions.colPivHouseholderQr().solve(wrenches[order[i]]);
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const auto row          = Eigen::Index(k);
      const std::size_t next  = stack.contacts[contacts[k]].b;
      resultants[contacts[k]] = {carried(row, 0), carried(row, 1) / carried(row, 0)};
      wrenches[next] += directions.col(row) * carried.row(row);
      if (--open[next] == 0)
        order.push_back(next);
    }
  }
  return resultants;
}
}  // namespace mill
