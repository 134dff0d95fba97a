#pragma once
#include "plain_number.h"
#include <array>
#include <cmath>
#include <string>
#include <vector>

// Plane-strain flow stress of the strip: everything about a law is written here and in flow_stress_law.cpp, and
// nowhere else.  A law without a case in one of the switches does not compile.  theory.md 8.1
#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wswitch"

namespace mill {
enum class FlowStressLaw { constant, swift, ludwik, voce, power, reduction_power, table };

/// k_f(eps) with eps = ln(h0/h) unless the law says otherwise; T is double or a number with derivatives.  A factor
/// on the stress serves the table, whose rows stay numbers.
template <class T> struct FlowStressOf {
  FlowStressLaw law = FlowStressLaw::constant;
  T k               = 0;                     ///< Pa, the constant, or the factor of the law
  T eps0            = 0;                     ///< -
  T n               = 0;                     ///< -
  T k0              = 0;                     ///< Pa, initial value of ludwik and voce
  std::vector<std::array<double, 2>> table;  ///< (strain -, stress Pa)
};
using FlowStress = FlowStressOf<double>;

constexpr std::size_t n_flow_constants = 4;

/// Where the constants stand, in the order of flow_stress_constants(); one that is missing does not compile.
template <class T> std::array<T *, n_flow_constants> places_of_constants(FlowStressOf<T> &flow)
{
  auto &[law, k, eps0, n, k0, table] = flow;
  return std::array{&k, &eps0, &n, &k0};
}

/// The same law in numbers of another type.
template <class T> FlowStressOf<T> flow_stress_in(FlowStress flow)
{
  FlowStressOf<T> out;
  out.law         = flow.law;
  out.table       = flow.table;
  const auto from = places_of_constants(flow);
  const auto to   = places_of_constants(out);
  for (std::size_t i = 0; i < n_flow_constants; ++i)
    *to[i] = T(*from[i]);
  return out;
}

/// A constant of the laws: its row in a case file, and its name as a number of a pass.
struct FlowStressConstant {
  const char *key;
  double FlowStress::*member;
  const char *unit;             ///< of the case file
  std::array<double, 2> range;  ///< in that unit, both ends allowed; the fallback is zero
  const char *example, *meaning;
  const char *name;     ///< in the tables of sensitivities
  const char *si_unit;  ///< there
};
const std::array<FlowStressConstant, n_flow_constants> &flow_stress_constants();

/// What the program must know of a law in addition to its formulas.
struct FlowStressRow {
  const char *name;                         ///< in a case file
  std::vector<double FlowStress::*> needs;  ///< a case has to give them, and no other is read
  bool hardens;                             ///< depends on the strain
  bool tabled;                              ///< by rows of strain and stress
  bool steep;  ///< a power of the strain, whose slope is large where the strain begins
};
const FlowStressRow &row_of(FlowStressLaw law);
const std::vector<FlowStressLaw> &flow_stress_laws();  ///< all of them

/// @throws InputError  no law of this name
FlowStressLaw flow_stress_law(const std::string &name);
std::string name_of(FlowStressLaw law);
bool reads(const FlowStress &flow, double FlowStress::*constant);

inline bool hardens(const FlowStress &flow)
{
  return row_of(flow.law).hardens;
}

/// Times a factor, whatever the law.
FlowStress scaled(FlowStress flow, double factor);

/// Of a strip without strain, Pa; nan where the law leaves it open.
double initial_stress(const FlowStress &flow);

namespace bite {
/// Interval of a table that holds the strain; the last row belongs to the last interval.
/// @param rows  strain and stress, Pa
/// @throws InputError  fewer than two rows, strains that do not rise, strain outside the table
std::size_t table_interval(const std::vector<std::array<double, 2>> &rows, double strain);

/// True where the law gives no flow stress of its own: a law without initial value at a strain below
/// least_strain.  What divides by that stress (a tension over it, a film under it) has no answer there.
bool starts_from_nothing(const FlowStress &law, double strain);

/// Strain from where a steep law begins; infinite: the law is none.
double strain_from_branch(const FlowStress &law, double strain);

/// Strains between which the law is smooth: rows of a table, or where growth() takes over.
template <class T> std::vector<double> strains_of_kinks(const FlowStressOf<T> &law);

/// A law that is smooth between its `from` and the one before.
struct SmoothFlowStress {
  double from;  ///< -, strain: the larger end
  FlowStress law;
};
/// The pieces of a law from the larger strain to the smaller; of a table one straight line after the other.
/// @throws InputError  as flow_stress()
std::vector<SmoothFlowStress> smooth_pieces_of(const FlowStress &law, double larger, double smaller);

/// Strain below which no law is followed to the letter: powers rise there with a slope without bound.
constexpr double least_strain = 1e-4;

/// What a law grows with (the base of its power, Voce's 1 - exp(-n e)) as the law sees it: itself down to
/// least_strain; below, a hyperbola with the same value and slope there, half of it at zero, never negative.  One
/// rule for slab theories and finite elements: no infinite slope, no kink, no nan from a strain rounded below
/// zero. theory.md 8.1
template <class T> T growth(const T &x)
{
  return value_of(x) < least_strain ? T(least_strain * least_strain / (2 * least_strain - x)) : x;
}

/// Strain at which growth() takes over, or minus infinity: the curvature of the law jumps there.
template <class T> double strain_of_growth(const FlowStressOf<T> &law)
{
  switch (law.law) {
  case FlowStressLaw::swift:
    return least_strain - value_of(law.eps0);
  case FlowStressLaw::ludwik:
  case FlowStressLaw::power:
    return least_strain;
  case FlowStressLaw::reduction_power:
    return -std::log(1 + value_of(law.eps0) - least_strain);
  case FlowStressLaw::voce:
    return value_of(law.n) > 0 ? -std::log(1 - least_strain) / value_of(law.n) : -INFINITY;
  case FlowStressLaw::constant:
  case FlowStressLaw::table:
    break;
  }
  return -INFINITY;
}

/// growth(x)^n; a straight line is taken as it is.
template <class T, class N> T growth_power(const T &x, const N &n)
{
  using std::pow;
  return value_of(n) == 1 ? x : T(pow(growth(x), n));
}

/// Plane-strain flow stress, Pa, at strain ln(h0/h), (8.1); T is double, complex or a number with derivatives, Law
/// is FlowStress or FlowStressOf<T>.
/// Laws: constant k | swift k (eps0 + e)^n | ludwik k0 + k e^n | voce k0 + k (1 - exp(-n e)) | power k e^n |
/// reduction-power k (eps0 + 1 - exp(-e))^n, with the reduction in place of the strain | table, linear in between;
/// strains below least_strain by growth()
/// @throws InputError  strain outside the table, fewer than two rows or falling strains in it
template <class Law, class T> T flow_stress(const Law &law, const T &strain)
{
  using std::exp;
  switch (law.law) {
  case FlowStressLaw::constant:
    return T(law.k);
  case FlowStressLaw::swift:
    return law.k * growth_power(T(law.eps0 + strain), law.n);
  case FlowStressLaw::ludwik:
    return law.k0 + law.k * growth_power(strain, law.n);
  case FlowStressLaw::voce:
    return law.k0 + law.k * growth(T(1.0 - exp(-law.n * strain)));
  case FlowStressLaw::power:
    return law.k * growth_power(strain, law.n);
  case FlowStressLaw::reduction_power:
    return law.k * growth_power(T(law.eps0 + 1.0 - exp(-strain)), law.n);
  case FlowStressLaw::table:
    break;
  }
  const std::size_t i = table_interval(law.table, value_of(strain));
  const auto &a = law.table[i - 1], &b = law.table[i];
  return a[1] + (strain - a[0]) * ((b[1] - a[1]) / (b[0] - a[0]));
}

/// flow_stress() of a strain that a flow field brings along, which is larger than that of the thickness where the
/// strip is sheared: the ends of a table count on beyond it.
template <class T> T carried_flow_stress(const FlowStress &law, const T &strain)
{
  if (law.law != FlowStressLaw::table || law.table.size() < 2)
    return flow_stress(law, strain);
  const double low = law.table.front()[0], high = law.table.back()[0], e = value_of(strain);
  return flow_stress(law, e < low ? T(low) : e > high ? T(high) : strain);
}

template <class T> std::vector<double> strains_of_kinks(const FlowStressOf<T> &law)
{
  std::vector<double> strains;
  for (const auto &row : law.table)
    if (law.law == FlowStressLaw::table)
      strains.push_back(row[0]);
  if (law.law != FlowStressLaw::table)
    strains.push_back(strain_of_growth(law));
  return strains;
}
}  // namespace bite

// The constants of the laws are listed with them (core/laws).
template <class Io> void each_member(Io &&io, const FlowStress &record)
{
  io("law", name_of(record.law));
  for (const FlowStressConstant &constant : flow_stress_constants())
    io(constant.key, record.*constant.member);
  io("table", record.table);
}
}  // namespace mill
#pragma GCC diagnostic pop
