#include "curve_motion.h"
#include "fixed_step.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mill::fmu {
namespace {
constexpr std::size_t most_lengths = 8;                // of steps, that are kept prepared
constexpr double same_length       = 1.0 / (1 << 30);  // of the longest step: the rounding of a client's times

dynamics::CurveStand stand_of(const ModelData &model)
{
  dynamics::CurveStand stand;
  for (const double f : model.frequency)
    stand.rate.push_back(2 * 3.14159265358979323846 * f);
  stand.push = model.bite_mode;
  for (const CurveLawData &law : model.curves.laws) {
    dynamics::SpringLaw made(law.load, law.compression);
    if (law.series_compliance != 0)
      made = made.in_series_with(law.series_compliance);
    if (!made.usable())
      throw std::runtime_error("a curve of a spring does not rise");
    stand.laws.push_back(std::move(made));
  }
  for (const CurveSpringData &s : model.curves.springs)
    stand.springs.push_back({s.name, std::size_t(s.law), s.share, s.row, s.rest, s.force, s.stiffness});
  return stand;
}
}  // namespace

struct CurveMotion::Kernel {
  dynamics::CurveStand stand;
  double longest_step = 0;
  struct Prepared {
    double length;
    std::unique_ptr<dynamics::FixedStep> step;
  };
  std::vector<Prepared> prepared;
  std::size_t next_place = 0;
  dynamics::CurveState state;

  // Compressions and forces follow from the modes, so that these are all that a copy of the state holds.
  void set(const ModalState &from)
  {
    state.q = from.q;
    state.v = from.p;
    state.d.resize(stand.springs.size());
    state.rho.resize(stand.springs.size());
    for (std::size_t j = 0; j < stand.springs.size(); ++j) {
      state.d[j]   = dynamics::further_compression(stand.springs[j], from.q.data());
      state.rho[j] = dynamics::beyond_tangent(stand, stand.springs[j], state.d[j]).force;
    }
    state.gap_velocity = 0;
    for (std::size_t k = 0; k < from.p.size(); ++k)
      state.gap_velocity += stand.push[k] * from.p[k];
  }

  const dynamics::FixedStep &step_of(const double length)
  {
    for (const Prepared &p : prepared)
      if (p.length == length)
        return *p.step;
    if (prepared.size() < most_lengths)
      prepared.emplace_back();
    Prepared &place = prepared[next_place];
    next_place      = (next_place + 1) % most_lengths;
    place.step      = std::make_unique<dynamics::FixedStep>(stand, length);
    place.length    = length;
    return *place.step;
  }
};

CurveMotion::CurveMotion(const ModelData &model) : kernel_(new Kernel)
{
  kernel_->stand        = stand_of(model);
  kernel_->longest_step = model.curves.longest_step;
}

CurveMotion::~CurveMotion() = default;

void CurveMotion::tune(const double damping, const double gap_damper)
{
  kernel_->prepared.clear();
  kernel_->next_place       = 0;
  kernel_->stand.damping    = damping;
  kernel_->stand.gap_damper = gap_damper;
}

void CurveMotion::advance(ModalState &modes, const double length, const StraightForce &force)
{
  if (!(length > 0))
    return;
  const double longest = kernel_->longest_step, count = std::max(1.0, std::ceil(length / longest - 1e-6));
  const double interval = length / count, unit = longest * same_length, multiple = std::round(interval / unit);
  const auto &step = kernel_->step_of(multiple > 0 ? multiple * unit : interval);
  kernel_->set(modes);
  double before = force.start;
  for (double i = 1; i <= count; ++i) {
    const double after = force.start + force.slope * (length * (i / count));
    if (!step.advance(kernel_->state, before, after))
      throw std::runtime_error("the compressions of the contacts cannot be solved for");
    before = after;
  }
  modes.q = kernel_->state.q;
  modes.p = kernel_->state.v;
}

ModalState CurveMotion::equilibrium(const double force) const
{
  dynamics::CurveState state;
  if (!dynamics::rest_under(kernel_->stand, force, state))
    throw std::runtime_error("there is no equilibrium under the force at the start: it pulls the rolls apart");
  return {state.q, std::vector<double>(state.q.size()), {}};
}

void CurveMotion::add_springs(const ModalState &state, std::vector<double> &acceleration) const
{
  for (const dynamics::CurveSpring &spring : kernel_->stand.springs) {
    const double d     = dynamics::further_compression(spring, state.q.data());
    const double force = dynamics::beyond_tangent(kernel_->stand, spring, d).force;
    for (std::size_t k = 0; k < acceleration.size(); ++k)
      acceleration[k] -= spring.row[k] * force;
  }
}

void CurveMotion::add_spring_rates(const ModalState &state, std::vector<double> &jerk) const
{
  for (const dynamics::CurveSpring &spring : kernel_->stand.springs) {
    const double d    = dynamics::further_compression(spring, state.q.data());
    const double rate = dynamics::further_compression(spring, state.p.data()) *
                        dynamics::beyond_tangent(kernel_->stand, spring, d).stiffness;
    for (std::size_t k = 0; k < jerk.size(); ++k)
      jerk[k] -= spring.row[k] * rate;
  }
}

double CurveMotion::rest_force() const
{
  double most = 0;
  for (const dynamics::CurveSpring &spring : kernel_->stand.springs)
    most = std::max(most, spring.force);
  return most;
}
}  // namespace mill::fmu
