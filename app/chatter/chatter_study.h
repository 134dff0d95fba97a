#pragma once
#include "app/run/run_context.h"
#include "core/case/chatter_inputs.h"
#include "core/model/chatter.h"
#include "dynamics/chatter/history.h"
#include "dynamics/chatter/map.h"
#include "dynamics/chatter/modes.h"
#include "dynamics/chatter/run.h"
#include "dynamics/chatter/sensitivity.h"
#include "dynamics/chatter/speed.h"
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mill {
/// A stand that a condition is asked of, by the name it has in the report.
struct NamedStand {
  std::string name;
  dynamics::ChatterStandModel stand;
  std::vector<dynamics::StructureNumber> numbers = {};  ///< of its structure, for what moves the limit
  KeyList inputs = {};  ///< keys behind the results on it; empty: those of the question
};

/// The keys behind a result.
using ChatterInputs = std::function<KeyList(ChatterReading reading, const ResultRow &row)>;

/// What is asked of one working condition.
struct ChatterQuestion {
  RollingCondition condition;
  std::string label;  ///< "condition 2", "pass 1": as sentences call it
  bite::RollBite bite;
  dynamics::ChatterStandModel stand;
  bool speed_assumed = false;  ///< the case does not give the working speed: it is not judged
  std::string structure;       ///< where the stand comes from: "given", "six-mass model of this run"
  Linearisation scheme = Linearisation::sequential;
  ChatterAnalysis analysis;
  std::array<double, 2> film_range = {not_given, not_given};  ///< m
  std::vector<dynamics::StructureNumber> numbers;             ///< of the stand's structure
  std::vector<NamedStand> variants;                           ///< other readings of the same stand
  /// Models of the same stand.  With more than one the first, the most detailed one, becomes `stand` in
  /// study_chatter().
  std::vector<NamedStand> structures;
  KeyList inputs;           ///< keys behind the results
  ChatterInputs inputs_of;  ///< behind one that reads less; empty: all have those above
};

/// The search by another scheme or on another stand.
struct OtherSearch {
  std::string name;
  dynamics::StandSpeed found;
  std::optional<dynamics::ChatterMode> mode;  ///< critical one
  double growth = not_given;                  ///< 1/s, at the working speed
};

/// A history and the speed it belongs to.
struct ChatterRecord {
  HistorySpeed place;          ///< names the file
  double speed   = 0;          ///< m/s
  double growth  = 0;          ///< 1/s, of the eigenvalue
  double in_time = not_given;  ///< 1/s, of the record
  dynamics::ChatterHistory history;
};

/// Range that analysis.speeds asks for, with its steps.
dynamics::SpeedRange chatter_range(const ChatterQuestion &question);

/// The bite at the working speed and the critical speed, nothing else.
struct ChatterSearch {
  std::optional<dynamics::WorkingPoint> working;  ///< absent: no steady bite there
  std::string no_bite;                            ///< why
  dynamics::StandSpeed found;
  double growth = not_given;  ///< 1/s, at the working speed
};
/// @throws SolverError  no bite at any speed of the range
ChatterSearch search_chatter(const ChatterQuestion &question);

/// One condition, computed.
struct ChatterStudy : ChatterSearch {
  ChatterQuestion question;
  std::optional<bite::BiteState> karman;  ///< the same bite by the slab equation without simplification
  std::optional<dynamics::ChatterMode> working_mode;  ///< least stable one at the working speed
  std::optional<dynamics::RecordMode> in_time;        ///< the same mode in a record of the time simulation there
  std::optional<dynamics::ChatterMode> mode;          ///< at the critical speed, else at the working speed
  int routh_unstable = -1, nyquist_unstable = -1;     ///< roots that grow at the working speed; -1: not counted
  double speed_by_routh = not_given;                  ///< m/s
  /// The question's own scheme or stand first; of the structures the most detailed.
  std::vector<OtherSearch> schemes, variants, structures;
  dynamics::RootLocus locus;
  std::vector<dynamics::StabilityMap> maps;
  std::optional<dynamics::SensitivityTable> sensitivities;
  std::vector<ChatterRecord> records;
  std::optional<dynamics::ChatterRun> run;  ///< nonlinear, above the critical speed
  dynamics::LimitCycle cycle;
  double run_speed    = not_given;    ///< m/s
  double run_force    = not_given;    ///< N, steady force there
  double run_friction = not_given;    ///< -
  std::vector<std::string> contacts;  ///< roll contacts of the run, by name
  std::vector<std::string> remarks;   ///< what could not be had and why, one sentence each
};

/// Critical speeds of the models of one stand.
struct ModelBand {
  double low = not_given, high = not_given;  ///< m/s, of those that have one
  std::vector<std::string> without;          ///< models without one, with their verdict: "beam stable"
};
ModelBand band_of(const std::vector<OtherSearch> &structures);

/// Everything about one condition, on the most detailed of the models of its stand.  theory.md 25.7
/// @throws InputError, SolverError  no bite at any speed of the range
ChatterStudy study_chatter(RunContext &run, const ChatterQuestion &question);
}  // namespace mill
