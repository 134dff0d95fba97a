#pragma once
#include "core/model/material.h"

// Force over approach of two rolls in line contact, one-sided: no force where they do not touch.
namespace mill::cluster {
/// One body of a contact.
struct ContactBody {
  double radius = 0;  ///< m
  Material material;
};

/// Law of one contact over its whole length.  A straight spring is a power law with exponent 1.
struct ContactLaw {
  enum class Form {
    power,  ///< F = k d^p                        theory.md (38.3)
    line    ///< d = q (S - T ln q),  q = F/L     theory.md (38.5)
  };
  Form form = Form::power;

  double k = 0;  ///< N/m^p, power
  double p = 1;  ///< -, power, at least 1

  double length = 0;  ///< m, line
  double S      = 0;  ///< m2/N, line; with q in N/m
  double T      = 0;  ///< m2/N, line
};

/// k d with a straight line.  @param stiffness  N/m
ContactLaw straight_law(double stiffness);

/// Palmgren, steel: d[mm] = coefficient F[N]^0.9 / L[mm]^0.8.  theory.md (38.4)
ContactLaw palmgren_law(double length, double coefficient);

/// k d^p through a force with a tangent stiffness there: p f/d = k_t.
/// @param tangent  N/m   @param force  N, where it belongs to; without influence for exponent 1
ContactLaw power_law_through(double tangent, double force, double exponent);

enum class LineForm { foeppl, johnson };
/// Hertz' half width between cylinders, each body with its own datum.  theory.md (38.5)
ContactLaw line_law(LineForm form, const ContactBody &a, const ContactBody &b, double length);

/// S and T from samples of one contact by least squares of relative errors.
/// @param load, approach  n >= 2 samples, N and m
/// @param misfit          largest relative error of the approach
ContactLaw fitted_line_law(const double *load, const double *approach, int n, double length, double &misfit);

/// N at an approach in m; zero where it is negative.
double force(const ContactLaw &law, double approach);
/// N/m at an approach in m; zero where it is negative.  A straight law has its full stiffness at 0.
double tangent(const ContactLaw &law, double approach);
/// m under a force in N, which is positive.
double approach(const ContactLaw &law, double force);
/// J stored at an approach.
double energy(const ContactLaw &law, double approach);

/// 1 below a, 0 above b and a cubic between: share of the damping.  theory.md (38.7)
double step(double z, double a, double h0, double b, double h1);

/// One-sided force with damping that sets in over the depth: max(0, force(d) + c ddot S).  theory.md (38.6)
/// @param approach, rate  m and m/s, positive where the rolls come together
/// @param damping         N s/m, in full at `depth`
/// @param depth           m; 0: in full from the first touch
double impact_force(const ContactLaw &law, double approach, double rate, double damping, double depth);
}  // namespace mill::cluster
