#pragma once
#include "fem/strip/common/strip_material.h"
#include "fem/strip/common/strip_nodes.h"
#include "fem/strip/elastic_plastic/strip_elastic.h"
#include <array>
#include <vector>

// Mesh lines and unknowns of the elastic-plastic strip.  theory.md 19.3
namespace mill::fem {
/// Unknowns of the whole bite.  What the pass is given is among them, each with the equation "is what was given":
/// so the same factorisation yields the derivatives by all inputs.
enum class Bulk {
  entry_speed,
  exit_speed,
  roll_height,  ///< of the lowest point of the roll's circle over the mid plane
  entry_thickness,
  exit_thickness,
  entry_tension,
  exit_tension,
  friction,  ///< coefficient, or addition to both factors
  stress_factor,
  radius,
  inlet_xx,  ///< deviatoric stress at the inlet
  inlet_yy,
  inlet_pressure,
  inlet_strain,
  entry_end,  ///< abscissa where the contact begins, and
  exit_end    ///< where it ends, once the mesh moves with it
};
constexpr int n_bulk = 16;

/// Q2 velocity, linear pressure in each element (not continuous),
/// rows of elements with straight ends whose upper lines are streamlines; stress and strain where three Gauss rows
/// of every element cross its downstream face.  Abscissae are scaled and run along the strip, 0 on the line of
/// centres.
struct ElasticGrid : StripNodes {
  Eigen::VectorXd x;            ///< (2 n_along + 1) -
  Eigen::VectorXd tributary;    ///< (2 n_along + 1) -, Simpson weight of a spine in an integral along the surface
  std::vector<char> may_touch;  ///< (2 n_along + 1) roll and strip are tried for contact there
  std::vector<int> pressure_of, state_of, force_of;

  int pressure(const int I, const int J, const int m) const
  {
    return pressure_of[3 * (I * n_through + J) + m];
  }
  /// Stress xx yy xy and strain (s = 0 .. 3) of Gauss row r behind element (I, J).
  int state(const int I, const int J, const int r, const int s) const
  {
    return state_of[4 * (3 * (I * n_through + J) + r) + s];
  }
  int force(const int i) const
  {
    return force_of[i];
  }
  /// Spines that lead the others, -1: all stay.  Inlet and outlet move with them, the lines between keep their
  /// shares. They are led by the contact, where pressure and gap vanish together, or (rigid roll) the first by the
  /// place where circle and strip would meet, `entry_ratio` of the geometric arc from the line of centres; the
  /// other stays.
  int entry_spine = -1, exit_spine = -1;
  bool ends_of_contact = false;
  double entry_ratio   = 1;  ///< -
  bool moves() const
  {
    return entry_spine >= 0;
  }
  /// Derivatives of the abscissa of a spine by those of the ends of the contact.
  std::array<double, 2> share(const int i) const
  {
    if (!moves())
      return {0, 0};
    if (i <= entry_spine)
      return {1, 0};
    if (i >= exit_spine)
      return {0, 1};
    const double t = (x[i] - x[entry_spine]) / (x[exit_spine] - x[entry_spine]);
    return {1 - t, t};
  }
  int bulk(const Bulk which) const
  {
    return n_unknowns - n_bulk + int(which);
  }
};
/// @param corners    rising abscissae of the spines between elements
/// @param from, to   abscissae between which there may be contact
ElasticGrid elastic_grid(const std::vector<double> &corners, int n_through, double from, double to);

/// Length of the contact over that of the grid as it was made.
double stretch(const ElasticGrid &grid, const Eigen::VectorXd &unknowns);
/// The grid with its lines where the unknowns put them.
ElasticGrid moved(const ElasticGrid &grid, const Eigen::VectorXd &unknowns);

/// Where the elements shall be small.
struct ElasticFocus {
  double from = 0, to = 0;  ///< -
  double size = 0;          ///< -
};
/// Abscissae whose spacing is `size` between from and to, grows by a fifth of the distance from the foci, and by
/// 0.3 of the distance outside up to a quarter of the entry thickness.
/// @param fixed  (n >= 2) rising: inlet, places that become lines, outlet
std::vector<double> elastic_lines(const std::vector<double> &fixed, double from, double to, double size,
                                  const std::vector<ElasticFocus> &foci);

/// Unknowns of a state on another grid, by interpolation along and through the strip.
Eigen::VectorXd interpolated(const ElasticGrid &from, const Eigen::VectorXd &unknowns, const ElasticGrid &to);

/// Spine where the touching strip is thinnest; `before` is taken where no other is thinner, 0: none yet.
int thinnest_spine(const ElasticGrid &grid, const Eigen::VectorXd &unknowns, int before);

/// The same polynomials at 0, 1/2, 1.
inline double along_shape(const double t, const int a)
{
  return quadratic(2 * t - 1, a);
}
inline double along_slope(const double t, const int a)
{
  return 2 * quadratic_slope(2 * t - 1, a);
}
/// Three-point Gauss rule on 0 .. 1.
struct GaussRows {
  std::array<double, 3> point, weight;
};
const GaussRows &gauss_rows();
}  // namespace mill::fem
