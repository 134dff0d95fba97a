#include "app/stages/stand/gauge_results.h"
#include "app/stages/bite/bite_stage.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/numerics/difference.h"
#include "core/records/rows_of_bite.h"
#include "core/records/rows_of_stand.h"
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace mill {
namespace {
constexpr double gauge_step = 1e-4;  // relative to the thickness, of the coupled solutions

// The rolling force of a slab theory on the circle of the loaded roll, which is held: what a pass of strip answers
// to another thickness or tension.
struct SlabForce {
  bite::RollBite bite;
  bite::SlabModel model;
  double operator()(const double h2) const
  {
    bite::RollBite other       = bite;
    other.strip.exit_thickness = h2;
    return bite::solve_slab(other, model).force;
  }
};

// Thickness that the stand rolls with the screw, or the strip, changed; central differences of the coupled
// solution.
class CoupledGauge {
public:
  CoupledGauge(SlabForce strip, reduce::LoadDeflection stand)
      : slab(std::move(strip)), curve(std::move(stand)), h2(slab.bite.strip.exit_thickness),
        S(h2 - reduce::deflected_at(curve, slab(h2)).deflection)
  {
  }
  double by_screw() const
  {
    const double d = gauge_step * h2;
    return (rolled(slab, S + d) - rolled(slab, S - d)) / (2 * d);
  }
  double by(double Strip::*input, const double size) const
  {
    const double step = input == &Strip::entry_thickness ? size * slab.bite.strip.entry_thickness : size;
    SlabForce up = slab, down = slab;
    up.bite.strip.*input += step;
    down.bite.strip.*input -= step;
    return (rolled(up, S) - rolled(down, S)) / (2 * step);
  }

private:
  SlabForce slab;
  reduce::LoadDeflection curve;
  double h2, S;  // m
  double rolled(const SlabForce &strip, const double screw) const
  {
    return reduce::coupled_thickness(
        screw, strip, [&](const double F) { return reduce::deflected_at(curve, F).deflection; }, h2 * 0.998,
        h2 * 1.002);
  }
};

// What the coupled solution says, where a slab theory takes this pass on that circle; else NaN.
class CoupledCheck {
public:
  CoupledCheck(const FourHigh &stand, const Pass &pass, const double radius, const reduce::LoadDeflection &stretch)
  {
    SlabForce slab{bite_of(stand.strip, pass, stand.work_roll.barrel_diameter, stand.steel),
                   fem::slab_model(stand.bite)};
    slab.model.arc          = bite::Arc::rigid;
    slab.model.curve_points = 0;
    if (stand.bite.method == BiteMethod::fe)
      slab.model.theory = bite::Theory::karman;
    slab.bite.roll_radius = radius;
    attempt([&] { gauge.emplace(std::move(slab), stretch); });
  }
  double read(const std::function<double(const CoupledGauge &)> &slope) const
  {
    double value = not_given;
    if (gauge)
      attempt([&] { value = slope(*gauge); });
    return value;
  }

private:
  std::optional<CoupledGauge> gauge;
  template <class Act> static void attempt(Act &&act)
  {
    try {
      act();
    } catch (const InputError &) {
    } catch (const SolverError &) {
    }
  }
};

// An input of the bite that moves the thickness.
struct GaugeInput {
  const RowOf<1> *force;      ///< of the bite, by it
  const RowOf<1> *thickness;  ///< dh2/dx
  double Strip::*member;      ///< nullptr: none that a number of the strip is
  double step;                ///< of the differences: relative to a thickness, Pa
};
const GaugeInput gauge_inputs[] = {
    {&row::bite::force_by_entry_thickness, &row::stand::thickness_by_entry_thickness, &Strip::entry_thickness,
     gauge_step},
    {&row::bite::force_by_entry_tension, &row::stand::thickness_by_entry_tension, &Strip::entry_tension, 1e4},
    {&row::bite::force_by_exit_tension, &row::stand::thickness_by_exit_tension, &Strip::exit_tension, 1e4},
    {&row::bite::force_by_friction, &row::stand::thickness_by_friction, nullptr, 0},
    {&row::bite::force_by_flow_stress, &row::stand::thickness_by_flow_stress, nullptr, 0},
    {&row::bite::force_by_roll_speed, &row::stand::thickness_by_roll_speed, nullptr, 0}};

// A number of the gauge: its error is that of modulus, plastic slope and slope of the bite with their shares.
struct GaugeNumber {
  ResultName name;
  const char *equation;
  double value, error, by_differences;
  std::string also;  ///< what else has no error
  KeyList inputs;
};

void add_gauge_number(RunContext &run, const GaugeNumber &g, const Parameter &M, const Parameter &slope)
{
  Parameter p;
  p.unit           = g.name.row().unit;
  p.value          = g.value;
  p.method         = "mill modulus and plastic slope " + std::string(g.equation);
  p.at             = slope.at;
  p.inputs         = g.inputs;
  p.error_estimate = g.error;
  if (std::isnan(g.error)) {
    p.error_lacks = M.error_lacks;
    if (std::isnan(slope.error_estimate))
      p.error_lacks.push_back("K4.plastic_slope");
    if (!g.also.empty())
      p.error_lacks.push_back(g.also);
  }
  if (!std::isnan(g.by_differences))
    p.checks.push_back({"differences of the coupled solution h2 = S + F/M", g.by_differences,
                        "the strip by a slab theory on the circle of the loaded roll"});
  run.results.add(g.name, p);
}
}  // namespace

ResultName stand_result(const FourHigh &stand, const std::size_t pass, const RowOf<1> &row)
{
  return row.of(pass == 0 ? "" : stand.passes[pass].name);
}

void add_gauge(RunContext &run, const FourHigh &stand, const std::size_t pass, const Parameter &slope,
               const StretchedStand &stretched)
{
  const std::string &name  = stand.passes[pass].name;
  const auto gauge_result  = [&](const RowOf<1> &row) { return stand_result(stand, pass, row); };
  const Parameter *modulus = run.results.find(gauge_result(row::stand::modulus_tangent));
  const Parameter *circle  = run.results.find(row::bite::flattened_radius.of(name));
  if (!modulus || !(slope.value > 0) || !circle)
    return;
  const Parameter M = *modulus;  // results move with every new one
  const reduce::GaugeCoupling gauge{M.value, slope.value};
  const CoupledCheck coupled(stand, stand.passes[pass], circle->value, stretched.stretch);
  const double share = gauge.Q / (gauge.M + gauge.Q), eM = M.error_estimate, eQ = slope.error_estimate;
  const double by_screw = coupled.read([](const CoupledGauge &c) { return c.by_screw(); });
  const auto add        = [&](const GaugeNumber &g) { add_gauge_number(run, g, M, slope); };
  add({gauge_result(row::stand::screw_sensitivity), "(30.7)", gauge.screw(), share * (eM + eQ), by_screw, "",
       stretched.inputs});
  add({gauge_result(row::stand::thickness_by_eccentricity), "(30.7)", -gauge.screw(), share * (eM + eQ), -by_screw,
       "", stretched.inputs});
  add({gauge_result(row::stand::force_by_screw), "(30.9)", gauge.force_by_screw(), share * eM + (1 - share) * eQ,
       not_given, "", stretched.inputs});
  for (const GaugeInput &input : gauge_inputs) {
    const std::string of_bite = input.force->of(name);
    const Parameter *there    = run.results.find(of_bite);
    if (!there || there->value == 0)
      continue;
    const double F_x       = there->value;
    const double eF        = there->checks.empty() ? not_given : difference(there->checks.front().value, F_x);
    const std::string also = std::isnan(eF) ? of_bite : "";
    BiteReading reading;
    reading.speed        = input.force == &row::bite::force_by_roll_speed;
    const KeyList inputs = joined(stretched.inputs, bite_keys(*run.keys, pass, reading));
    const double by_differences =
        input.member ? coupled.read([&](const CoupledGauge &c) { return c.by(input.member, input.step); })
                     : not_given;
    add({gauge_result(*input.thickness), "(30.8)", gauge.thickness_by(F_x), eF + (1 - share) * eM + share * eQ,
         by_differences, also, inputs});
    if (input.member == &Strip::entry_thickness)
      add({gauge_result(row::stand::force_by_entry_thickness), "(30.9)", gauge.force_by(F_x),
           eF + share * (eM + eQ), gauge.M * by_differences, also, inputs});
  }
}
}  // namespace mill
