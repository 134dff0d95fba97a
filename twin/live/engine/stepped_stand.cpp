#include "twin/live/engine/stepped_stand.h"
#include "core/base/errors.h"
#include "dynamics/response/modal_model.h"
#include "dynamics/response/modes.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mill::live {
SteppedStand stepped_stand(const dynamics::MillModel &chain)
{
  const dynamics::Modes modes = dynamics::modes(chain);
  return {chain.labels,
          dynamics::state_space(chain),
          modes.frequency,
          modes.shape,
          modes.shape.transpose() * chain.M.asDiagonal(),
          modes.shape,
          dynamics::static_displacement(chain)};
}

SteppedStand stepped_stand(const StandModel &stand, const double highest, const double damping,
                           const double gap_damper)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric_part(stiffness_of(stand)));
  if (solver.info() != Eigen::Success || !(solver.eigenvalues()[0] > 0))
    throw SolverError({"the springs of the twin do not hold the stand", stand.name,
                       "a spring between two parts, or to the ground, is zero",
                       "give every spring of the stand a value above zero", ""});
  const Eigen::VectorXd hertz = solver.eigenvalues().cwiseSqrt() / (2 * M_PI);
  const dynamics::ModalModel modes =
      dynamics::modal_model(stand, hertz, solver.eigenvectors(), damping, highest, gap_damper);
  const Eigen::MatrixXd V   = solver.eigenvectors().leftCols(modes.frequency.size());
  const Eigen::VectorXd rad = 2 * M_PI * modes.frequency;
  return {modes.labels,
          dynamics::state_space(modes),
          modes.frequency,
          V,
          V.transpose(),
          modes.point,
          V * modes.force.cwiseQuotient(rad.cwiseAbs2())};
}

std::vector<std::string> places_of(const SteppedStand &stand)
{
  std::vector<std::string> places = stand.labels;
  for (std::string &place : places)
    std::replace_if(
        place.begin(), place.end(), [](const char c) { return c == ' ' || c == '-'; }, '_');
  return places;
}

double settling_time(const SteppedStand &stand)
{
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(stand.system.A, false);
  const double slowest = -solver.eigenvalues().real().maxCoeff();  // 1/s, decay
  if (!(slowest > 1e-9 * stand.frequency[0]))
    throw InputError(
        "millstand live: the case has no damping, so that the twin would never forget how it started; "
        "give dynamics.modal_damping, for example --set dynamics.modal_damping=\"1 %\"");
  return 5 / slowest;
}
}  // namespace mill::live
