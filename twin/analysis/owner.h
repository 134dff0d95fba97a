#pragma once
#include "twin/analysis/analysis.h"
#include <string>
#include <vector>

namespace mill::twin {
/// A frequency with its standard deviation, and its shape where three sensors and more saw it.
struct Seen {
  double frequency;        ///< Hz
  double deviation;        ///< -, relative standard deviation
  Eigen::VectorXcd shape;  ///< (p) of `channels`; empty: none
  std::vector<std::string> channels;
};

/// Whose it is: modes of the case within three standard deviations of both, the nearest first.  theory.md (42.7)
struct Owner {
  std::string sentence;  ///< "mode 6 of the case (745.8 Hz): spring K3 98 %, mass upper_work_roll 97 %"
  int mode        = -1;  ///< of the case, from 0; -1: none, or ambiguous
  double distance = 0;   ///< -, of that mode
};
Owner owner_among_modes(const Seen &seen, const CaseModel &stand);

/// "mains, 3 x 50 Hz", "3 turns of work_roll"; empty: neither.
/// @param reach  Hz, how far the frequency may be off
std::string turning_owner(double frequency, double reach, const std::vector<TurningRoll> &rolls, double speed,
                          bool line);
}  // namespace mill::twin
