#pragma once
#include "app/trace/closed_form_chain.h"
#include "core/records/speed_verdict.h"
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace mill {
struct Case;
}
namespace mill::studio {
/// A mode of the six masses with the strip as a spring, or without it.
struct QuickMode {
  std::string name, key;      ///< "gap mode, first kind (third octave)", "gap_first_kind"
  double frequency = 0;       ///< Hz
  double gap_share = 0;       ///< -
  bool open        = false;   ///< of the stand without strip
  std::vector<double> shape;  ///< (6) M1..M6 from above, largest as 1
};

/// What one per cent of a spring or a mass does to a frequency.
struct QuickMove {
  std::string input, mode;  ///< "K1", key of the mode
  double slope = 0;         ///< -, d ln f/d ln input
};

/// What a case means by closed forms alone: the numbers of `millstand trace` and `sweep --model quick`, the modes
/// of the six masses, and the critical speed on them.  theory.md 24, 25, 27.6
struct QuickAnswer {
  std::vector<ClosedFormResult> results;
  std::vector<QuickMode> modes;
  std::vector<QuickMove> moves;  ///< of gap modes, by falling |slope|
  std::vector<SpeedVerdict> speeds;
};

/// @param memory  of earlier answers: bearings and records are kept in it
/// @throws InputError, SolverError  as closed_form_chain
/// Cost: 0.05 to 0.2 s.
QuickAnswer quick_answer(const Case &the_case, ClosedFormMemory &memory, bool with_speeds = true);

/// POST /quick.
nlohmann::ordered_json quick_json(const QuickAnswer &answer);
}  // namespace mill::studio
