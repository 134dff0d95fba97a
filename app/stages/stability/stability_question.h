#pragma once
#include "app/run/run_context.h"
#include "core/case/provenance.h"
#include "core/model/chatter.h"
#include "core/records/speed_verdict.h"
#include "dynamics/chatter/speed_interval.h"
#include <functional>
#include <string>
#include <utility>
#include <vector>

// Critical speed of a pass of any stand that has masses, dampers, springs and a gap.  theory.md 25, 27.6
namespace mill {
/// Range that analysis.speeds asks for, with its steps.
dynamics::SpeedRange speed_range(const ChatterAnalysis &analysis);

/// A pass at its speed on the leading model of its stand: whoever has M, C, K and the row of the gap can ask.
struct StabilityQuestion {
  std::string pass;   ///< its name
  double speed = 0;   ///< m/s
  std::string model;  ///< of leading.stand: "rolls as reduced finite elements"
  dynamics::SpeedQuestion leading;
  double K4 = not_given;  ///< N/m, K4.combined of the pass, for its gap mode; NaN: slope of the linear bite
  /// Other models of the same stand by name; the spread of their critical speeds widens the interval.
  std::vector<std::pair<std::string, dynamics::ChatterStandModel>> others = {};
  std::vector<dynamics::UncertainNumber> uncertain                        = {};
  std::string assumed = {};  ///< which of these errors the case does not state: a sentence
  KeyList inputs      = {};  ///< keys behind the results
};

/// The verdict alone.
SpeedVerdict speed_verdict(const StabilityQuestion &question);

/// chatter.<pass>.critical_speed with its interval and the mode that becomes unstable, growth rate and damping of
/// the gap mode at the speed of the pass, and the verdict.  A bite without a steady state is a sentence of the
/// verdict, not a failure.
void add_critical_speed(RunContext &run, const StabilityQuestion &question);

/// The same of one pass of a stand: where keys are missing the verdict names them, a question or a search that is
/// refused is a warning, so that the other passes have an answer.
/// @param speed     m/s, of the pass; NaN where it is not given
/// @param missing   keys, "pass.0.speed"
/// @param question  called where nothing is missing
void search_critical_speed(RunContext &run, const std::string &pass, double speed,
                           const std::vector<std::string> &missing,
                           const std::function<StabilityQuestion()> &question);
}  // namespace mill
