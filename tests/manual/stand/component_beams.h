#pragma once
#include "core/model/material.h"
#include <Eigen/Core>
#include <vector>

// Timoshenko beams written here, independent of the product: references of the component cases.
namespace mill::verify {
/// Round piece of a beam that is the same on both sides of mid-length.
struct BeamPiece {
  double from, to;        ///< m, from mid-length
  double diameter;        ///< m, of its mass
  double stiff_diameter;  ///< m, of its stiffness
};

/// Pieces of a roll: barrel, neck up to the bearing centre, neck beyond.  `cone` is the tangent of the angle under
/// which stress leaves the neck into the barrel: 0 for the beam as drawn, 1 for the 45-degree rule, by which the
/// barrel outside that cone has mass but no stiffness.
std::vector<BeamPiece> roll_pieces(double barrel_diameter, double half_barrel, double neck_diameter, double seat,
                                   double end, double cone);

/// How a beam is made and held.
struct BeamSetup {
  std::vector<BeamPiece> pieces;  ///< one after the other, from 0
  double shear_factor = 0.886;
  bool rotary_inertia = true;
  double seat_centre  = 0;  ///< m; 0: free
  double seat_width = 0;  ///< m, half width of a cosine-squared window over which the seat's mean is at rest; 0: a
                          ///< point
  int per_piece = 80;     ///< elements
};

/// Half beam on nodes z: lumped masses, elements of exact static stiffness.
class SteppedTimoshenko {
public:
  SteppedTimoshenko(const BeamSetup &setup, const Material &material);
  /// (k) Hz, symmetric modes without the rigid one.
  Eigen::VectorXd frequencies(int k) const;
  /// (nodes) m/N, deflection under a total load of 1 N spread evenly over |z| <= half_load, held at the seat.
  Eigen::VectorXd deflection(double half_load) const;
  Eigen::VectorXd z;  ///< (nodes) m

private:
  BeamSetup setup;
  Eigen::MatrixXd K, M;     // half beam, without the rotation at mid-length
  Eigen::VectorXd seat;     // weights of the seat's mean on the unknowns; empty: free
  Eigen::MatrixXd allowed;  // columns: motions with the seat at rest
};

/// (k) Hz: symmetric free-free modes of a uniform round bar by the exact solution of Timoshenko's equations.
Eigen::VectorXd free_bar_frequencies(double diameter, double length, const Material &material, double shear_factor,
                                     int k);
}  // namespace mill::verify
