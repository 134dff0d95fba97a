#pragma once
#include "reduce/stand/mode_name.h"
#include "reduce/stand/stand_comparison.h"
#include <string>
#include <vector>

namespace mill::reduce {
/// Modal assurance from which modes of two models are the same mode.
inline constexpr double same_mode = 0.7;

/// One name for each mode, by the same rules for six masses, beams and component modes; parts are summed, and what
/// a part carries (StandModel::carried) is a part of its own.
std::vector<ModeName> mode_names(const StandWithModes &stand);

/// Modal assurance between the modes of two models of a list.
struct ModelLikeness {
  std::size_t detailed = 0, other = 0;  ///< places in the list, detailed < other
  Eigen::MatrixXd mac;                  ///< (modes of detailed, modes of other) 0 .. 1
};

/// Names of several models of one stand, the most detailed one first.  A mode that two models have in common has
/// one name: that of the most detailed model that shows it; modes that no other model has are named by their own
/// shares.  theory.md 22.9
std::vector<std::vector<ModeName>> common_names(const std::vector<const StandWithModes *> &stands,
                                                const std::vector<ModelLikeness> &likeness);
}  // namespace mill::reduce
