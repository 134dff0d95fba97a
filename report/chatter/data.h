#pragma once
#include "core/records/csv.h"
#include "core/model/material.h"
#include "report/page/run.h"
#include <string>
#include <vector>

// What a run stored about chatter: curves/chatter-*.json and the names of the tables beside them.  A number that
// was not stored is NaN, a text or list that was not stored is empty.
namespace mill::report {
/// Whether vibration of a condition begins to grow, and where.
struct ChatterCritical {
  std::string verdict;  ///< crossing | stable | unstable | unstable below | no bite; empty: not stored
  double speed             = not_given;  ///< m/s, of the crossing
  double frequency         = not_given;  ///< Hz
  double growth_at_working = not_given;  ///< 1/s, at the working speed
  double margin            = not_given;  ///< 1/s, growth rate nearest to the other verdict
  double margin_speed      = not_given;  ///< m/s, where that is
  double searched_from     = not_given;  ///< m/s
  double searched_to       = not_given;  ///< m/s
  std::string sentence;                  ///< the same in words, by the run
};

struct ChatterHistoryInfo {
  std::string file;             ///< "response/chatter-2-below"
  double speed    = not_given;  ///< m/s
  double growth   = not_given;  ///< 1/s, real part of the eigenvalue
  double measured = not_given;  ///< 1/s, from the record
};

struct ChatterEventInfo {
  double time = not_given;  ///< s
  std::string what;         ///< "entry strip slack"
};

struct LimitCycleInfo {
  bool stored      = false;
  double speed     = not_given;  ///< m/s
  bool settled     = false;      ///< the amplitude no longer changes
  double amplitude = not_given;  ///< um, half the gap's peak to peak
  double frequency = not_given;  ///< Hz
  std::string stopped;           ///< why the run ended early
  std::string limited_by;        ///< what keeps it from growing on
  std::vector<ChatterEventInfo> events;
};

/// Motion of one point of the stand in the critical mode.
struct ChatterPoint {
  std::string label;
  double amplitude = not_given;  ///< any unit, the same for all points
  double phase     = not_given;  ///< degrees against the gap; 0: away from the strip while the gap opens
};

/// Phases against the gap, degrees, positive ahead of it.
struct ChatterPhases {
  bool stored          = false;
  double frequency     = not_given;  ///< Hz
  double ratio         = not_given;  ///< -, amplitude of the upper over that of the lower work roll
  double force         = not_given;  ///< degrees
  double entry_tension = not_given;  ///< degrees
  double exit_tension  = not_given;  ///< degrees
  double friction      = not_given;  ///< degrees
  std::vector<ChatterPoint> shape;
};

/// One input: logarithmic slopes and the relative changes when it is 10 % lower or higher.
struct ChatterSensitivity {
  std::string key, name;
  double friction_slope = not_given;  ///< -
  double friction_minus = not_given;  ///< -
  double friction_plus  = not_given;  ///< -
  double speed_slope    = not_given;  ///< -
  double speed_minus    = not_given;  ///< -; NaN: no critical speed there
  double speed_plus     = not_given;  ///< -; NaN: no critical speed there
  bool curved           = false;      ///< the slope does not stand for the larger changes of the critical speed
};

/// One way of linearising, one reading or model of the stand.
struct ChatterVariantInfo {
  std::string name, verdict;
  double critical_speed      = not_given;  ///< m/s
  double frequency           = not_given;  ///< Hz
  double growth              = not_given;  ///< 1/s at the working speed
  double ratio               = not_given;  ///< -, upper over lower work roll
  double force_phase         = not_given;  ///< degrees against the gap
  double entry_tension_phase = not_given;  ///< degrees against the gap
  bool upper_moves_more      = false;      ///< upper work roll more than the lower one; meaningless without ratio
};

/// A conclusion that was tried on every variant.
struct ChatterConclusion {
  std::string text, detail;
  bool holds = false;
};

struct ChatterPublished {
  std::string quantity, unit, note;
  double here      = not_given;  ///< in unit
  double published = not_given;  ///< in unit, of a published model
  double measured  = not_given;  ///< in unit
};

struct ChatterCondition {
  std::string name;  ///< as the case calls it
  std::string slug;  ///< curves/chatter-<slug>-*.csv
  std::string scheme;
  double speed     = not_given;  ///< m/s, working speed
  double reduction = not_given;  ///< %, of the condition
  double viscosity = not_given;  ///< mPa s, of the condition
  ChatterCritical critical;
  std::vector<ChatterHistoryInfo> histories;
  LimitCycleInfo limit_cycle;
  ChatterPhases phases;
  std::vector<ChatterSensitivity> sensitivities;
  std::vector<ChatterVariantInfo> schemes, variants, structures;
  std::vector<ChatterConclusion> conclusions;
  std::vector<ChatterPublished> published;
};

/// Several stands with the strip that runs from one to the next.
struct ChatterTandem {
  bool stored = false;
  std::vector<std::string> stands;
  std::string verdict;
  std::string sentence;                    ///< what was found, in words
  std::vector<std::string> sentences;      ///< and what it means
  double critical_speed = not_given;       ///< m/s
  double frequency      = not_given;       ///< Hz
  double without_delay  = not_given;       ///< m/s, thickness waves forgotten on the way
  std::vector<ChatterVariantInfo> single;  ///< each stand alone
  std::vector<ChatterPoint> shape;
};

struct ChatterData {
  std::vector<ChatterCondition> conditions;
  ChatterTandem tandem;
  std::vector<std::string> problems;  ///< files that are there and cannot be used, one sentence each

  bool empty() const;  ///< nothing about chatter is stored
};

/// Reads curves/chatter-*.json and looks which tables lie beside them; a condition without its JSON is one that
/// has tables only.  Conditions come in the order of the results chatter.<condition>.*, the others after them by
/// name. Never throws.
ChatterData read_chatter(const Run &run);

/// curves/chatter-<slug>-<what>.csv; nullptr when not stored.
const Table *chatter_table(const Run &run, const ChatterCondition &condition, const std::string &what);
}  // namespace mill::report
