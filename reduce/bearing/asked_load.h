#pragma once
#include "reduce/bearing/assembly.h"
#include <vector>

namespace mill::bearing {
/// What acts on the inner ring of a roller bearing.
struct AskedLoad {
  double radial             = 0;          ///< N
  double axial              = 0;          ///< N; 0: the inner ring keeps its axial place
  double tilt               = 0;          ///< rad
  double axial_displacement = not_given;  ///< m, imposed in place of an axial load
  double moment             = not_given;  ///< N m, in the plane of the load, in place of a tilt
  std::vector<double> loads;              ///< N, radial, of the curve, ascending; may be empty
};

/// The same with another radial load, N: for a sweep.
RingLoading drive_of(const AskedLoad &asked, double radial);

/// Largest load, N, that one roller may get under this radial load, generously and rounded up to a power of two
/// kN, so that neighbouring cases share a mesh.
double roller_load_bound(const RollerBearing &bearing, double radial_load, double tilt);

/// The same of all that is asked.
double largest_roller_load(const RollerBearing &bearing, const AskedLoad &asked);
}  // namespace mill::bearing
