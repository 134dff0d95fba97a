#include "fem/strip/bite_numbers.h"
#include "core/base/errors.h"
#include "core/numerics/difference.h"
#include "core/numerics/mesh_pair.h"
#include "core/records/bite_model.h"
#include "reduce/bite/slab/slab_bite.h"
#include <algorithm>
#include <cmath>

namespace mill::fem {
namespace {
constexpr const char *theories[] = {"karman", "orowan", "bland-ford", "hu-ehmann"};

// The slab theory that is compared with the finite elements, or another one where it has no solution.
const BiteAnswer *slab_beside(const BiteStudy &s)
{
  if (s.slab().refused.empty())
    return &s.slab();
  for (const char *key : theories)
    if (const BiteAnswer *answer = s.find(key))
      return answer;
  return nullptr;
}

// Value at one place of a function given by rising points.
double interpolated(const Eigen::VectorXd &x, const Eigen::VectorXd &y, const double position)
{
  if (position <= x[0] || position >= x[x.size() - 1])
    return position <= x[0] ? y[0] : y[y.size() - 1];
  const auto i   = std::upper_bound(x.data(), x.data() + x.size(), position) - x.data();
  const double t = (position - x[i - 1]) / (x[i] - x[i - 1]);
  return (1 - t) * y[i - 1] + t * y[i];
}

// (contact nodes) m, how far the section of the roll deflects under the pressure of the finite elements.
Eigen::VectorXd roll_displacement(const BiteStudy &s)
{
  const bite::BiteState &state     = s.flow->fine.state;
  const bite::ArcFlexibility &roll = s.flexibility;
  Eigen::VectorXd pressure         = Eigen::VectorXd::Zero(roll.position.size());
  for (Eigen::Index i = 0; i < pressure.size(); ++i)
    if (const double x = roll.position[i];
        x >= state.position[0] && x <= state.position[state.position.size() - 1])
      pressure[i] = interpolated(state.position, state.pressure, x);
  const Eigen::VectorXd u = roll.influence * pressure;
  Eigen::VectorXd at_nodes(state.position.size());
  for (Eigen::Index i = 0; i < at_nodes.size(); ++i)
    at_nodes[i] = interpolated(roll.position, u, state.position[i]);
  return at_nodes;
}

// The path form: nodal forces over how far the roll deflects there.
std::optional<bite::PathStiffness> path_of(const BiteStudy &s)
{
  if (!s.flow || s.flexibility.position.size() == 0)
    return std::nullopt;  // a rigid roll deflects nowhere
  const StripFlow &f = s.flow->fine;
  try {
    return bite::path_stiffness(f.state.position, f.state.pressure, roll_displacement(s),
                                s.question.bite.strip.width, s.question.setup.path_trim);
  } catch (const InputError &) {
    return std::nullopt;  // no place with both pressure and displacement
  }
}
}  // namespace

double bite_error(const BiteStudy &s, const double value, const double coarse,
                  const std::function<double(const BiteAnswer &)> &same)
{
  std::vector<double> others;
  const BiteAnswer &chosen = s.chosen(), *fe = s.find("fe");
  if (&chosen == fe) {
    const BiteAnswer *slab = slab_beside(s);
    const double finer     = mesh_pair_safety * (coarse - value) / (s.flow->coarsening - 1);  // (1.5)
    others                 = {value + finer, slab ? same(*slab) : not_given};
  } else {
    for (const BiteAnswer &answer : s.answers)
      if (answer.refused.empty() && &answer != &chosen &&
          (&answer == fe || std::count(std::begin(theories), std::end(theories), answer.key)))
        others.push_back(same(answer));
    others.erase(std::remove_if(others.begin(), others.end(), [](const double x) { return std::isnan(x); }),
                 others.end());
  }
  if (s.softer)
    others.push_back(value * same(*s.softer) / same(s.slab()));
  if (s.beyond_circle()) {
    const BiteAnswer *free = s.find("karman-elastic-arc");
    others.push_back(free ? same(*free) : not_given);
  }
  double widest = others.empty() ? not_given : 0;
  for (const double other : others) {
    if (std::isnan(other))
      return not_given;
    widest = std::max(widest, difference(other, value));
  }
  return widest;
}

bool is_fitted(const BiteStudy &s)
{
  return !std::isnan(s.question.force_deviation);
}

bool agrees_with_force(const BiteStudy &s)
{
  constexpr double same_force = 0.1;
  return difference(s.chosen().state.force, s.question.force) <=
         (is_fitted(s) ? 3 * s.question.force_deviation : same_force);
}

StripThickness strip_thickness(const BiteStudy &s)
{
  if (&s.chosen() == s.find("fe"))
    return {s.flow->fine.exit_thickness, s.flow->elastic ? s.flow->smallest_thickness : not_given};
  const bool free_arc = s.chosen().key == word_of(BiteModel::karman_elastic_arc);
  return {
      bite::leaving_thickness(s.question.bite, s.chosen().state, free_arc ? bite::Arc::elastic : bite::Arc::rigid),
      free_arc ? s.question.bite.strip.exit_thickness : not_given};
}

bool on_free_arc(const BiteStudy &s)
{
  return s.chosen().key == word_of(BiteModel::karman_elastic_arc) ||
         (&s.chosen() == s.find("fe") && s.flow->elastic && s.question.setup.arc == BiteArc::elastic);
}

SpringNumbers spring_numbers(const BiteStudy &s)
{
  const bite::BiteStiffness &k = s.chosen().stiffness;
  const double coarse_slope    = s.flow ? s.flow->coarse_slope : not_given;
  const double coarse          = 1 / (1 / coarse_slope + 2 / k.flattening);
  SpringNumbers out;
  out.path = path_of(s);
  out.plastic_slope_error =
      bite_error(s, k.plastic_slope, coarse_slope, [](const BiteAnswer &a) { return a.stiffness.plastic_slope; });
  // The only other value of the flattening: the section of the roll under the computed pressure.
  out.flattening_error = out.path ? difference(out.path->sum, k.flattening) : not_given;
  out.combined_error = bite_error(s, k.combined, coarse, [](const BiteAnswer &a) { return a.stiffness.combined; });
  if (!std::isnan(out.flattening_error))  // what is not known of the flattening comes with it
    out.combined_error += 2 * k.combined / k.flattening * out.flattening_error;
  return out;
}
}  // namespace mill::fem
