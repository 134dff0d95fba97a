#pragma once
#include "core/records/stand_model.h"
#include <Eigen/Core>
#include <string>
#include <vector>

// A solved stack in small motion.  theory.md 51.6
namespace mill::reduce {
class BeamStack;
struct StackState;

/// What one unknown moves.
struct MovedRoll {
  std::size_t roll                                           = 0;  ///< place in Stack::rolls
  std::size_t axis                                           = 1;  ///< 0: x, 1: y
  enum class Motion { translation, tilting, bending } motion = Motion::translation;
};

/// The stack about its solved state, without the strip: M y'' + K y = b F.
struct MovingStack {
  /// Points: mean of the bearings, what carries the work roll, the work roll; the same of the lower half from the
  /// strip; then every other roll at mid-length.  Lines: axis of every roll, upwards.
  StandModel model;
  Connection strip;              ///< between the work rolls; without springs where the strip has no slope
  std::vector<MovedRoll> moved;  ///< (n) of the unknowns
  double strip_stiffness = 0;    ///< N/m, of the strip for an even opening, both work rolls flattening; 0: none
};

/// Every roll in the modes of the free beam, with its chocks: both motions of a rigid roll, `bending_modes` shapes
/// of bending, and the shape under a unit rolling force at the solved state, so that the static compliance of the
/// gap is that of the beams.  Contacts are springs dq/dd along their normal at every Gauss point, bearings and
/// saddles springs of their own.  theory.md (51.22)
/// @param solved  after solve()
/// Cost: an eigenvalue problem of a roll for each shape of roll; O(rolls x bending_modes)^2 storage.
MovingStack moving_stack(const BeamStack &solved, int bending_modes = 8);

/// One mass for each roll and direction, between them one spring for each contact, and what holds a roll.  A roll
/// that neither tilts nor bends comes nearer by the same everywhere, so that the spring is the sum of all places
/// (PairState::uniform_tangent), which is positive wherever the contact is not open.  theory.md (51.23)
MovingStack lumped_stack(const BeamStack &solved, const StackState &state);

/// With the strip as springs between the work rolls.
StandModel with_strip(const MovingStack &stack);
}  // namespace mill::reduce
