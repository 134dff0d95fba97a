#pragma once
#include "dynamics/response/mill_model.h"
#include "twin/advice/changed_stand.h"
#include "twin/advice/joined_stand.h"
#include "twin/advice/level_slopes.h"
#include "twin/advice/rolled_level.h"
#include "twin/advice/tuned_damper.h"
#include <Eigen/Core>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

// Actions that would lower the vibration of a stand: each one recomputed, with the linear estimate.  theory.md 46
namespace mill::twin {
/// A side effect of an action.
struct SideEffect {
  std::string name;  ///< "lower work roll, level"
  double value;      ///< in `unit`
  std::string unit;  ///< "1": a relative change
};

/// One action, or two together, with what it really does.
struct RatedAction {
  std::string name;                     ///< "K3 x 0.8"
  std::vector<std::string> parameters;  ///< what is changed, "K3"; two actions on one of them are no pair
  std::string means;                    ///< what could bring the change about
  double change      = 0;               ///< -, relative change of the goal, recomputed
  double spread      = std::numeric_limits<double>::quiet_NaN();  ///< -, sd of the change by errors of the stand
  double verified    = 0;  ///< -, the change that decides: in the most detailed model, with its least effect there
  double first_order = 0;  ///< -, what the slopes say; never the answer
  double apart = std::numeric_limits<double>::quiet_NaN();  ///< -, of a pair: both changes one after the other
  double gain  = 0;                                         ///< -, > 0: it helps; what actions are ranked by
  std::vector<SideEffect> effects;
  std::string modes;                      ///< which mode moves most, in words
  std::vector<std::string> against;       ///< what it violates, one sentence each; empty: above the line
  std::vector<std::string> remarks;       ///< what the number rests on, one sentence each
  std::optional<std::size_t> chain_only;  ///< which remark says that its effect is known of six masses alone
  bool pair       = false;
  bool what_if    = false;         ///< a damping ratio, which no action sets by itself: listed apart, never paired
  bool kept_apart = false;         ///< violates what no partner can mend: it is not paired
  std::vector<Attachment> joined;  ///< dampers that it adds
  std::vector<SideEffect> repeated;    ///< the same change in other models of the stand, by their names
  StandChange of_stand;                ///< what it does to springs and damping
  std::vector<ProcessAction> process;  ///< and to the pass
  double nearer = std::numeric_limits<double>::quiet_NaN();  ///< -, change of critical over working speed
  VibratingStand stand;  ///< after it, without `joined` and process; empty for a critical speed
};

/// The gain of an action on a level by its verified change, and whether it helps at all.
void judge_gain(RatedAction &action);

/// Whether an action on a level brings the critical speed too near.
/// @param allowed  -, most that critical over working speed may fall
void judge_nearer(RatedAction &action, double allowed);

/// Best first: those that help and violate nothing, then the others, by falling gain.
void rank(std::vector<RatedAction> &actions);
std::size_t above_the_line(const std::vector<RatedAction> &ranked);

/// A stand of which advice is asked.
struct AdvisedStand {
  VibratingStand stand;
  std::optional<dynamics::MillModel> chain;  ///< whose springs may be changed; none for a stand in files
  OpenStand open;                            ///< it without its bite; empty where no pass is asked
};

/// A spring of the chain and the factors on it that are tried; 1 is not tried.
struct SpringChoice {
  std::string name;
  double softer = 0.8, stiffer = 1.2;  ///< -
  std::string means;
};

/// Dampers that are one action.
struct DamperChoice {
  std::string name;
  std::vector<Attachment> joined;
};

/// A tuned damper.
struct TunedChoice {
  int place_index   = -1;
  double mass       = std::numeric_limits<double>::quiet_NaN();  ///< kg; NaN: by the ratio
  double mass_ratio = 0.05;  ///< -, over the effective mass of the leading mode
};

/// A parameter that records do not identify, and the source of this statement.
struct UnidentifiedParameter {
  std::string name;  ///< "K2", "zeta"
  std::string why;
};

struct LevelQuestion {
  int place = dynamics::upper_work_roll;  ///< whose level is to fall
  ForceBand force;
  std::vector<SpringChoice> springs;
  std::array<double, 2> damping = {1, 1};  ///< -, factors on the damping ratio of all modes
  std::vector<DamperChoice> dampers;
  std::vector<TunedChoice> tuned;
  double rise_elsewhere = 0.10;    ///< -, most that the level of another roll may rise
  double softening      = 0.10;    ///< -, most that the stiffness of the stand under the bite force may fall
  std::optional<RolledPass> pass;  ///< that it rolls; needs AdvisedStand::open
  int paired = 3;                  ///< so many of the best single actions are tried in pairs
  std::vector<UnidentifiedParameter> unidentified;
  std::map<std::string, double> spring_error;  ///< -, relative sd of springs; one that is not there counts 10 %
  double damping_error = 0.7;                  ///< -, sd of ln of the damping ratios: a factor of two
};

struct LevelAdvice {
  int place = 0;
  VibratingStand stand;                  ///< as it is
  Eigen::VectorXd level;                 ///< (m) m/s2, of every place as it is
  std::optional<CriticalState> pass;     ///< as it is
  LevelSlopes slopes;                    ///< empty without a chain
  std::vector<RatedAction> actions;      ///< ranked
  std::vector<std::string> tuned_names;  ///< by `tuned`, names of the single actions
  std::vector<TunedDamper> tuned;
};

/// Single actions at their bounds, then pairs of the best, each with the response of the changed stand, and with
/// its critical speed where a pass is given.  (46.1) ff.
/// @throws InputError  a mode without damping; a place that is none
/// Cost: 20 ms for each action and 0.3 s for each tuned damper with 50 000 frequencies and six masses.
LevelAdvice level_advice(const AdvisedStand &advised, const LevelQuestion &question);

/// What a page asks: all springs of the chain by +-20 %, dampers of 1e5 N s/m between the rolls, one tuned damper
/// of 5 %, under white force from `low` to `high` (Hz).
LevelQuestion usual_question(const AdvisedStand &advised, double low = 0, double high = 1000);

/// Actions on a chain by rank, for a page that asks often.
/// @param damping     (n) -, ratio of critical of every mode
/// @param gap_damper  N s/m, of the bite
/// Cost: below 0.3 s with the force of usual_question().
LevelAdvice ranked_actions(const dynamics::MillModel &model, const Eigen::VectorXd &damping,
                           const LevelQuestion &question, double gap_damper = 0);

/// Hz: a step of frequencies at which sums over resonances are exact to 1e-9, a quarter of the least half width;
/// never less than a 200 000th of `high`.
double resolving_step(const VibratingStand &stand, double high);

/// Dampers that are tried where the case names no damper: work roll to backup roll (each and both), work roll to
/// work roll.
std::vector<DamperChoice> usual_dampers(const VibratingStand &stand, double damper);

/// What could change a spring of the chain, in words.
std::string means_of_spring(const std::string &name);

/// "damper 100 kN s/m, upper work roll to upper backup roll"
std::string damper_name(const VibratingStand &stand, const Attachment &damper);
}  // namespace mill::twin
