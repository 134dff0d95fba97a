#include "reduce/bite/slab/path_stiffness.h"
#include "core/base/errors.h"
#include <cmath>
#include <sstream>

namespace mill::bite {
namespace {
using Eigen::Index;
using Eigen::VectorXd;

template <class... T> [[noreturn]] void refuse(const T &...text)
{
  std::ostringstream out;
  out << "stiffness along the contact path: ";
  (out << ... << text);
  throw InputError(out.str());
}

// Length of the arc that belongs to node i: half the way to each neighbour.
double share(const VectorXd &x, const Index i)
{
  const double left = i > 0 ? x[i] - x[i - 1] : 0, right = i + 1 < x.size() ? x[i + 1] - x[i] : 0;
  return 0.5 * (left + right);
}
}  // namespace

PathStiffness path_stiffness(const VectorXd &position, const VectorXd &pressure, const VectorXd &displacement,
                             const double width, const double trim)
{
  const Index n = position.size();
  if (pressure.size() != n || displacement.size() != n)
    refuse(n, " positions, ", pressure.size(), " pressures and ", displacement.size(), " displacements");
  if (!(trim >= 0 && trim < 0.5))
    refuse("a share of ", trim, " cannot be left out at each end; between 0 and 0.5");
  for (Index i = 1; i < n; ++i)
    if (!(position[i] > position[i - 1]))
      refuse("the nodes must rise, number ", i + 1, " does not");
  Index first = 0, last = n - 1;
  while (first < n && !(pressure[first] > 0))
    ++first;
  while (last > first && !(pressure[last] > 0))
    --last;
  PathStiffness out;
  out.nodes = first < n ? int(last - first + 1) : 0;
  if (out.nodes < 3)
    refuse(out.nodes, " nodes with pressure; at least three are needed");
  out.nodal.resize(out.nodes);
  double force = 0, mean = 0;
  for (Index i = first; i <= last; ++i) {
    const double f = pressure[i] * width * share(position, i);
    if (!(displacement[i] > 0))
      refuse("the roll does not deflect at x = ", 1e3 * position[i], " mm (", 1e6 * displacement[i],
             " um) though it is pressed");
    out.nodal[i - first] = f / displacement[i];
    force += f;
    mean += displacement[i] / out.nodes;
  }
  const int left_out = int(std::floor(trim * out.nodes));
  out.averaged       = out.nodes - 2 * left_out;
  if (out.averaged < 1)
    refuse("nothing is left of ", out.nodes, " nodes without ", left_out, " at each end");
  const auto kept = out.nodal.segment(left_out, out.averaged);
  out.plateau     = kept.mean();
  out.smallest    = kept.minCoeff();
  out.largest     = kept.maxCoeff();
  out.sum         = force / mean;
  return out;
}
}  // namespace mill::bite
