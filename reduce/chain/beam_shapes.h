#pragma once
#include "core/model/roll_geometry.h"
#include <Eigen/Core>
#include <limits>

namespace mill {
struct FourHigh;
}
namespace mill::reduce {
/// Stiffness of a beam section.
struct BeamSection {
  double bending = 0;                                        ///< N m2, E I
  double shear   = std::numeric_limits<double>::infinity();  ///< N, kappa G A; infinite: Euler beam
};

/// Of a round section.
BeamSection beam_section(const RoundSection &section, const Material &material);
BeamSection round_section(double diameter, const Material &material);  ///< the same of a solid one

/// Backup roll on its two bearing centres: barrel, two necks, load spread evenly over the middle.  theory.md 4.2
/// Half lengths from mid-span, half_load <= half_barrel <= half_span.
struct SteppedBeam {
  double half_span   = 0;  ///< m, a: to the bearing centre
  double half_barrel = 0;  ///< m, h: to the barrel end
  double half_load   = 0;  ///< m, c: to the end of the load
  BeamSection barrel, neck;
};

/// The case's backup roll, loaded over its whole barrel.
SteppedBeam backup_beam(const FourHigh &stand);

/// How much less the point x (m from mid-span, |x| <= half_span) moves than mid-span under a total load of 1 N,
/// m/N, (4.6).
double deflection_from_middle(const SteppedBeam &beam, double x);

/// Deflection under a total load of 1 N, from the bearing centres, m/N, (4.7).
double deflection(const SteppedBeam &beam, double x);

/// 1/K_ZW with the deflection at mid-span, m/N, (4.8a).
double mid_flexibility(const SteppedBeam &beam);

/// 1/K_ZW with the mean deflection under the load, m/N, (4.8b): the stiffness that belongs to the work of the
/// load.
double mean_flexibility(const SteppedBeam &beam);

/// Work roll pressed by the strip against the contact line with the backup roll: Euler beam with free ends on a
/// foundation. theory.md 4.3
struct BarrelOnFoundation {
  double half_barrel          = 0;  ///< m, h
  double half_strip           = 0;  ///< m, s; >= half_barrel: the roll sinks in evenly
  double foundation_stiffness = 0;  ///< N/m2, contact stiffness per length, K3 / barrel length
  double bending              = 0;  ///< N m2, E I of the barrel
};

/// Solution of BarrelOnFoundation: constants of (4.9) and what the necks continue with.
struct FoundationShape {
  BarrelOnFoundation roll;
  double wave_number                   = 0;                                    ///< 1/m
  Eigen::Matrix<double, 6, 1> constant = Eigen::Matrix<double, 6, 1>::Zero();  ///< m/N
  double end_deflection                = 0;                                    ///< m/N, at the barrel end
  double end_slope                     = 0;                                    ///< 1/N, there
};

/// Solves the six conditions of (4.10).  @throws InputError  foundation stiffness or a length not positive
FoundationShape foundation_shape(const BarrelOnFoundation &roll);

/// Deflection of the roll at x (m from mid-length) under a strip load of 1 N, m/N; straight beyond the barrel,
/// (4.9).
double deflection(const FoundationShape &shape, double x);
}  // namespace mill::reduce
