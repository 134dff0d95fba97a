#pragma once
#include "core/base/note.h"
#include "core/records/advice_goal.h"
#include "core/records/csv.h"
#include "core/records/results.h"
#include "twin/advice/chatter_advice.h"
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mill::twin {
/// A tuned damper with the action it belongs to.
struct TunedRecord {
  std::string action, place;
  double mode_frequency = 0;  ///< Hz
  TunedDamper damper;
};

/// Everything that is written of one advice, for any goal.
struct AdviceRecord {
  std::string case_name;
  std::string stand;  ///< "six masses by closed forms at 976.2 kN"
  RatedGoal goal = RatedGoal::level;
  std::string question;  ///< the goal in words
  std::string answer;    ///< in words
  Results results;
  std::vector<RatedAction> actions;   ///< ranked
  std::vector<RatedAction> what_ifs;  ///< what another damping ratio would do; no action sets it by itself
  std::vector<bool> reaches;          ///< by actions: the wanted margin; empty: the goal has none
  std::vector<TunedRecord> tuned;
  std::vector<std::pair<std::string, double>> slopes;  ///< d ln goal / d ln number, by falling size
  std::vector<Note> notes;                             ///< what was not computed, and why
  std::map<std::string, Table> tables;                 ///< "spectrum", "detuning"
};

/// advice.json: results.json with goal, actions, tuned dampers, slopes and notes; NaN is null.
std::string advice_json(const AdviceRecord &record);

/// advice.csv: one line for each action, ranked, then the what-ifs; changes in percent.
std::string advice_csv(const AdviceRecord &record);
}  // namespace mill::twin
