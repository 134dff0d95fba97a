#include "app/stages/bite/bite_curves.h"
#include "app/run/curve_files.h"
#include "app/stages/bite/strip_flow_stage.h"
#include "core/base/errors.h"
#include "core/records/csv.h"
#include "reduce/bite/linear/stiffness_map.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using bite::Arc;
using bite::MapQuantity;
using bite::RollBite;
using bite::Theory;

Eigen::VectorXd filled(const Eigen::Index n)
{
  return Eigen::VectorXd::Constant(n, not_given);
}

// Curves show a trend: elements twice as large as those of the working point do.
FlowQuestion cheap(const BiteStudy &study, RollBite bite, const std::string &what)
{
  FlowQuestion q{std::move(bite), study.question.setup, what};
  q.setup.elements_along   = std::max(16, q.setup.elements_along / 2);
  q.setup.elements_through = std::max(4, q.setup.elements_through / 2);
  return q;
}

/// K4 and force over one input of the bite.
struct Sweep {
  std::string name, unit;                             // of the input
  Eigen::VectorXd values;                             // its values
  std::function<void(RollBite &, double value)> set;  // into a bite
  std::vector<Eigen::Index> finite_element;           // of `values`, outward from the working point
};

// The theory of [bite], which is solved so often on a circle only.
bite::SlabModel quick_model(BiteSetup setup)
{
  if (setup.arc == BiteArc::elastic)
    setup.arc = BiteArc::hitchcock;
  return fem::slab_model(setup);
}

std::optional<bite::BiteState> slab_state(const BiteStudy &study, const RollBite &bite)
{
  try {
    return bite::solve_slab(bite, quick_model(study.question.setup));
  } catch (const InputError &) {
    return std::nullopt;  // no such pass: the curve has a gap
  } catch (const SolverError &) {
    return std::nullopt;
  }
}

void write_sweep(RunContext &run, const BiteStudy &study, const Sweep &sweep)
{
  const Eigen::Index n  = sweep.values.size();
  Eigen::VectorXd force = filled(n), slope = filled(n), combined = filled(n), fe_force = filled(n),
                  fe_slope = filled(n);
  bool any_fe              = false;
  for (Eigen::Index i = 0; i < n; ++i) {
    RollBite bite = study.question.bite;
    sweep.set(bite, sweep.values[i]);
    if (const auto state = slab_state(study, bite)) {
      const auto k = bite::slab_stiffness(bite, *state);
      force[i]     = state->force;
      slope[i]     = k.plastic_slope;
      combined[i]  = k.combined;
    }
  }
  // An elastic-plastic strip takes ten times as long; its slope is computed at the working point only.
  if (study.flow && !study.flow->elastic) {
    std::vector<FlowQuestion> questions;
    for (const Eigen::Index i : sweep.finite_element) {
      RollBite bite = study.question.bite;
      sweep.set(bite, sweep.values[i]);
      questions.push_back(cheap(study, bite, "over " + sweep.name));
    }
    const auto points = solve_flow_points(run, questions);
    for (std::size_t p = 0; p < points.size(); ++p)
      if (points[p]) {
        fe_force[sweep.finite_element[p]] = points[p]->force;
        fe_slope[sweep.finite_element[p]] = points[p]->plastic_slope;
        any_fe                            = true;
      }
  }
  Table t;
  t.add(sweep.name, sweep.unit, sweep.values).add("plastic_slope", "N/m", slope).add("combined", "N/m", combined);
  t.add("force", "N", force);
  if (any_fe)
    t.add("fe_plastic_slope", "N/m", fe_slope).add("fe_force", "N", fe_force);
  write_curve(run, curve::bite_k4, "", t, sweep.name);
}

// Working point, half way and both ends: where the curve of the slab theory is checked.
std::vector<Eigen::Index> some_of(const Eigen::Index n)
{
  return {n / 2, n - 1 - n / 8, n / 8};
}

std::vector<Sweep> sweeps_of(const BiteStudy &study)
{
  const BiteQuestion &q = study.question;
  const Strip &strip    = q.bite.strip;
  const auto n          = Eigen::Index(q.setup.samples);
  const double r        = 1 - strip.exit_thickness / strip.entry_thickness;
  std::vector<Sweep> sweeps;
  const auto by = [](const MapQuantity quantity) {
    return [quantity](RollBite &b, const double value) { b = bite::with_quantity(b, quantity, value); };
  };
  sweeps.push_back({"reduction", "", Eigen::VectorXd::LinSpaced(n, 0.4 * r, std::min(1.6 * r, 0.5 * (1 + r))),
                    by(MapQuantity::reduction), some_of(n)});
  const double k = study.chosen().state.entry_flow_stress;
  if (k > 0)
    sweeps.push_back(
        {"tension",
         "Pa",
         Eigen::VectorXd::LinSpaced(n, 0, 0.5 * k),
         [](RollBite &b, const double value) { b.strip.entry_tension = b.strip.exit_tension = value; },
         {}});
  if (is_a_number(strip.friction)) {
    const double mu = study.chosen().state.friction;
    sweeps.push_back({"friction", "", Eigen::VectorXd::LinSpaced(n, 0.5 * mu, std::min(1.0, 1.6 * mu)),
                      by(MapQuantity::friction), some_of(n)});
  } else {
    const double v = q.bite.roll_speed;
    sweeps.push_back(
        {"speed", "m/s", Eigen::VectorXd::LinSpaced(n, 0.4 * v, 2 * v), by(MapQuantity::roll_speed), {}});
  }
  return sweeps;
}

