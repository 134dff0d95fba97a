#include "reduce/bite/slab/curves.h"

namespace mill::bite {
Eigen::VectorXd curve_positions(const double exit, const double neutral, const double entry, const int n)
{
  Eigen::VectorXd x(2 * n - 1);
  for (int i = 0; i < n; ++i) {
    x[i]         = exit + (neutral - exit) * i / (n - 1);
    x[n - 1 + i] = neutral + (entry - neutral) * i / (n - 1);
  }
  return x;
}

void fill_curves(BiteState &state, const PassInputs<double> &in, const double entry_speed)
{
  const Eigen::Index n = state.position.size();
  state.thickness.resize(n);
  state.slip.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x     = state.position[i];
    state.thickness[i] = in.exit_thickness + x * x / in.radius;
    state.slip[i]      = strip_speed(in, entry_speed, state.arc_length, x) / in.roll_speed - 1;
  }
}

void forget_unknown_speeds(const RollBite &bite, BiteState &state)
{
  if (std::isnan(bite.roll_speed))
    for (const Input unknown : {Input::roll_speed, Input::gap_rate})
      state.force_by[int(unknown)] = state.torque_by[int(unknown)] = not_given;
}
}  // namespace mill::bite
