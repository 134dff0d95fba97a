#pragma once
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"
#include "dynamics/response/mill_model.h"
#include "twin/live/engine/detailed_twin.h"
#include "twin/live/engine/stepped_stand.h"
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mill::live {
/// The stand that runs in parallel with the mill.
struct TwinModel {
  std::string name;    ///< of the case
  std::string source;  ///< "six masses by closed forms at 976.2 kN", "six masses as given"
  LumpedModel chain;   ///< SI; of a detailed stand its springs alone, see DetailedTwin::connection
  DynamicsSettings dynamics;
  std::string hash;           ///< of the resolved case: state and recordings say what they belong to
  double load       = 0;      ///< N, at which its springs were taken; NaN: not known
  bool follows_load = false;  ///< the case says how the springs change with the force
  std::string adopted;        ///< file of the proposal whose springs and damping these are; empty: the case's own
  std::shared_ptr<const DetailedTwin> detailed = nullptr;       ///< null: the six masses of `chain`
  std::optional<LumpedModel> six_masses        = std::nullopt;  ///< behind a detailed stand of a drawing
};

/// "six-mass", "beam".
std::string name_of_model(const TwinModel &model);

/// What was changed of it on the run: factors on the model's own values.
struct Tuning {
  std::array<double, 7> spring{1, 1, 1, 1, 1, 1, 1};  ///< -, on K1..K7
  double damping = 1;                                 ///< -, on the modal damping ratio
};
bool operator==(const Tuning &a, const Tuning &b);

/// "K1".."K7", "damping".
const std::vector<std::string> &slider_keys();
/// @param key  of slider_keys(); another one changes nothing
void set_factor(Tuning &tuning, const std::string &key, double factor);
double factor_of(const Tuning &tuning, const std::string &key);

/// Springs with the factors; settings with that of the damping.
LumpedModel tuned_chain(const TwinModel &model, const Tuning &tuning);
DynamicsSettings tuned_dynamics(const TwinModel &model, const Tuning &tuning);
/// The six masses with both.  theory.md (6.1)
dynamics::MillModel tuned(const TwinModel &model, const Tuning &tuning);
/// The detailed stand with both, in its lowest modes.
StandModel tuned_stand(const TwinModel &model, const Tuning &tuning);
/// What is stepped: the detailed stand, else the six masses.  theory.md 48.7
SteppedStand stepped(const TwinModel &model, const Tuning &tuning);

/// Modes that are followed in the records, and what the springs do in them.
struct TwinModes {
  Eigen::VectorXd frequency;     ///< (k) Hz
  Eigen::MatrixXd strain_share;  ///< (k, 7) -, of K1..K7
};
TwinModes watched_modes(const TwinModel &model, const Tuning &tuning);
}  // namespace mill::live
