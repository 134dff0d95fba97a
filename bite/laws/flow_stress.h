#pragma once
#include "core/numerics/derivative.h"
#include "core/case/errors.h"
#include "core/model/strip.h"
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

/// True where the law gives no flow stress of its own: a law without initial value at a strain below
/// least_strain.  What divides by that stress (a tension over it, a film under it) has no answer there.
bool starts_from_nothing(const FlowStress &law, double strain);

/// Says which laws there are. @throws InputError always
[[noreturn]] void refuse_law(const std::string &law);

/// Strain below which no law is followed to the letter: powers rise there with a slope without bound.
constexpr double least_strain = 1e-4;

/// What a law grows with (the base of its power, Voce's 1 - exp(-n e)) as the law sees it: itself down to
/// least_strain; below, a hyperbola with the same value and slope there, half of it at nil, never negative.  One
/// rule for slab theories and finite elements: no infinite slope, no kink, no nan from a strain rounded below nil.
/// theory.md 8.1
template <class T> T growth(const T &x)
{
  return value_of(x) < least_strain ? T(least_strain * least_strain / (2 * least_strain - x)) : x;
}

/// Strain at which growth() takes over, or minus infinity: the curvature of the law jumps there.
template <class Law> double strain_of_growth(const Law &law)
{
  if (law.law == "swift")
    return least_strain - value_of(law.eps0);
  if (law.law == "ludwik" || law.law == "power")
    return least_strain;
  if (law.law == "reduction-power")
    return -std::log(1 + value_of(law.eps0) - least_strain);
  if (law.law == "voce" && value_of(law.n) > 0)
    return -std::log(1 - least_strain) / value_of(law.n);
  return -INFINITY;
}

/// growth(x)^n; a straight line is taken as it is.
template <class T, class N> T growth_power(const T &x, const N &n)
{
  using std::pow;
  return value_of(n) == 1 ? x : T(pow(growth(x), n));
}

/// Plane-strain flow stress, Pa, at strain ln(h0/h), (8.1); T is double, complex or a number with derivatives, Law
/// is FlowStress or FlowStressLaw<T>.
/// Laws: constant k | swift k (eps0 + e)^n | ludwik k0 + k e^n | voce k0 + k (1 - exp(-n e)) | power k e^n |
/// reduction-power k (eps0 + 1 - exp(-e))^n, with the reduction in place of the strain | table, linear in between;
/// strains below least_strain by growth()
/// @throws InputError  unknown law, strain outside the table, fewer than two rows or falling strains in it
template <class Law, class T> T flow_stress(const Law &law, const T &strain)
{
  using std::exp;
  if (law.law == "constant")
    return T(law.k);
  if (law.law == "swift")
    return law.k * growth_power(T(law.eps0 + strain), law.n);
  if (law.law == "ludwik")
    return law.k0 + law.k * growth_power(strain, law.n);
  if (law.law == "voce")
    return law.k0 + law.k * growth(T(1.0 - exp(-law.n * strain)));
  if (law.law == "power")
    return law.k * growth_power(strain, law.n);
  if (law.law == "reduction-power")
    return law.k * growth_power(T(law.eps0 + 1.0 - exp(-strain)), law.n);
  if (law.law != "table")
    refuse_law(law.law);
  const std::size_t i = table_interval(law.table, value_of(strain));
  const auto &a = law.table[i - 1], &b = law.table[i];
  return a[1] + (strain - a[0]) * ((b[1] - a[1]) / (b[0] - a[0]));
}

/// flow_stress() of a strain that a flow field brings along, which is larger than that of the thickness where the
/// strip is sheared: the ends of a table count on beyond it.
template <class T> T carried_flow_stress(const FlowStress &law, const T &strain)
{
  if (law.law != "table" || law.table.size() < 2)
    return flow_stress(law, strain);
  const double low = law.table.front()[0], high = law.table.back()[0], e = value_of(strain);
  return flow_stress(law, e < low ? T(low) : e > high ? T(high) : strain);
}
}  // namespace mill::bite
