#pragma once
#include "fem/strip/common/strip_nodes.h"
#include "fem/strip/rigid_plastic/strip_flow.h"
#include "reduce/bite/bite.h"
#include <array>
#include <vector>

// Mesh lines, unknowns and shape functions of the rolled strip.  theory.md 18
namespace mill::fem {
/// Unknowns that belong to the whole bite.
enum class Whole {
  entry,     ///< abscissa where the contact begins
  exit,      ///< where it ends
  radius,    ///< of the circle of the roll
  offset,    ///< of the roll from where the exit thickness would put it
  friction,  ///< coefficient, or addition to both factors
  tension    ///< at the exit
};
constexpr int n_whole = 6;

/// Q2 velocity, Q1 pressure.
/// Columns of the equations: the unknowns, then the bite::n_inputs inputs by which they are differentiated.
struct StripGrid : StripNodes {
  StripLines lines;         ///< distances over the length scale
  int first = 0, last = 0;  ///< spines where contact begins and ends
  std::vector<int> pressure_of, strain_of, contact_of;
  std::vector<char> held;  ///< (unknowns) 1: velocity that is zero
  /// Abscissa of corner spine I: spine[I][0] entry + spine[I][1] exit + spine[I][2].
  std::vector<std::array<double, 3>> spine;

  int pressure(const int I, const int J) const
  {
    return pressure_of[I * (n_through + 1) + J];
  }
  /// Strain where Gauss row k of element row J crosses corner spine I.
  int strain(const int I, const int J, const int k) const
  {
    return strain_of[3 * (I * n_through + J) + k];
  }
  /// Pressure of the roll on spine i; -1 outside the contact.
  int contact(const int i) const
  {
    return contact_of[i];
  }
  int whole(const Whole which) const
  {
    return n_unknowns - n_whole + int(which);
  }
  int input(const bite::Input which) const
  {
    return n_unknowns + int(which);
  }
};
/// Numbers the unknowns, along the strip.
StripGrid strip_grid(const StripLines &lines);

/// Every second line; false if a count is odd or the result coarser than 12 x 3 on the arc.
bool coarsened(StripLines &lines);

/// Unknowns of another grid interpolated at this one: same shares of inlet, arc, outlet and thickness.
Eigen::VectorXd interpolated(const StripGrid &from, const Eigen::VectorXd &unknowns, const StripGrid &to);

/// Directions of the rate of deformation and of the slip as Newton's method last predicted them, (18.14): with
/// them in the tangent it converges where strain rate and slip are regularised over next to nothing.  A norm of
/// zero: the direction is the prediction, that of another grid.
struct StripDirections {
  Eigen::MatrixXd bulk;  ///< (7, points) rate xx, yy, xy, its regularised norm, directions xx, yy, xy
  Eigen::MatrixXd slip;  ///< (3, contact spines) slip, its regularised norm, direction
};
/// Those of another grid interpolated at this one, as predictions.
StripDirections interpolated(const StripGrid &from, const StripDirections &directions, const StripGrid &to);

/// Shape functions of the square at 3 x 3 Gauss points, node and point (a, b) at 3 a + b, a along; corners at
/// 2 a + b.
struct StripShapes {
  Eigen::Matrix<double, 9, 9> value, along, through;  ///< (point, node) and derivatives
  Eigen::Matrix<double, 9, 4> corner;                 ///< (point, corner)
  Eigen::Matrix3d gathered;       ///< (k, l) integral of Lagrange polynomial l from -1 to point k
  Eigen::Vector3d point, weight;  ///< of one direction
};
const StripShapes &strip_shapes();

}  // namespace mill::fem
