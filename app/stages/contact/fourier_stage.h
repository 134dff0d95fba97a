#pragma once
#include "app/stages/contact/contact_model.h"
#include "core/base/each_member.h"
#include "core/records/records.h"
#include "fem/roll/fourier_roll.h"
#include <optional>

namespace mill {
struct FourHigh;

/// The same contact by the Fourier engine, which shares neither mesh nor solver with the first.  theory.md 11
struct SecondEngine {
  ContactCurve mirrored, in_stand;         ///< as the curves of the first engine, at the same loads
  BarrelProfile mirrored_at, in_stand_at;  ///< at the first working load
};

template <class Io, class R, if_record<R, SecondEngine> = 0> void each_member(Io &&io, R &record)
{
  auto &[mirrored, in_stand, mirrored_at, in_stand_at] = record;
  io("mirrored", mirrored);
  io("in_stand", in_stand);
  io("mirrored_at", mirrored_at);
  io("in_stand_at", in_stand_at);
}

/// Everything that a roll's Fourier series depends on, as text; its hash is the key of the cache.
/// @param edge  m, of the stations; empty: those of the mesh
std::string fourier_inputs(const RollGeometry &geometry, const Material &steel, const fem::FourierOptions &options,
                           const Eigen::VectorXd &edge);

/// Both rolls as the Fourier solver has them.
struct FourierRolls {
  fem::FourierRoll backup, work;
};

/// False for shifted rolls or bending forces on the chocks, which this engine does not know; the run then says so.
bool second_engine_knows(RunContext &run, const FourHigh &stand, const std::string &name);

/// Condenses both rolls, or takes them from the cache.
/// @param largest  N, of the loads that will be swept
FourierRolls fourier_rolls(RunContext &run, const FourHigh &stand, const ContactSettings &settings,
                           double largest);

/// Sweeps the loads.
/// @throws SolverError  as the engine
SecondEngine solve_again(RunContext &run, const FourHigh &stand, const FourierRolls &rolls,
                         const std::string &name, const ContactSettings &settings, const Eigen::VectorXd &loads,
                         double working_load);

/// Adds contact.<name>.line_load_spread: largest difference of the line load between the engines over its mean,
/// where both are in contact and not within nine half widths of where it ends, since the pressure is singular at a
/// sharp barrel end.
void add_line_load_spread(RunContext &run, const std::string &name, const BarrelProfile &first,
                          const BarrelProfile &second);
}  // namespace mill
