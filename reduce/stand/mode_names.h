#pragma once
#include "reduce/stand/gap_modes.h"
#include "reduce/stand/mode_name.h"
#include "reduce/stand/stand_comparison.h"
#include <string>
#include <vector>

namespace mill::reduce {
/// Modal assurance from which modes of two models are the same mode.
inline constexpr double same_mode = 0.7;
/// Ratio of the gap shares of two models up to which a mode of both has one name.
inline constexpr double same_share = 2;

/// Where sensors sit and forces act: rolls and chocks, as far as the model has them, in a fixed order.
std::vector<const StandPoint *> measured_places(const StandModel &stand);

/// (modes) gap_shares() of a stand with the compliance of all its modes, kept or not.
Eigen::VectorXd gap_shares(const StandWithModes &stand);

/// Each mode in the terms of the rules: shares by part, what a part carries (StandModel::carried) apart from it.
std::vector<GapMotion> gap_motions(const StandWithModes &stand);

/// Sets ModeName::listed: gamma of at least least_share_listed, or a receptance at a measured place, for a force
/// in the gap, of at least least_response_listed of the largest.
void mark_listed(const StandWithModes &stand, std::vector<ModeName> &names);

/// One name for each mode, by the same rules for six masses, beams and component modes.  theory.md 22.9
std::vector<ModeName> mode_names(const StandWithModes &stand);

/// Modal assurance between the modes of two models of a list.
struct ModelLikeness {
  std::size_t detailed = 0, other = 0;  ///< places in the list, detailed < other
  Eigen::MatrixXd mac;                  ///< (modes of detailed, modes of other) 0 .. 1
};

/// Names of several models of one stand, the most detailed one first.  A mode that two models have in common, with
/// gap shares within a factor 2, has one name: that of the most detailed model that shows it.  Other modes are
/// named by the shares of their own model.  theory.md 22.9
std::vector<std::vector<ModeName>> common_names(const std::vector<const StandWithModes *> &stands,
                                                const std::vector<ModelLikeness> &likeness);
}  // namespace mill::reduce
