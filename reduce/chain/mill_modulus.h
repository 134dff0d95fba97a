#pragma once
#include "core/model/dynamics_settings.h"
#include "reduce/chain/roll_shapes.h"
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

// Stretch of a stand under the rolling force, and how the thickness of the strip follows the screw and the pass.
// theory.md 30
namespace mill::reduce {
/// A spring on the path of the rolling force, whole stand.
struct PathPart {
  std::string name;                      ///< "K3", "K4.flattening"
  double tangent = 0;                    ///< N/m, at the rolling force
  double secant  = 0;                    ///< N/m, from zero force to the rolling force
  double error   = not_given;            ///< -, relative, of the tangent; NaN: not stated
  std::vector<std::string> error_lacks;  ///< what would say it; empty: the part itself
};

/// Springs of a path in series.
struct MillModulus {
  double tangent = 0;              ///< N/m, (30.1)
  double secant  = 0;              ///< N/m, (30.2)
  double error   = 0;              ///< -, relative, of the tangent, (30.5); NaN: not known
  std::vector<std::string> lacks;  ///< why no error is known
  std::string softest;             ///< the part that deflects most
  double softest_tangent = 0;      ///< N/m, of it
};

/// @throws InputError  a part without positive stiffness, named
MillModulus mill_modulus(const std::vector<PathPart> &path);

/// dM/db, N/m per m of the strip's width b at the same force and arc, (30.10).
/// @param flattening  N/m, both work rolls at the strip; @param bending_slope  1/N, d(1/K_b)/db of both
double modulus_by_width(double modulus, double flattening, double width, double bending_slope);

/// Usual mill moduli, N/m: from soft four-highs to stiff plate mills.
inline constexpr double least_usual_modulus = 2e9, largest_usual_modulus = 15e9;

/// Load over deflection of a part that stiffens under load: n samples in increasing load.
struct LoadDeflection {
  Eigen::VectorXd load;        ///< (n) N, > 0
  Eigen::VectorXd deflection;  ///< (n) m, > 0
  Eigen::VectorXd tangent;     ///< (n) N/m, d load / d deflection
};

/// Deflection and slope at one load.
struct Deflected {
  double deflection = 0;  ///< m
  double compliance = 0;  ///< m/N, d deflection / d load
};

/// Cubic in ln(deflection) over ln(load) with values and slopes of the samples, beyond them the power law of the
/// last one: exact for a power law, and of third order between samples.
/// @throws InputError  fewer than two samples; load not positive
Deflected deflected_at(const LoadDeflection &part, double load);

/// Bending of one work roll between the strip and its contact line, as compliance of the gap: m/N, (30.3).
/// @param contact_stiffness  N/m, K3, even over the barrel
/// @param reference  mid: at mid-length; mean: mean over the strip
double work_roll_bending(const BentWorkRoll &roll, double contact_stiffness, double half_barrel,
                         MassReference reference);

/// A stand of modulus M and a strip of plastic slope Q = -dF/dh2.  N/m.  (30.6)-(30.9)
struct GaugeCoupling {
  double M = 0;                           ///< N/m, tangent
  double Q = 0;                           ///< N/m
  double screw() const;                   ///< -, dh2/dS, (30.7)
  double thickness_by(double F_x) const;  ///< m per unit of x, where the force follows x by F_x = dF/dx, (30.8)
  double force_by(double F_x) const;      ///< N per unit of x, (30.9)
  double force_by_screw() const;          ///< N/m, dF/dS
};

/// Thickness at which strip and stand carry the same force, h2 = S + stretch(F(h2)), (30.6).  m
/// @param force    N over h2 (m), falling
/// @param stretch  m over F (N), rising
/// @param low, high  m, thicknesses below and above the answer
/// @throws InputError  the answer is not between them
/// Cost: some ten evaluations of both.
double coupled_thickness(double screw, const std::function<double(double)> &force,
                         const std::function<double(double)> &stretch, double low, double high);
}  // namespace mill::reduce
