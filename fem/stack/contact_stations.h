#pragma once
#include "core/model/stack.h"
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <vector>

namespace mill::fem {
/// Stations of a line of contact: the load is constant in each, mill frame.
struct ContactStations {
  Eigen::VectorXd from, to;  ///< (N) m
  Eigen::Index size() const
  {
    return from.size();
  }
  Eigen::VectorXd centre() const
  {
    return (from + to) / 2;
  }
  Eigen::VectorXd length() const
  {
    return to - from;
  }
};

/// In each zone, no longer than `longest` (m); half as long at the ends of the zone and at the edges of the strip.
ContactStations stations_in(const std::vector<std::array<double, 2>> &zones, const StackStrip &strip,
                            double longest);

/// (M, N): the force on each station of a roll by 1 N on each station of a contact, spread by their common length;
/// transposed, the mean displacement of a contact's station.  Force and moment of each column are exact.
/// theory.md (51.14)
/// @param edge   (M + 1) m, of the roll, its own frame
/// @param shift  m, of the roll
Eigen::SparseMatrix<double> spread_on_roll(const ContactStations &stations, const Eigen::VectorXd &edge,
                                           double shift);
}  // namespace mill::fem
