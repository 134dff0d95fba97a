#pragma once
#include "core/process/progress.h"
#include "core/records/records.h"
#include "fem/contact/hertz.h"
#include "fem/contact/space_contact.h"
#include <optional>

// Numbers of a contact in space with their errors and closed forms.  theory.md 33.3, 33.4
namespace mill::contact {
/// A number by two grids.  The member that is one states its unit; NaN: it is not known.
struct SpaceNumber {
  double value  = not_given;  ///< unit of the quantity
  double coarse = not_given;  ///< the same unit, of the coarser grid
  double error  = not_given;  ///< -, relative; a number of whole cells includes one of them
  double closed =
      not_given;  ///< the same unit, of a closed form, which of a point contact is exact; NaN: none holds
};

/// How a contact is known in closed form.
enum class SpaceForm {
  point,  ///< Hertz' ellipse, which the faces do not cut
  line,   ///< as long as the faces, and longer than wide: Hertz' line and Lundberg's approach
  none
};
/// @param load  N
SpaceForm space_form(const SpaceShape &shape, double load, double tilt);

/// The closed form at one load; NaN where it does not hold.
struct ClosedSpace {
  double half_width    = not_given;  ///< m
  double peak_pressure = not_given;  ///< Pa
  double approach      = not_given;  ///< m, from the first touch of tilted faces
  double secant        = not_given;  ///< N/m
  double tangent       = not_given;  ///< N/m
};
/// @param form  at the working load; at another one the faces may cut the ellipse, or a crown leave one, and then
///              this form does not hold
ClosedSpace closed_space(const SpaceShape &shape, SpaceForm form, double load, double tilt);

struct SpaceNumbers {
  SpaceShape shape;
  SpaceForm form;
  SpaceAnswer fine, coarse;
  bool singular;                      ///< the pressure grows without limit at an end of a face
  double first_touch;                 ///< m, SpaceShape::first_touch
  double palmgren;                    ///< m, approach of one contact of a steel roller as long, (3.10)
  double hertz_width;                 ///< m, half width of the closed form of the whole face
  SpaceNumber half_width;             ///< m
  SpaceNumber peak_pressure;          ///< Pa
  SpaceNumber approach;               ///< m
  SpaceNumber tangent, secant;        ///< N/m
  SpaceNumber length;                 ///< m, that carries
  SpaceNumber line_load_ratio;        ///< -, NaN without faces, of a point contact and at a sharp end
  SpaceNumber edge_factor;            ///< -, the same; NaN where mid-length carries nothing
  std::optional<SpaceNumber> moment;  ///< N m, of the pressures about mid-length; none: symmetry leaves none
};
/// Two grids, and a second operator for the ends.
SpaceNumbers space_numbers(const TwoCylinders &pair);

/// The load-approach curve over some loads, each on a grid of its own width.
struct SpaceCurve {
  ContactCurve curve;
  Eigen::VectorXd approach, tangent;  ///< (n) m, N/m, closed_space()
};
/// @param loads  (n) N
SpaceCurve space_curve(const TwoCylinders &pair, const SpaceNumbers &numbers, const Eigen::VectorXd &loads,
                       const Progress &progress);

/// Partial slip under a tangential load, with what Mindlin's ellipse or Cattaneo's line says of equal materials.
struct SpaceSlipNumbers {
  SpaceSlip fine;
  bool coupled;                    ///< the materials are not equal: pressure and shear are not apart
  SpaceNumber stick;               ///< m, half width
  SpaceNumber displacement;        ///< m
  SpaceNumber first, tangent;      ///< N/m, of the first increment and at the tangential load
  Eigen::VectorXd pressure;        ///< (n) Pa, of each rectangle
  Eigen::VectorXd shear;           ///< (n) Pa, along the load
  Eigen::VectorXd friction_share;  ///< (n) -, of the shear that friction can carry
};
/// @param pair  with a tangential load
SpaceSlipNumbers space_slip(const TwoCylinders &pair, const SpaceNumbers &pressed);
}  // namespace mill::contact
