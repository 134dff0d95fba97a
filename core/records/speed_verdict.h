#pragma once
#include "core/base/parameter.h"
#include "core/base/warning.h"
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace mill {
/// What a run says first of a pass: how far its speed is from the critical one.
enum class SpeedFinding {
  below,        ///< the pass runs below its critical speed
  unstable,     ///< above it, or unstable at every speed of the range
  stable,       ///< nothing grows at any speed of the range
  not_searched  ///< a key is missing, or the bite does not converge
};

/// An input that may be off, as the critical speed feels it.
struct SpeedInput {
  std::string name;  ///< "friction", "K3_and_K5": numbers that move together
  double error = 0;  ///< -, relative, half of 95 %
  double slope = 0;  ///< -, d ln(critical speed)/d ln(input)
};

/// The finding with its numbers; run.json holds it under "critical_speed", the words are those of sentence_of().
struct SpeedVerdict {
  SpeedFinding finding = SpeedFinding::not_searched;
  std::string pass;                                            ///< its name
  double speed    = std::numeric_limits<double>::quiet_NaN();  ///< m/s, of the pass
  double critical = std::numeric_limits<double>::quiet_NaN();  ///< m/s; NaN: there is none in the range
  double low      = std::numeric_limits<double>::quiet_NaN();  ///< m/s, 95 % interval; NaN: below the range
  double high     = std::numeric_limits<double>::quiet_NaN();  ///< m/s; NaN: above the range
  std::array<double, 2> by_inputs{std::numeric_limits<double>::quiet_NaN(),
                                  std::numeric_limits<double>::quiet_NaN()};  ///< m/s, low and high before the
                                                                              ///< other models widen them
  /// m/s, the last stable and the first unstable speed around speeds without an answer, if the critical speed lies
  /// between them; NaN otherwise
  std::array<double, 2> gap{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  std::vector<SpeedInput> inputs;                               ///< the one that moves the speed most first
  std::array<double, 2> range{};                                ///< m/s, searched
  std::string mode;                                             ///< "gap mode at 107 Hz (third octave)"
  double frequency = std::numeric_limits<double>::quiet_NaN();  ///< Hz, of the mode that becomes unstable first
  double damping   = std::numeric_limits<double>::quiet_NaN();  ///< -, of the gap mode at the speed of the pass
  double growth    = std::numeric_limits<double>::quiet_NaN();  ///< 1/s, of the least stable mode at that speed
  std::vector<std::string> missing;                             ///< keys: "pass.0.speed"
  std::string cause;                                            ///< why the bite does not converge
  std::string remedy;                                           ///< a sentence; may be empty
  /// 1 - speed/critical; NaN without a critical speed.
  double margin() const;
  /// Below the critical speed by less than its interval reaches down: unstable within the stated errors.
  bool is_doubtful() const;
};

/// Of a pass whose critical speed is not searched because these keys are missing: "pass.0.speed".
SpeedVerdict not_searched(const std::string &pass, double speed, const std::vector<std::string> &missing);

/// The same before a run, as `check` says it.
/// @param place  of the pass
Warning warning_of(const SpeedVerdict &not_searched, const Place &place);

/// "not-searched", "below" ..: the finding as run.json holds it.
const char *id_of(SpeedFinding finding);

/// "At 16.0 m/s, 15 % below the critical speed of 18.9 m/s (15 to 23); the gap mode at 107 Hz (third octave)
/// becomes unstable first."
std::string sentence_of(const SpeedVerdict &verdict);

/// "18.9", m/s: the critical speed with the digits that its interval allows.
std::string speed_digits(const SpeedVerdict &verdict);

/// "15 to 23", "13 to above 30", m/s; empty without an interval.
std::string interval_text(const SpeedVerdict &verdict);

/// "15 %": the size of margin().
std::string margin_text(const SpeedVerdict &verdict);

/// Unstable ones, then by growing margin; passes that were not searched are last.
void worst_first(std::vector<SpeedVerdict> &verdicts);

nlohmann::ordered_json json_of(const SpeedVerdict &verdict);

/// The verdict that json_of() has written, without its inputs and by_inputs.
/// @throws nlohmann::json::exception  an entry of the wrong type
SpeedVerdict speed_verdict_of(const nlohmann::json &json);
}  // namespace mill
