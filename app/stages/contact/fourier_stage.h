#pragma once
#include "app/stages/contact/contact_model.h"
#include "fem/roll/contact_answers.h"
#include "fem/roll/fourier_roll.h"

namespace mill {
struct FourHigh;

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
fem::SecondEngine solve_again(RunContext &run, const FourHigh &stand, const FourierRolls &rolls,
                              const std::string &name, const ContactSettings &settings,
                              const Eigen::VectorXd &loads, double working_load);

/// Adds contact.<name>.line_load_spread, fem::line_load_spread() at this load (N), held as in the stand.
void add_line_load_spread(RunContext &run, const std::string &name, double load, double spread);
}  // namespace mill
