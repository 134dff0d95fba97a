#include "dynamics/response/pass_study.h"

namespace mill::dynamics {
namespace {
constexpr std::array<int, 2> driven_rolls{upper_work_roll, lower_work_roll};

PassStudy studied(const Response &response, const Eigen::MatrixXd &half_rate, const double output_rate)
{
  PassStudy study{response, {}, {}, amplitude_spectral_density(response.force, output_rate), {}};
  for (std::size_t r = 0; r < driven_rolls.size(); ++r) {
    const Eigen::VectorXd roll = response.acceleration.col(driven_rolls[r]);
    study.level[r]             = level(roll);
    study.half_rate[r]         = level(half_rate.col(driven_rolls[r]));
    study.rolls[r]             = amplitude_spectral_density(roll, output_rate);
  }
  return study;
}
}  // namespace

PassStudy pass_study(const DrivenModel &model, const ForceRecord &force, const double output_rate)
{
  return studied(mill_response(model, force, output_rate),
                 mill_response(model, force, 0.5 * output_rate).acceleration, output_rate);
}

PassStudy pass_study(const Response &response, const double output_rate)
{
  const Eigen::MatrixXd &all = response.acceleration;
  return studied(response,
                 Eigen::Map<const Eigen::MatrixXd, 0, Eigen::Stride<Eigen::Dynamic, 2>>(
                     all.data(), (all.rows() + 1) / 2, all.cols(), {all.rows(), 2}),
                 output_rate);
}
}  // namespace mill::dynamics
