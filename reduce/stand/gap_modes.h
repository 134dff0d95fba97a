#pragma once
#include "reduce/stand/mode_name.h"
#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

// What the gap between the work rolls sees of the modes of any stand, M y'' + K y = b F with the gap b y: a chain,
// a detailed stand, a roll stack under its load.  theory.md 22.9
namespace mill::reduce {
inline constexpr double least_share_of_gap_mode = 0.01;        ///< -, below it a mode is not named a gap mode
inline constexpr double least_share_listed      = 0.005;       ///< -, from here on a mode is in every table
inline constexpr double least_response_listed   = 0.01;        ///< -, 40 dB below the largest receptance
inline constexpr double third_octave[2]         = {110, 280};  ///< Hz, of gap modes of the first kind
inline constexpr double fifth_octave[2]         = {450, 900};  ///< Hz, of gap modes of the second kind

/// (m): gamma_k = (g_k / w_k)^2 / sum_j (g_j / w_j)^2 with g_k = b phi_k, the share of each mode in the static
/// compliance of the gap.  theory.md (22.23)
/// Motions that no spring holds (w below 1e-7 of the largest) have the whole compliance where they open the gap,
/// in proportion to g^2, else none of it.  All zero where no mode opens the gap.
/// @param frequency   (m) Hz, >= 0, in any order
/// @param shape       (n, m) mass-normalised, any sign
/// @param row         (n) -, b
/// @param compliance  m/N, b K^-1 b, where `shape` lacks modes of the stand; NaN: all modes are here
/// Cost O(n m).
Eigen::VectorXd gap_shares(const Eigen::VectorXd &frequency, const Eigen::MatrixXd &shape,
                           const Eigen::VectorXd &row,
                           double compliance = std::numeric_limits<double>::quiet_NaN());

/// The rolls on one side of the strip in one mode.
struct StackMotion {
  std::string side;        ///< "upper"; empty: the stack has one side only
  double kinetic     = 0;  ///< -, share of the kinetic energy
  double work_roll   = 0;  ///< displacement of the roll at the strip, any scale
  double backup_roll = 0;  ///< displacement of the roll that carries it, same scale, same direction as positive
};

/// A part with its share of the kinetic energy.
struct KineticShare {
  std::string part;    ///< "upper frame"
  std::string name;    ///< of a mode that is most of all in this part: "frame, upper"
  std::string key;     ///< "frame_upper"
  double kinetic = 0;  ///< -
};

/// One mode in the terms of the rules for names.
struct GapMotion {
  double frequency = 0;  ///< Hz
  double gap_share = 0;  ///< -, of gap_shares()
  std::vector<StackMotion> stacks;
  std::vector<KineticShare> parts;
};

/// First kind: work roll and backup roll of the stack of larger kinetic energy move the same way; second kind:
/// they do not.  None below least_share_of_gap_mode or without stacks.
GapKind gap_kind(const GapMotion &mode);

/// " (third octave)" or " (fifth octave)" where the frequency (Hz) of a mode of that kind lies in the range; else
/// empty.
std::string octave(double frequency, GapKind kind);

/// Whether the rules give both modes the same name before they are numbered.
bool named_alike(const GapMotion &a, const GapMotion &b);

/// The gap mode of a kind: the one with the largest share; -1: no mode is of this kind.
int gap_mode(const std::vector<GapMotion> &modes, GapKind kind = GapKind::first);

/// One name for each mode.  theory.md 22.9, table
/// The gap mode of each kind is "gap mode, first kind"; other gap modes have the part with the largest kinetic
/// share after it; all other modes are named by that part.  A name that comes again is numbered upwards in
/// frequency, up to "order 3"; from the fourth on, a gap mode has its two largest parts in the name, another mode
/// is "frame, upper, higher", without key.
/// @param modes  ascending in frequency
/// @param given  (modes) names that are not changed, those with a key; empty: none
std::vector<ModeName> gap_mode_names(const std::vector<GapMotion> &modes, const std::vector<ModeName> &given = {});
}  // namespace mill::reduce