// A bite of another aspect a = arc / mean thickness with the same roll, friction and angle of bite, so that every
// one can be rolled; the reduction is at most that of the pass.
RollBite of_aspect(const BiteStudy &study, const double a)
{
  RollBite bite           = study.question.bite;
  Strip &strip            = bite.strip;
  const double r0         = 1 - strip.exit_thickness / strip.entry_thickness;
  const double angle      = std::sqrt((strip.entry_thickness - strip.exit_thickness) / bite.roll_radius);
  const double r          = std::min(r0, angle * a / (1 + 0.5 * angle * a));
  const double h          = bite.roll_radius * r / std::pow(a * (1 - 0.5 * r), 2);
  strip.entry_thickness   = h;
  strip.exit_thickness    = h * (1 - r);
  strip.initial_thickness = not_given;
  strip.entry_tension = strip.exit_tension = 0;
  strip.friction                           = as_number(strip.friction, study.chosen().state.friction);
  return bite;
}

void write_aspects(RunContext &run, const BiteStudy &study)
{
  const std::vector<double> aspects{0.4, 0.6, 1, 2, 4, 8};
  const auto n = Eigen::Index(aspects.size());
  std::vector<FlowQuestion> questions;
  Eigen::VectorXd fe = filled(n), karman = filled(n), orowan = filled(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const RollBite bite = of_aspect(study, aspects[std::size_t(i)]);
    const auto slab     = [&](const Theory theory) {
      try {
        return bite::solve_slab(bite, {theory, Arc::rigid}).force / bite.strip.width;
      } catch (const InputError &) {
        return not_given;
      } catch (const SolverError &) {
        return not_given;
      }
    };
    karman[i]      = slab(Theory::karman);
    orowan[i]      = slab(Theory::orowan);
    FlowQuestion q = cheap(study, bite, "over the aspect");
    q.setup.strip  = BiteStrip::rigid_plastic;  // the aspect is a matter of plastic flow between rigid rolls
    q.setup.arc    = BiteArc::rigid;
    questions.push_back(std::move(q));
  }
  const auto points = solve_flow_points(run, questions);
  for (Eigen::Index i = 0; i < n; ++i)
    if (const auto &point = points[std::size_t(i)])
      fe[i] = point->force / study.question.bite.strip.width;
  Table t;
  t.add("arc_over_thickness", "", Eigen::Map<const Eigen::VectorXd>(aspects.data(), n));
  t.add("fe", "N/m", fe).add("karman", "N/m", karman).add("orowan", "N/m", orowan);
  t.add("ratio_karman", "", fe.array() / karman.array()).add("ratio_orowan", "", fe.array() / orowan.array());
  write_curve(run, curve::bite_aspect, "", t);
}
// K4 by the slab theory over reduction and friction.
void write_map(RunContext &run, const BiteStudy &study)
{
  const RollBite &bite = study.question.bite;
  if (!is_a_number(bite.strip.friction))
    return;
  constexpr Eigen::Index n = 25;
  const double r = 1 - bite.strip.exit_thickness / bite.strip.entry_thickness, mu = study.chosen().state.friction;
  const bite::MapAxis reduction{MapQuantity::reduction,
                                Eigen::VectorXd::LinSpaced(n, 0.4 * r, std::min(1.6 * r, 0.5 * (1 + r)))};
  const bite::MapAxis friction{MapQuantity::friction,
                               Eigen::VectorXd::LinSpaced(n, 0.5 * mu, std::min(1.0, 1.6 * mu))};
  const auto map = bite::stiffness_map(bite, quick_model(study.question.setup), reduction, friction, run.threads);
  Eigen::VectorXd at_reduction(n * n), at_friction(n * n), slope(n * n), force(n * n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      at_reduction[i * n + j] = reduction.value[i];
      at_friction[i * n + j]  = friction.value[j];
      slope[i * n + j]        = map.slope(i, j);
      force[i * n + j]        = map.force(i, j);
    }
  Table t;
  t.add("reduction", "", at_reduction).add("friction", "", at_friction).add("plastic_slope", "N/m", slope);
  t.add("force", "N", force);
  write_curve(run, curve::bite_map, "", t);
}

}  // namespace

void write_bite_curves(RunContext &run, const BiteStudy &study)
{
  StageTimer timer(run, "bite, curves");
  const auto sweeps = sweeps_of(study);
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    run.progress.at("bite, curves", 0.6 * double(i) / double(sweeps.size()));
    write_sweep(run, study, sweeps[i]);
  }
  run.progress.at("bite, curves", 0.6);
  write_map(run, study);
  if (study.flow)
    write_aspects(run, study);
}
}  // namespace mill
