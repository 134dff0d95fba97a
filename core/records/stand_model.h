#pragma once
#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

namespace mill {
/// A spring, or a line of springs, between parts of a stand or to the ground: strain = rows * y, energy
/// sum_r stiffness_r (rows_r y)^2 / 2.
struct Connection {
  std::string name;           ///< "K3", "K_Zy upper", "oil column"
  Eigen::MatrixXd rows;       ///< (r, n) -, strain of each spring per displacement
  Eigen::VectorXd stiffness;  ///< (r) N/m
  double error_estimate = std::numeric_limits<double>::quiet_NaN();  ///< -, of all its stiffness; NaN: not known
  double damper         = 0;  ///< N s/m, in parallel with each of its springs
};

/// A place of the stand that is looked at.
struct StandPoint {
  std::string name;     ///< "upper work roll"
  Eigen::VectorXd row;  ///< (n) its displacement is row . y
};

/// The axis of a roll, or another line that is drawn.
struct StandLine {
  std::string name;      ///< "upper work roll"
  Eigen::VectorXd z;     ///< (k) m, from mid-length outwards
  Eigen::MatrixXd rows;  ///< (k, n)
};

/// A mass that moves rigidly with a place of another part and is counted in it: a chock carried by the neck of its
/// roll.
struct CarriedMass {
  std::string name;     ///< "upper work-roll chock"
  std::string carrier;  ///< part whose mass holds it, "upper work roll"
  Eigen::VectorXd row;  ///< (n) its displacement is row . y
  double mass = 0;      ///< kg, whole stand
};

/// What one unknown of a stand is.
struct StandUnknown {
  std::string what = "displacement";  ///< "node", "barrel P2", "seat", "fixed-interface mode 1"
  double position  = std::numeric_limits<double>::quiet_NaN();  ///< m, along the roll from mid-length; NaN: none
  std::string unit = "m";                                       ///< "kg^0.5 m" of a mass-normalised mode
  bool operator==(const StandUnknown &other) const
  {
    return what == other.what && unit == other.unit &&
           (position == other.position || (position != position && other.position != other.position));
  }
};

/// A stand of any number of unknowns, whole stand (both sides), vertical motion, the same on both sides of
/// mid-length:  M y'' + K y = b F,  y up, F pushes the work rolls apart.  theory.md 22
struct StandModel {
  std::string name;                     ///< "six-mass", "beam", "craig-bampton"
  Eigen::MatrixXd M;                    ///< (n, n) kg, positive definite
  Eigen::MatrixXd K_parts;              ///< (n, n) N/m, of the parts themselves, without the connections
  std::vector<Connection> connections;  ///< everything that joins parts or holds them to the ground
  Eigen::VectorXd b;                    ///< (n) -, force on each unknown per unit of bite force
  std::vector<std::string> parts;       ///< (p) "upper frame", "upper backup roll", ...
  std::vector<StandUnknown> unknowns;   ///< (n)
  std::vector<int> part_of;  ///< (n) part each unknown belongs to; M and K_parts couple within parts only
  /// The first six are the places of M1..M6: upper frame, upper backup roll, upper work roll, lower work roll,
  /// lower backup roll, lower frame (rolls at mid-length).  Others follow: "upper work-roll chock", ...
  std::vector<StandPoint> points;
  std::vector<StandLine> lines;
  std::vector<CarriedMass> carried;
  Eigen::VectorXd load_cell;   ///< (n) N/m, change of the load-cell force = load_cell . y
  double load_cell_share = 1;  ///< -, part of the mean bite force that the load cell shows
  /// (n, n) kg s2 or empty: what modes left out of the parts contribute (Component::residual, assembled).
  Eigen::MatrixXd residual;
};

/// (m + m') / 2, symmetric to the last digit.
Eigen::MatrixXd symmetric_part(const Eigen::MatrixXd &m);

/// (n, n) N/m: K_parts and all connections.
Eigen::MatrixXd stiffness_of(const StandModel &stand);

/// (n, n) N s/m: dampers of all connections.
Eigen::MatrixXd dampers_of(const StandModel &stand);
}  // namespace mill
