#pragma once
#include "core/model/four_high.h"
#include "core/model/lumped_model.h"
#include "core/records/component.h"
#include "reduce/chain/roll_shapes.h"
#include "reduce/chain/spring_chain.h"
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <string>

namespace mill {
class MovingKeys;
}
namespace mill::reduce {
/// Rolls by finite elements, as the chain takes its shapes from them; null: not at hand.
struct SolidRolls {
  const Component *work_roll = nullptr, *backup_roll = nullptr;
  const Component *coarse_work_roll   = nullptr,
                  *coarse_backup_roll = nullptr;  ///< on a coarser mesh, for the error
  double gain = 0;  ///< -, how many times larger an error is on the coarser mesh, see mesh_pair_error()
  explicit operator bool() const
  {
    return work_roll && backup_roll;
  }
};

/// What other computations bring to the chain, at one working load.  Whole stand, N/m.
struct ChainInputs {
  Parameter K3;                         ///< upper backup roll on upper work roll, tangent
  Parameter K4;                         ///< bite
  Parameter K5;                         ///< lower work roll on lower backup roll, tangent
  Parameter K_Zy_upper;                 ///< both bearings of the upper backup roll together, tangent
  Parameter K_Zy_lower;                 ///< both bearings of the lower backup roll together, tangent
  std::array<Parameter, 4> Kzc;         ///< one bearing: upper backup, upper work, lower work, lower backup
  std::array<Parameter, 4> Kzc_across;  ///< the same across the load
  Parameter K_ww;     ///< both work rolls on each other, tangent; needed where frame.modulus is given
  SolidRolls solid;   ///< without them the closed forms are used, also against backup_roll.bending_model
  OperatingPoint at;  ///< working load, "976.2 kN"
};

/// The springs among them by their names in the results.  A member that is added and not named here does not
/// compile.
template <class Io, class Inputs> void each_spring(Io &&io, Inputs &inputs)
{
  auto &[K3, K4, K5, K_Zy_upper, K_Zy_lower, Kzc, Kzc_across, K_ww, solid, at] = inputs;
  io("K3", K3);
  io("K5", K5);
  io("K4", K4);
  io("K_Zy", K_Zy_upper);
  io("K_Zy_lower", K_Zy_lower);
  for (std::size_t i = 0; i < Kzc.size(); ++i) {
    const std::string name = "Kzc" + std::to_string(i + 1);
    io(name, Kzc[i]);
    io(name + "_across", Kzc_across[i]);
  }
}

/// All numbers of the chain by their names, in the order of the results; stiffnesses of bearings that are not
/// known are left out.  A member that is added to the model and not named here does not compile.
template <class Io> void each_number(Io &&io, const LumpedModel &model)
{
  const auto &[M, K, Kzc, Kzc_across, C, at, film, film_frequency, moving_mass] = model;
  for (std::size_t i = 0; i < M.size(); ++i)
    io("M" + std::to_string(i + 1), M[i]);
  for (std::size_t i = 0; i < K.size(); ++i)
    io("K" + std::to_string(i + 1), K[i]);
  io("C", C);
  for (std::size_t i = 0; i < Kzc.size(); ++i) {
    const std::string name = "Kzc" + std::to_string(i + 1);
    if (!std::isnan(Kzc[i].value))
      io(name, Kzc[i]);
    if (!std::isnan(Kzc_across[i].value))
      io(name + "_across", Kzc_across[i]);
  }
}

/// The lumped model with the shapes and flexibilities it was made of.
struct LumpedStand {
  LumpedModel model;
  Parameter K_ZW;  ///< N/m, backup roll on its bearing centres, by the mass reference of the case
  Parameter K_Zy_upper, K_Zy_lower;  ///< N/m, as used: computed or given
  Parameter K_ww;                    ///< N/m, as the inputs have it
  Frame frame;                       ///< as drawn, or what a given K2, K6 leaves for parts that are not
  Flexibilities flexibility;
  BentBackupRoll backup;             ///< as used, K_ZW given or not
  std::array<BentWorkRoll, 2> work;  ///< upper, lower
  RollShape f1_upper, f1_lower;      ///< work roll, mid-length to roll end
  RollShape f2_upper, f2_lower;      ///< backup roll, mid-length to bearing centre
};

/// Error estimates of the chain's numbers: they are not needed for a case that was changed to see what moves.
enum class StatedErrors { propagated, none };

/// Masses and springs of the six-mass chain.  theory.md 4
/// A value of the case's [given] replaces the computed one and keeps its source.  A given K3, K5, K_Zy, K_ZW, K1
/// or K7 also enters the shapes and with them the masses; a given K2 or K6 replaces the spring of the chain only,
/// since it does not say which of its parts is meant.
///
/// Rolls bend as backup_roll.bending_model says: "solid", the components of `inputs`, with the closed forms of
/// beams as checks; "beam", the other way round.
///
/// Every Parameter carries unit, source, method and load.  Its error estimate is the
/// sum of |d ln value / d ln input| x error over K3, K5, K_Zy, K_ZW, a given K1 or K7 and every mass and stiffness
/// of the frame, by central differences of this very chain, (4.17).  Where frame.modulus is given, it and K_ww are
/// inputs too, and whatever moves, the stiffnesses that follow it keep the modulus (30.11).  Where one of those it
/// depends on states no error it has none either, and error_lacks names which.
///
/// @param keys  of the case, for the keys that each Parameter was made from; nullptr: without lists
/// @throws InputError  a spring of the load path, the strip width or a work roll dimension is not positive
/// Cost: some sixty evaluations of the chain, together some ten milliseconds; three without the errors.
LumpedStand lumped_stand(const FourHigh &stand, const ChainInputs &inputs,
                         StatedErrors errors = StatedErrors::propagated, MovingKeys *keys = nullptr);

/// The frame of a stand whose mill modulus is given, at the load of these inputs, (30.11); the stand's own frame
/// where it is not.  The chain of any other pass then takes the same frame.
/// @throws InputError  rolls, contacts and bearings alone are softer than the modulus
Frame frame_on_modulus(const FourHigh &stand, const ChainInputs &inputs);

/// Only the model of lumped_stand().
LumpedModel lumped_model(const FourHigh &stand, const ChainInputs &inputs);
}  // namespace mill::reduce
