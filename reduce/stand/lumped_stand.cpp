#include "reduce/stand/lumped_stand.h"
#include "core/numerics/mesh_pair.h"
#include "core/records/chain_number.h"
#include "core/records/result_names.h"
#include "reduce/chain/beam_shapes.h"
#include "reduce/chain/chain_keys.h"
#include "reduce/chain/equivalent_mass.h"
#include "reduce/chain/error_sum.h"
#include "reduce/chain/frame_closure.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

namespace mill::reduce {
namespace {
/// M1..M6, then K1..K7.
using ChainValues = std::array<double, 13>;

/// What the chain needs in addition to the drawing.  N/m
struct ChainNumbers {
  double K3 = 0, K4 = 0, K5 = 0, K_Zy_upper = 0, K_Zy_lower = 0;
  double K_ZW = not_given, K1 = not_given, K7 = not_given;  ///< given ones; absent: from the drawing
  double K2 = not_given, K6 = not_given;                    ///< given ones, for parts that are not drawn
  double K_ZW_factor = 1;                                   ///< on the one or the other
  double K_ww        = not_given;                           ///< work rolls on each other
  double kept = not_given;  ///< m/N, of the stand with touching rolls, that the frame keeps; absent: it is free
};

/// How the two kinds of rolls bend.
struct Rolls {
  BentBackupRoll backup;                       ///< as drawn
  std::function<BentWorkRoll(double K)> work;  ///< on a contact of stiffness K, N/m
};

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

Rolls beams(const FourHigh &stand)
{
  const Roll &roll = stand.work_roll;
  return {backup_beam(stand), [&roll, &stand](const double K) {
            return foundation_shape({roll.barrel_length / 2, stand.strip.width / 2, K / roll.barrel_length,
                                     beam_section(barrel_section(roll), stand.steel).bending});
          }};
}

Rolls solids(const FourHigh &stand, const Component &backup, const Component &work)
{
  return {BentBackupRoll(backup, stand.backup_roll.bearing_span / 2),
          [&work, &stand](const double K) { return BentWorkRoll(work, stand.strip.width / 2, K); }};
}

/// The stand as rolls and springs, ready to be asked for masses and shapes.
struct Reduced {
  BentBackupRoll backup;
  std::array<BentWorkRoll, 2> work;  ///< upper, lower
  double K_ZW;                       ///< N/m
  Frame frame;                       ///< as drawn, or what a given K2, K6 leaves for it
  SeriesSprings series;
  Flexibilities u;
};

double or_series(const double given, const double series)
{
  return std::isnan(given) ? series : given;
}

/// Compliance of the path with touching work rolls but for the stiffnesses that follow the modulus.  m/N
double rest_of_path(const Frame &frame, const SeriesSprings &series, const ChainNumbers &n)
{
  return 1 / or_series(n.K1, series.K1) + 1 / or_series(n.K2, series.K2) + 1 / n.K3 + 1 / n.K_ww + 1 / n.K5 +
         1 / or_series(n.K6, series.K6) + 1 / or_series(n.K7, series.K7) - closing_compliance(frame);
}
Reduced reduce_stand(const FourHigh &stand, const ChainNumbers &n, const Rolls &rolls,
                     const MassReference reference)
{
  Reduced r;
  const double drawn = 1 / rolls.backup.flexibility(reference);  // (4.8a)
  r.K_ZW             = (std::isnan(n.K_ZW) ? drawn : n.K_ZW) * n.K_ZW_factor;
  r.backup           = times(rolls.backup, drawn / r.K_ZW);  // shape and stiffness stay one roll
  r.work             = {rolls.work(n.K3), rolls.work(n.K5)};
  const PathSprings path{n.K_Zy_upper, n.K_Zy_lower, r.K_ZW};
  r.frame  = with_given_springs(stand.frame, path, n.K2, n.K6);
  r.series = series_springs(r.frame, path);
  if (!std::isnan(n.kept)) {
    r.frame  = with_closing_compliance(r.frame, n.kept - rest_of_path(r.frame, r.series, n));
    r.series = series_springs(r.frame, path);
  }
  r.u = flexibilities(r.frame, path, std::isnan(n.K1) ? r.series.K1 : n.K1, std::isnan(n.K7) ? r.series.K7 : n.K7);
  return r;
}

ChainValues chain_values(const FourHigh &stand, const ChainNumbers &n, const Rolls &rolls,
                         const MassReference reference)
{
  const Reduced r  = reduce_stand(stand, n, rolls, reference);
  const Roll &work = stand.work_roll;
  return {upper_frame_mass(stand.frame),
          upper_backup_mass(stand, r.backup, r.u),
          work_roll_mass(stand, r.work[0], r.backup, r.u.roll_upper, work.chock_mass_upper),
          work_roll_mass(stand, r.work[1], r.backup, r.u.roll_lower, work.chock_mass_lower),
          lower_backup_mass(stand, r.backup, r.u),
          lower_frame_mass(stand.frame),
          r.series.K1,
          r.series.K2,
          n.K3,
          n.K4,
          n.K5,
          r.series.K6,
          r.series.K7};
}

/// An input of the chain that may be off.
struct UncertainInput {
  double error;  ///< -, relative; NaN: not stated
  Keys lacks;    ///< what would say it
  std::function<void(FourHigh &, ChainNumbers &, double)> scale;
  std::string source = {};  ///< see ErrorSum
};

UncertainInput spring(double ChainNumbers::*number, const std::string &name, const Parameter &p)
{
  const Keys lacks = p.error_lacks.empty() ? Keys{name} : p.error_lacks;
  return {p.error_estimate, lacks, [number](FourHigh &, ChainNumbers &n, const double s) { n.*number *= s; }};
}

UncertainInput of_frame(const FrameValue &part)
{
  return {part.error,
          {part.tolerance_key},
          [member = part.member](FourHigh &s, ChainNumbers &, const double factor) { s.frame.*member *= factor; },
          part.source};
}

/// Relative errors of all values from those of the inputs, (4.17), and what they lack.
struct ChainErrors {
  ChainValues error{};
  std::array<Keys, 13> lacks;
};

ChainErrors propagated_errors(const FourHigh &stand, const ChainNumbers &numbers, const Rolls &rolls,
                              const std::vector<UncertainInput> &inputs)
{
  constexpr double step     = 1e-4;  // truncation 1e-8, rounding 1e-11 of the slope: far below any estimate
  constexpr double no_slope = 1e-9;
  const auto moved          = [&](const UncertainInput &input, const double factor) {
    FourHigh other                = stand;
    ChainNumbers numbers_of_other = numbers;
    input.scale(other, numbers_of_other, factor);
    return chain_values(other, numbers_of_other, rolls, stand.dynamics.mass_reference);
  };
  ChainErrors sum;
  std::array<ErrorSum, std::tuple_size<ChainValues>::value> of_value;
  for (const UncertainInput &input : inputs) {
    const ChainValues up = moved(input, 1 + step), down = moved(input, 1 - step);
    for (std::size_t v = 0; v < up.size(); ++v) {
      const double slope = up[v] > 0 && down[v] > 0 ? std::log(up[v] / down[v]) / (2 * step) : 0;
      if (std::abs(slope) < no_slope)
        continue;
      of_value[v].add(slope, input.error, input.source);  // stays unknown where one of them is
      if (std::isnan(input.error))
        sum.lacks[v].insert(sum.lacks[v].end(), input.lacks.begin(), input.lacks.end());
    }
  }
  for (std::size_t v = 0; v < of_value.size(); ++v)
    sum.error[v] = of_value[v].error();
  return sum;
}

ChainErrors no_errors()
{
  ChainErrors unknown;
  unknown.error.fill(not_given);
  return unknown;
}

std::string mass_method(const std::size_t i, const MassReference reference)
{
  if (i == 0 || i == 5)
    return "sum of the reduced masses";
  return std::string("kinetic energy of the static shape, ") + word_of(reference) + " reference";
}

/// The other reference compared with the chosen one: how much the choice of the reference point moves a mass.
Check other_reference(const std::size_t i, const MassReference chosen, const ChainValues &other)
{
  const std::string name = chosen == MassReference::mean ? "mid-span" : "mean";
  return {name + " reference (4.8a)", other[i], "same shape, other reference displacement of the backup roll"};
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
  result.f1_upper = sampled(end, [&](double x) { return work_shape(r.work[0], r.backup, r.u.roll_upper, x); });
  result.f1_lower = sampled(end, [&](double x) { return work_shape(r.work[1], r.backup, r.u.roll_lower, x); });
  result.f2_upper = sampled(centre, [&](double x) { return backup_shape(r.backup, r.u.bearing_upper, x); });
  result.f2_lower = sampled(centre, [&](double x) { return backup_shape(r.backup, r.u.bearing_lower, x); });
}

Parameter computed_parameter(const double value, const char *unit, const std::string &method,
                             const OperatingPoint &working_point, const Keys &inputs = {})
{
  Parameter p;
  p.value  = value;
  p.unit   = unit;
  p.method = method;
  p.at     = working_point;
  p.inputs = inputs;
  return p;
}

Parameter damper(const FourHigh &stand)
{
  Parameter none = computed_parameter(0, "N s/m", "no damper in the bite", "");
  none.source    = Source::assumed;
  return given_or(stand, "C", none);
}

/// K_ZW as the chain has it, compared with the other model of the roll.
Parameter bending_of(const FourHigh &stand, const ChainInputs &in, const Rolls &rolls, MovingKeys *const keys)
{
  const MassReference reference = stand.dynamics.mass_reference;
  const double drawn            = 1 / rolls.backup.flexibility(reference);
  const bool solid              = in.solid && stand.backup_roll.bending_model == BendingModel::solid;
  Parameter p = computed_parameter(drawn, "N/m", rolls.backup.method + ", " + word_of(reference) + " reference",
                                   "", keys ? bent_backup_keys(*keys, solid, false) : Keys());
  if (in.solid) {
    const auto flexibility = [&](const Component &roll) {
      return BentBackupRoll(roll, stand.backup_roll.bearing_span / 2).flexibility(reference);
    };
    const double fine = flexibility(*in.solid.backup_roll), coarse = flexibility(*in.solid.coarse_backup_roll);
    const double mesh = mesh_pair_error(fine, coarse, in.solid.gain);
    const double beam = 1 / BentBackupRoll(backup_beam(stand)).flexibility(reference);
    p.error_estimate  = solid ? mesh : std::abs(1 / (fine * beam) - 1) + mesh / (fine * beam);
    if (solid)
      p.checks.push_back({"stepped Timoshenko beam (4.8a)", beam, "its shoulder does not deflect, a roll's does"});
    else
      p.checks.push_back(
          {"solid roll by finite elements (22.13)", 1 / fine, "its shoulder deflects, a beam's does not"});
  } else
    p.error_lacks = {"K_ZW"};
  return given_or(stand, "K_ZW", p);
}

/// What the rolls' model is sure to: a coarser mesh of solid rolls, or solid rolls instead of beams.
void add_roll_errors(ChainErrors &errors, const ChainValues &values, const ChainValues &other_model,
                     const ChainValues &coarse, const SolidRolls &solid, const bool is_solid)
{
  for (std::size_t v = 0; v < values.size(); ++v)
    if (values[v] > 0)
      errors.error[v] += is_solid ? mesh_pair_error(values[v], coarse[v], solid.gain)
                                  : std::abs(other_model[v] / values[v] - 1) +
                                        mesh_pair_error(other_model[v], coarse[v], solid.gain);
}

void add_other_model(Parameter &p, const double beams, const bool solid)
{
  p.checks.push_back({solid ? name_of(CheckId::stepped_beams) : "rolls by finite elements (22.13)", beams, ""});
}
Rolls rolls_as(const FourHigh &stand, const ChainInputs &inputs, const bool meshed)
{
  return meshed ? solids(stand, *inputs.solid.backup_roll, *inputs.solid.work_roll) : beams(stand);
}

ChainNumbers chain_numbers(const FourHigh &stand, const ChainInputs &in)
{
  ChainNumbers n;
  n.K3         = given_or(stand, "K3", in.K3).value;
  n.K4         = given_or(stand, "K4", in.K4).value;
  n.K5         = given_or(stand, "K5", in.K5).value;
  n.K_Zy_upper = given_or(stand, "K_Zy", in.K_Zy_upper).value;
  n.K_Zy_lower = given_or(stand, "K_Zy", in.K_Zy_lower).value;
  n.K_ZW       = given_or(stand, "K_ZW", not_given);
  n.K1         = given_or(stand, "K1", not_given);
  n.K7         = given_or(stand, "K7", not_given);
  n.K2         = given_or(stand, "K2", not_given);
  n.K6         = given_or(stand, "K6", not_given);
  n.K_ww       = in.K_ww.value;
  return n;
}

/// The modulus and the contact of the work rolls, which the stiffnesses that follow the modulus are made from.
void add_closure(std::vector<UncertainInput> &uncertain, const FourHigh &stand, const ChainInputs &inputs)
{
  uncertain.push_back({stand.frame.modulus_error,
                       {"frame.modulus"},
                       [](FourHigh &, ChainNumbers &n, const double s) { n.kept /= s; }});
  uncertain.push_back(spring(&ChainNumbers::K_ww, "stand.K_ww.tangent", inputs.K_ww));
}
}  // namespace

Frame frame_on_modulus(const FourHigh &stand, const ChainInputs &inputs)
{
  if (!is_closed(stand.frame))
    return stand.frame;
  const bool solid     = inputs.solid && stand.backup_roll.bending_model == BendingModel::solid;
  const ChainNumbers n = chain_numbers(stand, inputs);
  const Reduced r      = reduce_stand(stand, n, rolls_as(stand, inputs, solid), stand.dynamics.mass_reference);
  return closed_on_modulus(stand.frame, rest_of_path(r.frame, r.series, n));
}

LumpedStand lumped_stand(const FourHigh &stand, const ChainInputs &inputs, const StatedErrors stated,
                         MovingKeys *const keys)
{
  LumpedStand result;
  LumpedModel &model        = result.model;
  const OperatingPoint load = model.at = inputs.at;
  const Parameter K3 = given_or(stand, "K3", inputs.K3), K4 = given_or(stand, "K4", inputs.K4),
                  K5 = given_or(stand, "K5", inputs.K5);
  result.K_Zy_upper  = given_or(stand, "K_Zy", inputs.K_Zy_upper);
  result.K_Zy_lower  = given_or(stand, "K_Zy", inputs.K_Zy_lower);

  const MassReference reference = stand.dynamics.mass_reference;
  const bool solid              = inputs.solid && stand.backup_roll.bending_model == BendingModel::solid;
  const auto rolls_of           = [&](const bool meshed) { return rolls_as(stand, inputs, meshed); };
  const Rolls rolls             = rolls_of(solid);
  result.K_ZW                   = bending_of(stand, inputs, rolls, keys);
  ChainNumbers n                = chain_numbers(stand, inputs);

  std::vector<UncertainInput> uncertain;
  for (const FrameValue &part : frame_values(stand.frame))
    uncertain.push_back(of_frame(part));
  uncertain.push_back(spring(&ChainNumbers::K3, "K3", K3));
  uncertain.push_back(spring(&ChainNumbers::K5, "K5", K5));
  uncertain.push_back(spring(&ChainNumbers::K_Zy_upper, "K_Zy", result.K_Zy_upper));
  uncertain.push_back(spring(&ChainNumbers::K_Zy_lower, "K_Zy_lower", result.K_Zy_lower));
  if (!inputs.solid || stand.given.count("K_ZW"))  // else by the change of all shapes together
    uncertain.push_back(spring(&ChainNumbers::K_ZW_factor, "K_ZW", result.K_ZW));
  const auto fills = [&](const std::string &name) {  // a given spring that represents parts that are not drawn
    const Frame &f = stand.frame;
    return name == word_of(ChainNumber::K2)
               ? std::isnan(f.oil_column_stiffness) || std::isnan(f.cylinder_body_stiffness) ||
                     std::isnan(f.upper_chock_stiffness)
           : name == word_of(ChainNumber::K6) ? std::isnan(f.lower_chock_stiffness)
                                              : true;
  };
  for (const auto &[name, number] : {std::pair("K1", &ChainNumbers::K1), std::pair("K7", &ChainNumbers::K7),
                                     std::pair("K2", &ChainNumbers::K2), std::pair("K6", &ChainNumbers::K6)})
    if (const auto given = stand.given.find(name); given != stand.given.end() && fills(name))
      uncertain.push_back(spring(number, name, given->second.parameter));

  const Reduced reduced = reduce_stand(stand, n, rolls, reference);
  if (is_closed(stand.frame) && !std::isnan(n.K_ww)) {
    n.kept = rest_of_path(reduced.frame, reduced.series, n) + closing_compliance(reduced.frame);
    add_closure(uncertain, stand, inputs);
  }
  const ChainValues values = chain_values(stand, n, rolls, reference);
  const ChainValues other =
      chain_values(stand, n, rolls, reference == MassReference::mean ? MassReference::mid : MassReference::mean);
  ChainErrors errors =
      stated == StatedErrors::propagated ? propagated_errors(stand, n, rolls, uncertain) : no_errors();
  ChainValues other_model = values;
  if (const SolidRolls &r = inputs.solid) {
    other_model        = chain_values(stand, n, rolls_of(!solid), reference);
    const Rolls coarse = solids(stand, *r.coarse_backup_roll, *r.coarse_work_roll);
    add_roll_errors(errors, values, other_model, chain_values(stand, n, coarse, reference), r, solid);
  }
  std::array<Keys, 13> lists;
  if (keys)
    lists =
        chain_keys(*keys, stand,
                   {K3.inputs, K4.inputs, K5.inputs, result.K_Zy_upper.inputs, result.K_Zy_lower.inputs}, solid);

  const auto with_error = [&](Parameter p, const std::size_t v) {
    p.error_estimate = errors.error[v];
    p.error_lacks    = errors.lacks[v];
    return p;
  };
  for (std::size_t i = 0; i < 6; ++i) {
    const bool frame = i == 0 || i == 5;
    Parameter mass   = with_error(
          computed_parameter(values[i], "kg", mass_method(i, reference), frame ? OperatingPoint() : load, lists[i]),
          i);
    if (!frame) {
      mass.checks.push_back(other_reference(i, reference, other));
      if (inputs.solid)
        add_other_model(mass, other_model[i], solid);
    }
    model.M[i] = given_or(stand, "M" + std::to_string(i + 1), mass);
  }
  for (std::size_t i = 0; i < 7; ++i) {
    const bool frame = i == 0 || i == 6;
    Parameter p      = with_error(
             computed_parameter(values[6 + i], "N/m", "series springs", frame ? OperatingPoint() : load, lists[6 + i]),
             6 + i);
    if (inputs.solid && (i == 1 || i == 5))
      add_other_model(p, other_model[6 + i], solid);
    model.K[i] = given_or(stand, "K" + std::to_string(i + 1), p);
  }
  model.K[2] = K3;
  model.K[3] = K4;
  model.K[4] = K5;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string name = "Kzc" + std::to_string(i + 1);
    model.Kzc[i]           = given_or(stand, name, inputs.Kzc[i]);
    model.Kzc_across[i]    = given_or(stand, name + "_across", inputs.Kzc_across[i]);
  }
  model.C = damper(stand);

  result.K_ww        = inputs.K_ww;
  result.frame       = reduced.frame;
  result.flexibility = reduced.u;
  result.backup      = reduced.backup;
  result.work        = reduced.work;
  add_shapes(result, stand, reduced);
  return result;
}

LumpedModel lumped_model(const FourHigh &stand, const ChainInputs &inputs)
{
  return lumped_stand(stand, inputs).model;
}
}  // namespace mill::reduce
