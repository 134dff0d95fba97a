#include "reduce/chain/timoshenko_beam.h"
#include "core/base/errors.h"
#include "core/base/short_number.h"
#include <Eigen/Dense>
#include <cmath>

namespace mill::reduce {
namespace {
/// Stiffness of one element for deflection and rotation at its ends, (22.1): exact for any load on the ends.
Eigen::Matrix4d element_stiffness(const BeamSection &section, const double l)
{
  const double phi = 12 * section.bending / (section.shear * l * l);  // 0 for an infinite shear stiffness
  Eigen::Matrix4d k;
  k << 12, 6 * l, -12, 6 * l,                               //
      6 * l, (4 + phi) * l * l, -6 * l, (2 - phi) * l * l,  //
      -12, -6 * l, 12, -6 * l,                              //
      6 * l, (2 - phi) * l * l, -6 * l, (4 + phi) * l * l;
  return section.bending / (l * l * l * (1 + phi)) * k;
}

void require(const std::vector<BeamSpan> &spans)
{
  if (spans.empty())
    throw InputError("a beam needs at least one span");
  for (const BeamSpan &s : spans)
    if (!(s.length > 0 && s.section.bending > 0 && s.section.shear > 0 && s.mass_per_length > 0 && s.elements > 0))
      throw InputError("beam span of " + short_number(s.length) +
                       " m with E I = " + short_number(s.section.bending) + " N m2, " +
                       short_number(s.mass_per_length) + " kg/m and " + std::to_string(s.elements) +
                       " elements: length, stiffness, mass and number of elements must be positive");
}
}  // namespace

SymmetricBeam symmetric_beam(const std::vector<BeamSpan> &spans)
{
  require(spans);
  Eigen::Index nodes = 1;
  for (const BeamSpan &s : spans)
    nodes += s.elements;
  SymmetricBeam beam{Eigen::VectorXd::Zero(nodes), {}, Eigen::VectorXd::Zero(nodes)};
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * nodes, 2 * nodes);  // deflection, rotation of each node
  Eigen::Index node = 0;
  double start      = 0;
  for (const BeamSpan &s : spans) {
    const double l = s.length / s.elements;
    for (int e = 0; e < s.elements; ++e, ++node) {
      K.block<4, 4>(2 * node, 2 * node) += element_stiffness(s.section, l);
      beam.mass[node] += s.mass_per_length * l / 2;
      beam.mass[node + 1] += s.mass_per_length * l / 2;
      beam.z[node + 1] = start + (e + 1) * l;
    }
    start += s.length;
  }
  // Rotations 1.. are eliminated; that of mid-length is held by symmetry.
  const Eigen::Index m = nodes - 1;
  const auto odd = Eigen::seqN(3, m, 2), even = Eigen::seqN(0, nodes, 2);
  const Eigen::MatrixXd ww = K(even, even), tw = K(odd, even), tt = K(odd, odd);
  beam.K = 2 * (ww - tw.transpose() * tt.ldlt().solve(tw));  // both halves
  beam.K = (0.5 * (beam.K + beam.K.transpose())).eval();
  beam.mass *= 2;
  return beam;
}
}  // namespace mill::reduce
