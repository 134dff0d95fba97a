#pragma once
#include "core/records/component.h"
#include "core/records/stand_model.h"
#include "reduce/chain/roll_body.h"
#include "reduce/stand/lumped_stand.h"
#include <array>

namespace mill {
struct FourHigh;
}
namespace mill::reduce {
/// What a stand needs in addition to its drawing: springs at the working load and the reduced frame.  Values are
/// those of the whole stand unless a comment says otherwise.
struct StandSprings {
  double K1             = 0;          ///< N/m, ground to upper frame (closed frame: lower to upper frame)
  double K7             = 0;          ///< N/m, lower frame to ground
  double M1             = 0;          ///< kg, upper frame
  double M6             = 0;          ///< kg, lower frame
  double K3             = 0;          ///< N/m, upper roll contact, tangent
  double K5             = 0;          ///< N/m, lower roll contact, tangent
  double K4             = 0;          ///< N/m, bite; 0 when the force is the whole bite force
  double K_Zy_upper     = 0;          ///< N/m, both bearings of the upper backup roll
  double K_Zy_lower     = 0;          ///< N/m, both bearings of the lower backup roll
  double K_ZW           = not_given;  ///< N/m, replaces the drawn backup roll's stiffness in a stand of beams
  double film_upper     = 0;          ///< N s/m, of the oil films in K_Zy_upper; 0: none
  double film_lower     = 0;          ///< N s/m, in K_Zy_lower
  double film_frequency = 0;          ///< Hz, at which they are taken, (29.18)
  double Kzc_upper      = not_given;  ///< N/m, one bearing of the upper work roll, chock on it; absent: rigid
  double Kzc_lower      = not_given;  ///< N/m, one bearing of the lower work roll, chock on it; absent: rigid
};

/// Springs and frame of the chain made for the same stand: K1, K3, K5, K7, M1, M6, both K_Zy as they enter the
/// chain, given values included (given K2, K6, M2..M5 belong to the chain alone); K4 only in the rolling state
/// (force_meaning other than measured, in_state()); K_ZW where it is given.
/// @param chock_on_bearing  the work-roll chocks move on their bearings' Kzc instead of with the neck
StandSprings stand_springs(const FourHigh &stand, const LumpedStand &chain, bool chock_on_bearing = false);

/// Puts four rolls (upper backup, upper work, lower work, lower backup) and the frame together.  theory.md 22.2
/// Masses that are zero get no unknown: their springs are put in series, their points stay.
/// @param housing  null: frame of two lumps (M1, K1, M6, K7); else its interfaces "screw" and "seat" carry piston
///                 and packing above, packing and load cell below, with the masses and springs of stand.frame
/// @throws InputError  a spring or a frame mass not positive, named with its key; housing without screw or seat
/// Cost O(n^2) memory, n = sum of the rolls' unknowns + at most 6.
StandModel assemble_stand(const std::string &name, const FourHigh &stand, const StandSprings &springs,
                          const std::array<RollBody, 4> &rolls, const Component *housing = nullptr);

/// Place in the chain, 0 to 5 for M1..M6, that the mass of a part belongs to, (4.13)-(4.16); -1: "housing", shared
/// by M1 and M6.  @throws InputError  a part that has no place in the chain
int place_of_part(const std::string &part);
}  // namespace mill::reduce
