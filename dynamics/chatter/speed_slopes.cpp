#include "dynamics/chatter/speed_slopes.h"
#include <algorithm>
#include <utility>

namespace mill::dynamics {
namespace {
double sum_of(const bite::PerPassNumber<double> &by, const VariedInput &varied)
{
  double sum = 0;
  for (const bite::PassNumber number : varied.bite)
    sum += by[std::size_t(number)];
  return sum;
}
}  // namespace

VariedInput roll_speed_input()
{
  return {"", "", "", 0, {bite::PassNumber::roll_speed}};
}

double Slopes::growth(const VariedInput &varied) const
{
  const Eigen::Index n = stand.structure.n();
  double sum           = 0;
  for (const bite::PassNumber number : varied.bite)
    sum += eigenvalue.by(chatter_matrix_by(stand, pass.by[std::size_t(number)])).real();
  if (varied.structure)
    sum += eigenvalue.by(chatter_matrix_by(stand, point.by, *varied.structure)).real();
  const auto row = [&](const Eigen::Index i) {  // the row of a tension goes with E/L
    Eigen::MatrixXd A_by = Eigen::MatrixXd::Zero(A.rows(), A.cols());
    A_by.row(i)          = A.row(i);
    return eigenvalue.by(A_by).real();
  };
  if (varied.entry_distance)
    sum -= row(2 * n);
  if (varied.exit_distance)
    sum -= row(2 * n + 1);
  if (varied.strip_modulus)
    sum += row(2 * n) + row(2 * n + 1);
  return sum;
}

double Slopes::friction(const VariedInput &varied) const
{
  return sum_of(pass.friction, varied) / point.state.friction;
}

double Slopes::force(const VariedInput &varied) const
{
  return sum_of(pass.force, varied) / point.state.force;
}

Slopes slopes_at(const ChatterStandModel &stand, const bite::RollBite &bite, const Linearisation scheme,
                 const double speed, const Crossing *crossing)
{
  WorkingPoint point                  = working_point(bite, speed, scheme);
  const auto pass                     = linear_sensitivity(point.bite, point.state, scheme);
  const auto A                        = chatter_matrix(stand, point.by);
  const std::complex<double> critical = crossing ? crossing->root : eigenvalues(A)[0];
  return {std::move(point), pass, A, slope_of_eigenvalue(A, critical), stand};
}

double speed_slope(const Slopes &slopes, const VariedInput &varied)
{
  static const VariedInput speed = roll_speed_input();
  const double growth            = slopes.growth(varied);
  return growth == 0 ? 0 : -growth / slopes.growth(speed);  // no -0
}

const Crossing &critical_crossing(const CriticalSpeed &critical)
{
  return *std::find_if(critical.crossings.begin(), critical.crossings.end(),
                       [&](const Crossing &c) { return c.speed == critical.speed; });
}
}  // namespace mill::dynamics
