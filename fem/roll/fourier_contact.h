#pragma once
#include "core/process/progress.h"
#include "core/records/records.h"
#include "fem/roll/fourier_roll.h"
#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

namespace mill::fem {
/// What balances the contact force on a roll.  theory.md 11
enum class RollSupport {
  mirror,  ///< the same contact on the opposite generator; the axis stays where it is
  necks,   ///< the bearing seats
  strip    ///< a line load on the opposite generator, uniform over the strip width, linear if there is a moment
};

struct FourierSupport {
  RollSupport kind   = RollSupport::mirror;
  double strip_width = 0;  ///< m, of RollSupport::strip
};

/// One roll of a pair, on the N stations of the contact.
struct FourierSide {
  double radius     = 0;                 ///< m
  double half_width = 0;                 ///< m, contact that the series was made for
  bool mirrored     = false;             ///< even harmonics only, doubled
  std::vector<int> order;                ///< computed harmonics
  std::vector<Eigen::MatrixXd> surface;  ///< (N, N) m/N each
  Eigen::MatrixXd support;               ///< (N, k) of the surface under what balances a unit of each resultant
  Eigen::MatrixXd axis;                  ///< (N, N) m/N, of the axis, away from the contact
  Eigen::MatrixXd axis_support;          ///< (N, k)
};

/// Two rolls along one contact line.  Only the side z >= 0 with one resultant, the force on it, when the loads are
/// the same on both sides; both sides with two resultants, the force and its moment about mid-length, otherwise.
struct FourierPair {
  std::string name;            ///< "upper", "lower"
  std::string reference;       ///< datum of the approach, one sentence
  bool whole = false;          ///< both sides
  Eigen::VectorXd z, length;   ///< (N) m, centres and lengths of the stations
  Eigen::VectorXd drop;        ///< (N) m, sum of the two profiles at the centres, smallest zero
  Eigen::MatrixXd closing;     ///< (N, k) closing of the gap per unit of approach (1) and tilt (m)
  Eigen::MatrixXd mean;        ///< (N, k) weights of the mean and of the mean slope over the contact length
  double reduced_modulus = 0;  ///< Pa, 1/E* = sum of (1 - nu^2)/E
  double reduced_radius  = 0;  ///< m, 1/R = 1/R1 + 1/R2
  FourierSide first, second;
};

/// Puts a pair together.
/// @param drop  m, radial drop of both profiles at the station centres: (n) for z > 0, the pair is symmetric; or
/// (2n)
///              from negative to positive z, the pair is whole and both rolls need both sides
/// @throws std::logic_error  different stations, or a whole pair of rolls with one side
FourierPair fourier_pair(const std::string &name, const FourierRoll &first, const FourierSupport &first_support,
                         const FourierRoll &second, const FourierSupport &second_support,
                         const Eigen::VectorXd &drop);

/// What is imposed on a whole pair besides the force.
struct FourierDrive {
  double tilt        = 0;                                         ///< rad, of the axes, closing at z > 0
  double load_offset = std::numeric_limits<double>::quiet_NaN();  ///< m, where the force stands; replaces tilt
};

/// One solved load.
struct FourierPoint {
  double load     = 0;                                ///< N, total
  double approach = 0;                                ///< m, axis to axis, mean over the contact length
  double tangent  = 0;                                ///< N/m, dF/d(approach) with what else is imposed held
  double tilt     = 0;                                ///< rad, of the axes, closing at z > 0
  double moment   = 0;                                ///< N m, of the contact force about mid-length
  Eigen::VectorXd line_load;                          ///< (N) N/m, mean over each station, >= 0
  Eigen::VectorXd half_width;                         ///< (N) m, 0 where nothing touches
  Eigen::VectorXd station_approach, station_tangent;  ///< (N) m; N/m2: axis to axis at the stations, (2.9)
  int iterations  = 0;                                ///< Newton steps
  double residual = 0;  ///< -, largest gap where the rolls touch, or penetration elsewhere, over the approach
};

/// Solves for an imposed force: pressure of every station a semi-ellipse of the half width that belongs to its
/// line load, gap closed in the mean over that ellipse.  Newton's method on the contacting stations.
/// @param start  line loads to begin with, empty: none known
/// @throws SolverError  no convergence; @throws InputError  load not positive
/// Cost: some ms per step for 50 stations.  theory.md 11
FourierPoint solve_load(const FourierPair &pair, double load, const FourierDrive &loading = {},
                        const Eigen::VectorXd &start = {});

/// Load-approach curve, loads (n) N increasing; half width and peak pressure at mid-length.
ContactCurve sweep(const FourierPair &pair, const Eigen::VectorXd &loads, const FourierDrive &loading = {},
                   const Progress &progress = {});

/// Distribution along the stations.
BarrelProfile barrel_profile(const FourierPair &pair, const FourierPoint &point);
}  // namespace mill::fem
