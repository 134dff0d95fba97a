#include "twin/live/engine/twin_model.h"
#include "core/base/errors.h"
#include "dynamics/response/modes.h"
#include <algorithm>
#include <cmath>

namespace mill::live {
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

std::vector<std::string> places_of(const dynamics::MillModel &model)
{
  std::vector<std::string> places = model.labels;
  for (std::string &place : places)
    std::replace(place.begin(), place.end(), ' ', '_');
  return places;
}

double settling_time(const dynamics::MillModel &model)
{
  double slowest = std::numeric_limits<double>::infinity();  // 1/s, decay
  for (const dynamics::Pole &pole : dynamics::poles(model))
    slowest = std::min(slowest, pole.damping * 2 * M_PI * pole.frequency);
  if (!(slowest > 0))
    throw InputError(
        "millstand live: the case has no damping, so that the twin would never forget how it started; "
        "give dynamics.modal_damping, for example --set dynamics.modal_damping=\"1 %\"");
  return 5 / slowest;
}
}  // namespace mill::live
