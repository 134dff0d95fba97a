#include "twin/live/engine/twin_model.h"
#include "dynamics/response/modes.h"
#include <algorithm>
#include <cmath>

namespace mill::live {
std::string name_of_model(const TwinModel &model)
{
  return model.detailed ? model.detailed->whole.name : "six-mass";
}

bool operator==(const Tuning &a, const Tuning &b)
{
  return a.spring == b.spring && a.damping == b.damping;
}

const std::vector<std::string> &slider_keys()
{
  static const std::vector<std::string> keys{"K1", "K2", "K3", "K4", "K5", "K6", "K7", "damping"};
  return keys;
}

void set_factor(Tuning &tuning, const std::string &key, const double factor)
{
  const auto &keys = slider_keys();
  const auto index = std::size_t(std::find(keys.begin(), keys.end(), key) - keys.begin());
  if (index < tuning.spring.size())
    tuning.spring[index] = factor;
  else if (index < keys.size())
    tuning.damping = factor;
}

double factor_of(const Tuning &tuning, const std::string &key)
{
  const auto &keys = slider_keys();
  const auto index = std::size_t(std::find(keys.begin(), keys.end(), key) - keys.begin());
  return index < tuning.spring.size() ? tuning.spring[index] : tuning.damping;
}

LumpedModel tuned_chain(const TwinModel &model, const Tuning &tuning)
{
  LumpedModel chain = model.chain;
  for (std::size_t i = 0; i < chain.K.size(); ++i)
    chain.K[i].value *= tuning.spring[i];
  return chain;
}

DynamicsSettings tuned_dynamics(const TwinModel &model, const Tuning &tuning)
{
  DynamicsSettings settings = model.dynamics;
  settings.modal_damping *= tuning.damping;
  return settings;
}

dynamics::MillModel tuned(const TwinModel &model, const Tuning &tuning)
{
  return dynamics::mill_model(tuned_chain(model, tuning), tuned_dynamics(model, tuning));
}

StandModel tuned_stand(const TwinModel &model, const Tuning &tuning)
{
  return with_springs(model.detailed->stand, *model.detailed, tuned_chain(model, tuning));
}

SteppedStand stepped(const TwinModel &model, const Tuning &tuning)
{
  if (!model.detailed)
    return stepped_stand(tuned(model, tuning));
  return stepped_stand(tuned_stand(model, tuning), model.detailed->highest,
                       tuned_dynamics(model, tuning).modal_damping, model.detailed->gap_damper);
}

TwinModes watched_modes(const TwinModel &model, const Tuning &tuning)
{
  if (!model.detailed) {
    const dynamics::Modes modes = dynamics::modes(tuned(model, tuning));
    return {modes.frequency, modes.strain_share};
  }
  const StandModel stand     = tuned_stand(model, tuning);
  const SteppedStand modes   = stepped_stand(stand, model.detailed->watched, 0, 0);
  const Eigen::VectorXd rad2 = (2 * M_PI * modes.frequency).cwiseAbs2();
  TwinModes watched{modes.frequency, Eigen::MatrixXd::Zero(modes.frequency.size(), 7)};
  for (const Connection &c : stand.connections)
    for (std::size_t j = 0; j < model.detailed->connection.size(); ++j)
      if (c.name == model.detailed->connection[j]) {
        const Eigen::MatrixXd strain = c.rows * modes.shape;
        watched.strain_share.col(Eigen::Index(j)) =
            (c.stiffness.transpose() * strain.cwiseAbs2()).transpose().cwiseQuotient(rad2);
      }
  return watched;
}
}  // namespace mill::live
