#pragma once
#include "fem/contact/partial_slip.h"
#include "fem/contact/two_bodies.h"

// One contact in space solved on a grid that suits it.  theory.md 33.3
namespace mill::contact {
struct SpaceAnswer {
  HalfSpaceState state;
  QuarterGrid grid;
  double tangent       = 0;      ///< N/m
  int row              = 0;      ///< next to mid-length; of a point contact that with the largest line load
  double half_width    = 0;      ///< m, there; mean of both rows at mid-length where none lies on it
  double peak_pressure = 0;      ///< Pa, there; NaN: nothing is carried there
  double length        = 0;      ///< m, of what carries
  double length_step   = 0;      ///< m, rows at which it ends short of a face, where it is of whole rows; else 0
  bool cut             = false;  ///< the contact reaches an end of the faces
};

/// Rows of the grid along a relieved face.
enum class SpaceRows {
  graded,   ///< shortest at the ends of the face: for the approach and for values at mid-length
  refined,  ///< and finer where the line load bends: for the largest line load and the largest pressure
};

/// @param rectangles  over the half width
/// @throws SolverError  the contact is wider than any grid tried
SpaceAnswer solve_in_space(const SpaceShape &shape, double load, double tilt, int rectangles, SpaceRows rows);

/// Does the pressure grow without limit at an end of the faces?
bool singular_end(const SpaceShape &shape, const SpaceAnswer &answer, double tilt);

struct SpaceSlip {
  double stick_half_width;  ///< m, at the row of the scalar results
  double stick_step = 0;    ///< m, what one stuck rectangle more adds to it; 0: it is not of whole ones
  double displacement;      ///< m
  double first_stiffness;   ///< N/m, of the first increment
  double tangent;           ///< N/m, at the tangential load
  RectangleContact contact;
  FrictionState state;
};
/// @param cells  over each side of the contact, of a quarter
SpaceSlip slip_in_space(const SpaceShape &shape, const SpaceContactSettings &settings, const SpaceAnswer &pressed,
                        int cells);
}  // namespace mill::contact
