#pragma once
#include "core/errors.h"
#include "core/strip.h"
#include <cmath>
#include <complex>

namespace mill::bite {
/// Value without its derivatives: of a number, of a complex step; automatic differentiation adds its own overload.
inline double value_of(const double x)
{
  return x;
}
inline double value_of(const std::complex<double> &x)
{
  return x.real();
}

/// Interval of a table that holds the strain; the last row belongs to the last interval.
/// @throws InputError  fewer than two rows, strains that do not rise, strain outside the table
std::size_t table_interval(const FlowStress &law, double strain);

/// Says which laws there are. @throws InputError always
[[noreturn]] void refuse_law(const FlowStress &law);

/// Plane-strain flow stress, Pa, at strain ln(h0/h), (8.1); T is double, complex or a number with derivatives.
/// Laws: constant k | swift k (eps0 + e)^n | ludwik k0 + k e^n | voce k0 + k (1 - exp(-n e)) | power k e^n |
/// reduction-power k (eps0 + 1 - exp(-e))^n, with the reduction in place of the strain | table, linear in between
/// @throws InputError  unknown law, strain outside the table, fewer than two rows or falling strains in it
template <class T> T flow_stress(const FlowStress &law, const T &strain)
{
  using std::exp;
  using std::pow;
  if (law.law == "constant")
    return T(law.k);
  if (law.law == "swift")
    return law.k * pow(law.eps0 + strain, law.n);
  if (law.law == "ludwik")
    return law.k0 + law.k * pow(strain, law.n);
  if (law.law == "voce")
    return law.k0 + law.k * (1.0 - exp(-law.n * strain));
  if (law.law == "power")
    return law.k * pow(strain, law.n);
  if (law.law == "reduction-power")
    return law.k * pow(law.eps0 + 1.0 - exp(-strain), law.n);
  if (law.law != "table")
    refuse_law(law);
  const std::size_t i = table_interval(law, value_of(strain));
  const auto &a = law.table[i - 1], &b = law.table[i];
  return a[1] + (strain - a[0]) * ((b[1] - a[1]) / (b[0] - a[0]));
}
}  // namespace mill::bite
