#pragma once
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"
#include "dynamics/response/mill_model.h"
#include <array>
#include <string>
#include <vector>

namespace mill::live {
/// The stand that runs in parallel with the mill.
struct TwinModel {
  std::string name;    ///< of the case
  std::string source;  ///< "six masses by closed forms at 976.2 kN", "six masses as given"
  LumpedModel chain;   ///< SI
  DynamicsSettings dynamics;
  std::string hash;           ///< of the resolved case: state and recordings say what they belong to
  double load       = 0;      ///< N, at which its springs were taken; NaN: not known
  bool follows_load = false;  ///< the case says how the springs change with the force
  std::string adopted;        ///< file of the proposal whose springs and damping these are; empty: the case's own
};

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
/// The model of both.  theory.md (6.1)
dynamics::MillModel tuned(const TwinModel &model, const Tuning &tuning);

/// "upper_work_roll", in the order of the masses.
std::vector<std::string> places_of(const dynamics::MillModel &model);

/// s, after which a free motion of the slowest mode has died out to e^-5.  theory.md (48.6)
/// @throws InputError  the model has no damping, so that a start would be seen for ever
double settling_time(const dynamics::MillModel &model);
}  // namespace mill::live
