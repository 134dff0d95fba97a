#pragma once
#include <Eigen/Core>

namespace mill {
/// Lines of the structured mesh of half a strip, from the entry (inlet first) to the outlet, i.e. against x.
struct StripLines {
  Eigen::VectorXd inlet;   ///< (n) m, distance before the contact, falling to 0
  Eigen::VectorXd arc;     ///< (n) -, share of the arc of contact, 0 at the entry to 1
  Eigen::VectorXd outlet;  ///< (n) m, distance behind the contact, rising from 0
  Eigen::VectorXd rows;    ///< (n) -, share of half the thickness at the inlet, 0 on the mid plane to 1
};
}  // namespace mill
