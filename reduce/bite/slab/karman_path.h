#pragma once
#include "reduce/bite/slab/karman_branch.h"

// One branch of the pressure hill, integrated from its edge as far as it is asked for.
namespace mill::bite {
/// State at a place from which friction regime and flow stress stay smooth up to the next node.
struct PathNode {
  double t;          ///< -, coordinate (17.5)
  Branch<double> y;  ///< f N/m, force N/m, torque N
  std::size_t piece;
  bool at_limit;
};

/// Nodes of the adaptive integration; grows on demand.
class BranchPath {
public:
  /// @param side   +1 from the entry, -1 from the exit
  /// @param start  coordinate of the edge
  /// @param f      N/m, horizontal force there
  BranchPath(const SliceInputs<double> &inputs, int side, double start, double f, double far_end,
             double tolerance);

  Branch<double> at(double t);                 ///< state there; extends the path where needed
  Slice<double> slice_at(double t, double f);  ///< the slice of that state, in its regime
  const std::vector<PathNode> &nodes() const
  {
    return nodes_;
  }
  PathNode node_before(double t) const;  ///< last node not beyond t
  int attempts() const                   ///< steps tried so far, a measure of the cost
  {
    return n_attempts_;
  }

private:
  void extend(double target);
  PathNode step_towards(double target);
  PathNode stepped(const PathNode &from, double length, double *error = nullptr);
  double excess(const PathNode &node);
  [[noreturn]] void refuse_crawling(const PathNode &node_reached, double length) const;
  PathNode event(const PathNode &from, double length);
  bool beyond(double a, double b) const
  {
    return side_ > 0 ? a < b : a > b;
  }

  const SliceInputs<double> &in_;
  SliceEquation<double> equation_;
  int side_;
  double span_;      // of the arc, in t
  double proposed_;  // length of the next step, signed
  Branch<double> scale_;
  int n_events_   = 0;
  int n_attempts_ = 0;
  std::vector<PathNode> nodes_;
};

/// The same steps in numbers with derivatives: edge and end may depend on the inputs, the fractions between do
/// not.
/// @param end  coordinate up to which the path is repeated, at most as far as it goes
template <class T>
Branch<T> repeat(const BranchPath &path, const SliceInputs<T> &inputs, const int side, const T &start, const T &f,
                 const double end)
{
  const double edge = path.nodes().front().t;
  SliceEquation<T> equation(inputs, side);
  Branch<T> y{f, T(0.0), T(0.0)};
  const auto place = [&](const double t) {
    const double s = (t - edge) / (end - edge);
    return start + (T(end) - start) * s;
  };
  for (std::size_t i = 0; i < path.nodes().size(); ++i) {
    const PathNode &node = path.nodes()[i];
    if (side > 0 ? node.t <= end : node.t >= end)
      break;
    const bool last = i + 1 == path.nodes().size();
    const double next =
        last ? end : (side > 0 ? std::max(path.nodes()[i + 1].t, end) : std::min(path.nodes()[i + 1].t, end));
    if (next == node.t)
      continue;
    equation.piece    = node.piece;
    equation.at_limit = node.at_limit;
    const T from      = place(node.t);
    y                 = extrapolated_step(equation, from, y, T(place(next) - from));
  }
  return y;
}
}  // namespace mill::bite
