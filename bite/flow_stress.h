#pragma once
#include "bite/derivative.h"
#include "core/errors.h"
#include "core/strip.h"
#include <cmath>

namespace mill::bite {
/// Constants of a flow stress law that can be differentiated; members as FlowStress.  A factor on the stress
/// serves the table, whose rows stay numbers.
template <class T> struct FlowStressLaw {
  std::string law;
  T k, eps0, n, k0;
  std::vector<std::array<double, 2>> table;  ///< (strain -, stress Pa)
};

/// Interval of a table that holds the strain; the last row belongs to the last interval.
/// @param rows  strain and stress, Pa
/// @throws InputError  fewer than two rows, strains that do not rise, strain outside the table
std::size_t table_interval(const std::vector<std::array<double, 2>> &rows, double strain);

/// Says which laws there are. @throws InputError always
[[noreturn]] void refuse_law(const std::string &law);

/// Plane-strain flow stress, Pa, at strain ln(h0/h), (8.1); T is double, complex or a number with derivatives, Law
/// is FlowStress or FlowStressLaw<T>.
/// Laws: constant k | swift k (eps0 + e)^n | ludwik k0 + k e^n | voce k0 + k (1 - exp(-n e)) | power k e^n |
/// reduction-power k (eps0 + 1 - exp(-e))^n, with the reduction in place of the strain | table, linear in between
/// @throws InputError  unknown law, strain outside the table, fewer than two rows or falling strains in it
template <class Law, class T> T flow_stress(const Law &law, const T &strain)
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
    refuse_law(law.law);
  const std::size_t i = table_interval(law.table, value_of(strain));
  const auto &a = law.table[i - 1], &b = law.table[i];
  return a[1] + (strain - a[0]) * ((b[1] - a[1]) / (b[0] - a[0]));
}
}  // namespace mill::bite
