#include "reduce/lumped_stand.h"
#include "core/provenance.h"
#include "reduce/beam_shapes.h"
#include "reduce/chain_keys.h"
#include "reduce/equivalent_mass.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace mill::reduce {
namespace {
/// The computed springs the chain depends on: everything else is a number of the case.
enum { i_K3, i_K5, i_K_Zy_upper, i_K_Zy_lower, n_computed };
using Computed = std::array<double, n_computed>;

/// M1..M6, then K1..K7.
using ChainValues = std::array<double, 13>;

double given_or(const FourHigh &stand, const std::string &name, const double computed)
{
  const auto given = stand.given.find(name);
  return given == stand.given.end() ? computed : given->second.parameter.value;
}

Parameter given_or(const FourHigh &stand, const std::string &name, const Parameter &computed)
{
  const auto given = stand.given.find(name);
  return given == stand.given.end() ? computed : given->second.parameter;
}

/// The stand as beams and springs, ready to be asked for masses and shapes.
struct Reduced {
  SteppedBeam backup;
  BedShape upper_bed, lower_bed;
  double K_ZW;  ///< N/m
  SeriesSprings series;
  Flexibilities u;
};

BedShape work_roll_bed(const FourHigh &stand, const double contact_stiffness)
{
  const Roll &roll = stand.work_roll;
  return bed_shape({roll.barrel_length / 2, stand.strip.width / 2, contact_stiffness / roll.barrel_length,
                    round_section(roll.barrel_diameter, stand.steel).bending});
}

double roll_stiffness(const SteppedBeam &beam, const std::string &reference)
{
  return 1 / (reference == "mean" ? mean_flexibility(beam) : mid_flexibility(beam));  // (4.8)
}

/// A given K_ZW scales the sections, so that shape and stiffness stay one roll.
SteppedBeam with_stiffness(SteppedBeam beam, const double factor)
{
  for (BeamSection *section : {&beam.barrel, &beam.neck}) {
    section->bending *= factor;
    section->shear *= factor;
  }
  return beam;
}

Reduced reduce_stand(const FourHigh &stand, const Computed &computed, const std::string &reference)
{
  Reduced r;
  const SteppedBeam drawn = backup_beam(stand);
  const double drawn_K_ZW = roll_stiffness(drawn, reference);
  r.K_ZW                  = given_or(stand, "K_ZW", drawn_K_ZW);
  r.backup                = with_stiffness(drawn, r.K_ZW / drawn_K_ZW);
  r.upper_bed             = work_roll_bed(stand, computed[i_K3]);
  r.lower_bed             = work_roll_bed(stand, computed[i_K5]);
  const PathSprings path{computed[i_K_Zy_upper], computed[i_K_Zy_lower], r.K_ZW};
  r.series = series_springs(stand.frame, path);
  r.u = flexibilities(stand.frame, path, given_or(stand, "K1", r.series.K1), given_or(stand, "K7", r.series.K7));
  return r;
}

ChainValues chain_values(const FourHigh &stand, const Computed &computed, const double K4,
                         const std::string &reference)
{
  const Reduced r  = reduce_stand(stand, computed, reference);
  const Roll &work = stand.work_roll;
  return {upper_frame_mass(stand.frame),
          upper_backup_mass(stand, r.backup, r.u),
          work_roll_mass(stand, r.upper_bed, r.backup, r.u.roll_upper, work.chock_mass_upper),
          work_roll_mass(stand, r.lower_bed, r.backup, r.u.roll_lower, work.chock_mass_lower),
          lower_backup_mass(stand, r.backup, r.u),
          lower_frame_mass(stand.frame),
          r.series.K1,
          r.series.K2,
          computed[i_K3],
          K4,
          computed[i_K5],
          r.series.K6,
          r.series.K7};
}

/// Relative errors of all values from those of the computed springs; see the header for the rule.
ChainValues propagated_errors(const FourHigh &stand, const Computed &computed, const Computed &error,
                              const double K4)
{
  constexpr double step     = 1e-4;  // truncation 1e-8, rounding 1e-11 of the slope: far below any estimate
  constexpr double no_slope = 1e-9;
  ChainValues sum{};
  std::array<bool, 13> depends{};
  for (int i = 0; i < n_computed; ++i) {
    Computed more = computed, less = computed;
    more[std::size_t(i)] *= 1 + step;
    less[std::size_t(i)] *= 1 - step;
    const ChainValues up   = chain_values(stand, more, K4, stand.dynamics.mass_reference);
    const ChainValues down = chain_values(stand, less, K4, stand.dynamics.mass_reference);
    for (std::size_t v = 0; v < sum.size(); ++v) {
      const double slope = up[v] > 0 && down[v] > 0 ? std::log(up[v] / down[v]) / (2 * step) : 0;
      if (std::abs(slope) < no_slope)
        continue;
      depends[v] = true;
      sum[v] += std::abs(slope) * error[std::size_t(i)];
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (!depends[v])
      sum[v] = std::numeric_limits<double>::quiet_NaN();
  return sum;
}

std::string mass_method(const std::size_t i, const std::string &reference)
{
  if (i == 0 || i == 5)
    return "sum of the reduced masses";
  return "kinetic energy of the static shape, " + reference + " reference";
}

/// The other reference beside the chosen one: how much the choice of the reference point moves a mass.
Check other_reference(const std::size_t i, const std::string &chosen, const ChainValues &other)
{
  const std::string name = chosen == "mean" ? "mid-span" : "mean";
  return {name + " reference (4.8)", other[i], "same shape, other reference displacement of the backup roll"};
}

RollShape sampled(const double end, const std::function<double(double)> &shape)
{
  RollShape table{Eigen::VectorXd::LinSpaced(101, 0, end), Eigen::VectorXd(101)};
  for (Eigen::Index i = 0; i < table.x.size(); ++i)
    table.value[i] = shape(table.x[i]);
  return table;
}

void add_shapes(LumpedStand &result, const FourHigh &stand, const Reduced &r)
{
  const double end = stand.work_roll.barrel_length / 2 + stand.work_roll.neck_length, centre = r.backup.half_span;
  result.f1_upper = sampled(end, [&](double x) { return work_shape(r.upper_bed, r.backup, r.u.roll_upper, x); });
  result.f1_lower = sampled(end, [&](double x) { return work_shape(r.lower_bed, r.backup, r.u.roll_lower, x); });
  result.f2_upper = sampled(centre, [&](double x) { return backup_shape(r.backup, r.u.bearing_upper, x); });
  result.f2_lower = sampled(centre, [&](double x) { return backup_shape(r.backup, r.u.bearing_lower, x); });
}

Parameter computed_parameter(const double value, const char *unit, const std::string &method,
                             const std::string &at, const Keys &keys)
{
  Parameter p;
  p.value  = value;
  p.unit   = unit;
  p.method = method;
  p.at     = at;
  p.inputs = keys;
  return p;
}

Parameter damper(const FourHigh &stand)
{
  Parameter none = computed_parameter(0, "N s/m", "no damper in the bite", "", {});
  none.source    = Source::assumed;
  return given_or(stand, "C", none);
}
}  // namespace

LumpedStand lumped_stand(const FourHigh &stand, const ChainInputs &inputs)
{
  LumpedStand result;
  LumpedModel &model   = result.model;
  const std::string at = model.at = inputs.at;
  const Parameter K3 = given_or(stand, "K3", inputs.K3), K4 = given_or(stand, "K4", inputs.K4),
                  K5 = given_or(stand, "K5", inputs.K5);
  result.K_Zy_upper  = given_or(stand, "K_Zy", inputs.K_Zy_upper);
  result.K_Zy_lower  = given_or(stand, "K_Zy", inputs.K_Zy_lower);

  const std::string &reference = stand.dynamics.mass_reference;
  const Computed computed{K3.value, K5.value, result.K_Zy_upper.value, result.K_Zy_lower.value};
  const Computed error{K3.error_estimate, K5.error_estimate, result.K_Zy_upper.error_estimate,
                       result.K_Zy_lower.error_estimate};
  const Reduced reduced    = reduce_stand(stand, computed, reference);
  const ChainValues values = chain_values(stand, computed, K4.value, reference);
  const ChainValues other  = chain_values(stand, computed, K4.value, reference == "mean" ? "mid" : "mean");
  const ChainValues errors = propagated_errors(stand, computed, error, K4.value);
  auto keys = chain_keys({K3.inputs, K4.inputs, K5.inputs, result.K_Zy_upper.inputs, result.K_Zy_lower.inputs,
                          given_springs(stand), stand.housing.present()});

  for (Keys &list : keys)
    list = as_drawn(list, stand);
  for (std::size_t i = 1; i < 5; ++i)
    keys[i] = joined(keys[i], mass_shape_keys(stand.dynamics));

  for (std::size_t i = 0; i < 6; ++i) {
    Parameter mass =
        computed_parameter(values[i], "kg", mass_method(i, reference), i == 0 || i == 5 ? "" : at, keys[i]);
    mass.error_estimate = errors[i];
    if (i != 0 && i != 5)
      mass.checks.push_back(other_reference(i, reference, other));
    model.M[i] = given_or(stand, "M" + std::to_string(i + 1), mass);
  }
  for (std::size_t i = 0; i < 7; ++i) {
    Parameter spring =
        computed_parameter(values[6 + i], "N/m", "series springs", i == 0 || i == 6 ? "" : at, keys[6 + i]);
    spring.error_estimate = errors[6 + i];
    model.K[i]            = given_or(stand, "K" + std::to_string(i + 1), spring);
  }
  model.K[2] = K3;
  model.K[3] = K4;
  model.K[4] = K5;
  for (std::size_t i = 0; i < 4; ++i)
    model.Kzc[i] = given_or(stand, "Kzc" + std::to_string(i + 1), inputs.Kzc[i]);
  model.C = damper(stand);

  result.K_ZW =
      given_or(stand, "K_ZW",
               computed_parameter(reduced.K_ZW, "N/m", "stepped Timoshenko beam, " + reference + " reference", "",
                                  backup_beam_keys()));
  result.flexibility = reduced.u;
  add_shapes(result, stand, reduced);
  return result;
}

LumpedModel lumped_model(const FourHigh &stand, const ChainInputs &inputs)
{
  return lumped_stand(stand, inputs).model;
}
}  // namespace mill::reduce
