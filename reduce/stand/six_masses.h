#pragma once
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"
#include "core/model/material.h"
#include "core/records/stand_model.h"
#include <array>
#include <string>
#include <vector>

namespace mill {
struct FourHigh;
}
namespace mill::reduce {
/// The chain as a stand model of six unknowns, "six-mass".
StandModel chain_stand(const LumpedModel &model, FrameForm frame = FrameForm::open);

/// A mass that moves rigidly with one of the points, but is counted at another of M1..M6.
struct Rider {
  std::string name;   ///< "balance gear"
  std::string point;  ///< it moves with: "upper frame"
  int from    = 0;    ///< 0..5: where its unknown's part is counted
  int to      = 0;    ///< 0..5: where it belongs
  double mass = 0;    ///< kg, whole stand
};

/// Balance gear (moves with the upper frame, counted in M2) and lower chocks (move with the lower frame, counted
/// in M5), (4.14) and (4.15).
std::vector<Rider> riders_of(const FourHigh &stand);

/// Six masses and seven springs made from any stand model.
struct SixMasses {
  std::array<double, 6> M{};             ///< kg
  std::array<double, 7> K{};             ///< N/m
  std::array<double, 6> displacement{};  ///< m/N, of the six reference points under a bite force of 1 N, K4 = 0
};

/// The stand as the load path of (4.2) sees it: without K4, and with K1 to the ground where the frame is closed.
StandModel load_path(const StandModel &stand);

/// Springs from the differences of the static displacements of the six points of load_path() under a bite force of
/// 1 N, masses from the kinetic energy of that static shape, part by part.  theory.md (22.10)-(22.12) A chain
/// returns its own numbers.
/// @param reference  mid: rolls at mid-length; mean: backup rolls by the mean under their contact load
/// @throws InputError  a part that is not held; points that are not in the order of the chain
/// @param upper_share  -, of a housing's kinetic energy that belongs to M1, the rest for M6; NaN: by its interface
SixMasses six_masses(const StandModel &stand, const std::vector<Rider> &riders = {},
                     MassReference reference = MassReference::mid, double upper_share = not_given);

/// `chain` with the masses and springs of a stand model: what lumped_model.toml is written from.
/// Given values of the chain stay as they are.
LumpedModel with_six_masses(LumpedModel chain, const SixMasses &values, const std::string &method);
}  // namespace mill::reduce
