#pragma once
#include "fem/contact/active_set.h"
#include "fem/contact/half_space.h"
#include <functional>
#include <vector>

// Normal contact of two bodies as half spaces by boundary elements.  theory.md 10
namespace mill::contact {
/// Gap of the undeformed bodies, m, at (x, z), m; infinite outside the body.
using GapShape = std::function<double(double x, double z)>;

/// Rectangles on one quarter, x and z >= 0, of a contact symmetric about x = 0 and z = 0; or on the half x >= 0 of
/// one that is symmetric about x = 0 alone.  Along x all are equally wide.
struct QuarterGrid {
  double width = 0;    ///< m, of a rectangle
  int n_x      = 0;    ///< columns; n_x width must be wider than the contact, or be where the body ends
  Eigen::VectorXd z;   ///< (n_z + 1) m, edges of the rows, ascending from 0; a body that ends, ends at the last
  bool half = false;   ///< z over both sides, its first edge below 0
  int mirrors() const  ///< how often the grid stands in the contact
  {
    return half ? 2 : 4;
  }
};

/// Edges from 0 to `length` (m): steps `at_end` (m) at the end, growing by the factor `growth` towards the middle
/// up to `at_middle` (m).
/// @throws InputError  a length not positive, growth < 1
Eigen::VectorXd graded_edges(double length, double at_middle, double at_end, double growth);

/// Semi-ellipse p^2 = peak^2 (1 - x^2 / half_width^2) through pressures; theory.md (1.4)
struct PressureFit {
  double half_width;  ///< m
  double peak;        ///< Pa
};

/// Least squares through (x, m; p, Pa, descending), without the outermost, whose rectangle the contact may cover
/// partly. NaN with fewer than four values, or if they do not fall.
PressureFit fit_pressure(const std::vector<double> &x, const std::vector<double> &p);

/// A loaded contact.  Loads are those of the whole contact.
struct HalfSpaceState {
  double load        = 0;  ///< N
  double moment      = 0;  ///< N m, of the pressures about z = 0
  double approach    = 0;  ///< m, of points far away, where a half space does not move
  double set_tangent = 0;  ///< N/m, d(load) / d(approach), touching set held; steps with each rectangle that joins
  Eigen::MatrixXd pressure;    ///< (n_x, n_z) Pa, mean over each rectangle
  Eigen::VectorXd z;           ///< (n_z) m, middle of each row
  Eigen::VectorXd line_load;   ///< (n_z) N/m, over the whole width
  Eigen::VectorXd half_width;  ///< (n_z) m, by fit_pressure; NaN where too few rectangles touch
  Eigen::VectorXd
      peak_pressure;         ///< (n_z) Pa, by fit_pressure; of the first rectangle where a fit is not possible
  bool reaches_end = false;  ///< the row at an end of z is loaded
  int n_unknowns   = 0;      ///< rectangles of the grid
  int iterations   = 0;      ///< of the active set
  double residual  = 0;      ///< -, largest violation of the contact conditions, relative
};

/// The dense operator of one grid; solves for any number of loads and profiles.
/// Pressures are constant on each rectangle and the conditions hold for the mean gap of each, so the operator is
/// symmetric and positive definite on any grid.  Cost: (n_x n_z)^2 numbers; 0.1 s to fill and 0.1 s to solve for
/// 1000 rectangles.
class HalfSpaceContact {
public:
  /// @throws InputError  an empty grid, edges that do not ascend from 0, no rectangle with a finite gap
  HalfSpaceContact(const HalfSpaces &bodies, const QuarterGrid &grid, const GapShape &gap);

  /// @throws InputError  load not positive
  /// @throws SolverError the contact reaches the side of the grid although the body goes on there
  HalfSpaceState at_load(double load);

  /// d(load) / d(approach), N/m, at a load (N): slope of the parabola through ln(approach) over ln(load) at nine
  /// loads within 20 %, which is free of the steps of set_tangent.  Cost: eight warm solves more.
  double tangent(double load);

private:
  QuarterGrid grid;
  bool goes_on;                // there is body beyond the last column
  std::vector<int> rectangle;  // of each unknown, x fastest
  ActiveSet solver;            // begins with what touched at the last load
};

/// Slope of a smooth curve of the approach (m) over the load (N, or N/m per length) at one load, that of the
/// parabola through ln(approach) over ln(load) at nine loads within 20 %.
double smooth_tangent(double load, const std::function<double(double)> &approach);

/// Whether the pressure at the end of the body grows without limit as the grid is refined, so that its largest
/// value is the grid's and not the body's.  True when an outermost row is loaded and the largest pressure grows
/// at least like the power -1/5 of the length of that row, found by cutting the row to a quarter; a flat end on a
/// half space has the power -1/2, a profile that ends the contact softly 0.  Cost: a second operator and solution.
bool has_singular_end(const HalfSpaces &bodies, const QuarterGrid &grid, const GapShape &gap, double load);
}  // namespace mill::contact
