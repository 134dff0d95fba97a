#pragma once
#include "fem/roll/condensed_roll.h"
#include "fem/roll/fourier_roll.h"
#include "fem/roll/roll_component.h"

// Member lists of the options of condensation and reduction; see core/base/each_member.h.
namespace mill::fem {
// The memory that a factor may take decides whether there is an answer, not which.
template <class Io> void each_member(Io &&io, const CondenseOptions &record)
{
  const auto &[slab, both_sides, odd_symmetric, tractions, keep_fields, memory] = record;
  io("slab", slab);
  io("both_sides", both_sides);
  io("odd_symmetric", odd_symmetric);
  io("tractions", tractions);
  io("keep_fields", keep_fields);
}

template <class Io> void each_member(Io &&io, const FourierOptions &record)
{
  const auto &[all_orders, ratio, half_width, both_sides, slab, points] = record;
  io("all_orders", all_orders);
  io("ratio", ratio);
  io("half_width", half_width);
  io("both_sides", both_sides);
  io("slab", slab);
  io("points", points);
}

template <class Io> void each_member(Io &&io, const RollComponentOptions &record)
{
  const auto &[n_barrel, frequency_limit, n_modes, surface] = record;
  io("n_barrel", n_barrel);
  io("frequency_limit", frequency_limit);
  io("n_modes", n_modes);
  io("surface", surface);
}
}  // namespace mill::fem
