#pragma once
#include "fem/roll/contact_answers.h"
#include "fem/roll/contact_readings.h"
#include "fem/roll/frictional_pair.h"
#include <functional>
#include <optional>

// What one load of a contact gives beyond its stiffness, with error models: no text, no files.
namespace mill::fem {
/// Length over which the rolls touch, held as in the stand.
struct LengthAtLoad {
  Compared length;  ///< m; the mesh resolves each end of the contact to one station, the error covers it
  bool at_middle;   ///< the rolls touch at mid-length
};
LengthAtLoad contact_length(const ContactPairs &pairs, double load);

/// path_plateau() with what it is compared with.
struct PlateauAtLoad {
  PathPlateau path;
  double error;      ///< -, relative: against the companion mesh
  double coarse;     ///< N/m, of the companion mesh, scaled to the tributary length of this one
  double of_length;  ///< N/m, secant of the contact for the same length
};
/// Nothing where no station remains after trimming.
/// @param trim  share of the contact length left out at each end
std::optional<PlateauAtLoad> plateau_at(const ContactPairs &pairs, double load, double trim);

/// Joint stiffness between the axes.  theory.md (2.14)
struct JointAtLoad {
  Eigen::Matrix<double, 6, 6> value, error, coarse;  ///< N/m, N, N m; error relative, 0 where the value is 0
  double spread;    ///< N m, closed form of [3, 3]: the tangent of Hertz over the length, K L^2/12
  double sideways;  ///< N/m, closed form of [0, 0]: the geometric term of the force
  double crossing;  ///< N m, closed form of [4, 4]: the geometric term of a uniform load
  double tangent;   ///< N/m, closed form of [1, 1]: Hertz line contact
};
/// The error of each entry: two meshes, and the distance of the active set of this one load from the fit.
/// @param largest  N, no load above it is solved
JointAtLoad joint_at(const ContactPairs &pairs, double load, double largest);

/// Effect of friction on the tangent, on a mesh and in equal load steps.
enum class PairMesh { fine, coarse };
struct FrictionAtLoad {
  FrictionEffect fine;    ///< in the steps of the result
  FrictionEffect coarse;  ///< on the companion mesh, in the same steps
  FrictionEffect twice;   ///< on the companion mesh, in twice as many
  double tangent;         ///< N/m, that without friction times fine.ratio
  double error;  ///< -, relative: of the tangent without friction, of the mesh and of the load path, added
};
/// @param tangent  without friction
/// @param solve    friction_effect() of the pair on this mesh in so many steps; asked once where a pair remembers
/// @param friction -, of the contact, for the name under which a pair remembers
FrictionAtLoad friction_at(const ContactPairs &pairs, double friction, double load, int steps,
                           const Compared &tangent,
                           const std::function<FrictionEffect(PairMesh mesh, int steps)> &solve);

/// Position of the force and tilt of the axes, held as in the stand: one is imposed, the other follows.
struct OneSidedness {
  Compared tilt;           ///< rad
  Compared offset;         ///< m
  double mirrored_tilt;    ///< rad, squeezed between mirrored contacts
  double mirrored_offset;  ///< m
};
/// Nothing of a quarter.
std::optional<OneSidedness> one_sidedness(const ContactPairs &pairs, double load);

/// Largest nodal pressure of the patch, held as in the stand.
struct PeakAtLoad {
  Compared pressure;  ///< Pa
  double mirrored;    ///< Pa, squeezed between mirrored contacts
};
PeakAtLoad largest_pressure(const ContactPairs &pairs, double load);
}  // namespace mill::fem
