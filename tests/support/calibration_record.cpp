#include "tests/support/calibration_record.h"
#include "dynamics/response/modes.h"
#include "tests/support/reference.h"
#include "tests/support/synthetic_record.h"
#include <algorithm>
#include <cmath>

using namespace mill;

namespace calibration {
LumpedModel set_r()
{
  const auto in = reference("plan.inputs", "twin");
  LumpedModel model;
  for (std::size_t i = 0; i < 6; ++i)
    model.M[i].value = in["M"][i];
  for (std::size_t i = 0; i < 7; ++i)
    model.K[i].value = in["K"][i];
  return model;
}

dynamics::MillModel chain_of(const LumpedModel &model, const FrameForm frame)
{
  DynamicsSettings settings;
  settings.force_meaning = ForceMeaning::measured;
  settings.frame         = frame;
  settings.modal_damping = 0.01;
  return dynamics::mill_model(model, settings);
}

twin::FittedStand stand_r()
{
  return {chain_of(set_r()), Eigen::VectorXd::Constant(6, 0.01)};
}

std::vector<twin::Unknown> unknowns_r()
{
  const auto prior = reference("plan.inputs", "twin")["prior_sd"];
  std::vector<twin::Unknown> unknowns;
  for (const auto &[name, sd] : prior.items())
    unknowns.push_back({name, sd, 0});
  return unknowns;
}

Recipe Recipe::check() const
{
  Recipe other = *this;
  other.seed += 500;
  other.force_rms *= 1.4;
  return other;
}

Recipe recipe(const std::string &name)
{
  const auto in = reference("calibrate." + name + ".inputs", "twin");
  Recipe made{in["truth"].get<std::map<std::string, double>>(),
              in["seed"],
              Eigen::Index(std::lround(in["T"].get<double>() * in["fs"].get<double>())),
              in["fs"],
              in["force_rms"],
              in["force_band"][1],
              in["density"],
              {},
              name == "closed" ? FrameForm::closed : FrameForm::open,
              in["F0"]};
  const auto labels = chain_of(set_r()).labels;
  for (std::string place : in["sensors"].get<std::vector<std::string>>()) {
    std::replace(place.begin(), place.end(), '_', ' ');
    made.places.push_back(std::find(labels.begin(), labels.end(), place) - labels.begin());
  }
  return made;
}

Record record(const Recipe &recipe)
{
  LumpedModel model = set_r();
  double zeta       = 0.01;
  std::map<std::size_t, double> of_mode;  // ln of the factor on the ratio of a mode
  for (const auto &[name, value] : recipe.truth) {
    if (name.rfind("zeta", 0) == 0 && name.size() > 4)
      of_mode[std::size_t(name[4] - '1')] = value;
    else if (name == "zeta")
      zeta *= std::exp(value);
    else
      (name[0] == 'M' ? model.M[std::size_t(name[1] - '1')] : model.K[std::size_t(name[1] - '1')]).value *=
          std::exp(value);
  }
  const auto stand_modes = dynamics::modes(chain_of(model, recipe.frame));
  const auto force =
      synthetic::band_force(recipe.seed, recipe.n, recipe.rate, recipe.force_rms, 0, recipe.highest);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(recipe.n, 6);
  if (of_mode.empty())
    all = synthetic::response({stand_modes.frequency, stand_modes.shape, {}, {}, zeta}, force.drive, recipe.rate);
  for (Eigen::Index i = 0; i < 6 && !of_mode.empty(); ++i) {
    const auto other           = of_mode.find(std::size_t(i));
    const double ratio         = zeta * (other == of_mode.end() ? 1 : std::exp(other->second));
    const Eigen::VectorXd gain = stand_modes.shape.col(i).transpose() * chain_of(model, recipe.frame).b;
    all += synthetic::modal_response(stand_modes.frequency.segment(i, 1), gain, ratio, force.drive, recipe.rate) *
           stand_modes.shape.col(i).transpose();
  }
  Record made{force.force.array() + recipe.mean_force, {}};
  made.acceleration.resize(recipe.n, Eigen::Index(recipe.places.size()));
  for (std::size_t j = 0; j < recipe.places.size(); ++j)
    made.acceleration.col(Eigen::Index(j)) =
        all.col(recipe.places[j]) +
        synthetic::white(recipe.seed + 1000 + j, recipe.n, recipe.rate, recipe.density);
  return made;
}

twin::MeasuredResponse measured(const Recipe &recipe, const double low, const double high)
{
  twin::Fourier fourier;
  const Record made = record(recipe);
  return {{twin::band_record(made.force, made.acceleration, recipe.rate, low, high, fourier)}, recipe.places};
}
}  // namespace calibration
