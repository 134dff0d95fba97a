#pragma once
#include "twin/analysis/analysis.h"
#include <optional>
#include <string>
#include <vector>

namespace mill::twin {
/// A frequency with its standard deviation, and its shape where three sensors and more saw it.  With one channel
/// that is a place of the case, only modes that move this place are candidates.
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

/// A peak as its owner is looked for among what turns.
struct TurningPeak {
  double frequency;        ///< Hz
  double reach;            ///< Hz, how far it may be off
  bool line;               ///< narrow: only lines are mains, faults of bearings and images
  double image_reach = 0;  ///< Hz, how far an image may be off; 0: half of `reach`
};

/// "mains, 3 x 50 Hz", "3 turns of the work_roll", "2 x BPFO of bearing trb", "image of 3 x 746.3 Hz"; several:
/// "ambiguous: .. or ..", empty: none.
/// @param stand    nullptr: neither rolls nor bearings are known
/// @param speed    m/s; NaN: not one speed
/// @param lines    Hz, of the other lines of the record
/// @param rate     Hz, samples of the record
/// @param mains    Hz, of the plant; empty: 50 and 60 Hz are tried
/// An image is named only where the chance that a harmonic of one of the lines falls there is below 1 %, (41.30).
std::string turning_owner(const TurningPeak &peak, const CaseModel *stand, double speed,
                          const std::vector<double> &lines, double rate, std::optional<double> mains = {});
}  // namespace mill::twin
