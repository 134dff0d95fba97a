#include "core/case/bite_inputs.h"
#include "core/case/moving_keys.h"
#include "core/records/record_text.h"
#include "core/records/rows_of_bite.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace mill {
Strip with_laws_as_read(Strip strip)
{
  for (const FlowStressConstant &constant : flow_stress_constants())
    if (!reads(strip.flow_stress, constant.member))
      strip.flow_stress.*constant.member = 0;
  if (!row_of(strip.flow_stress.law).tabled)
    strip.flow_stress.table.clear();
  if (!hardens(strip.flow_stress))
    strip.initial_thickness = not_given;
  for (const FrictionConstant &constant : friction_constants())
    if (!reads(strip.friction, constant.member) && constant.member != &Friction::shear_limit)
      strip.friction.*constant.member = 0;
  return strip;
}

Strip with_values_of_pass(Strip strip, const Pass &pass)
{
  const auto take = [](double &value, const double of_pass) { value = std::isnan(of_pass) ? value : of_pass; };
  take(strip.entry_thickness, pass.entry_thickness);
  take(strip.exit_thickness, pass.exit_thickness);
  take(strip.entry_tension, pass.entry_tension);
  take(strip.exit_tension, pass.exit_tension);
  return strip;
}

namespace {
// The parts of a case that a bite is made of.
struct BiteParts {
  const Strip &strip;
  const std::vector<Pass> &passes;
  const BiteSetup &setup;
  const Material &steel;
  double roll_diameter;
};

BiteParts parts_of_bite(const CaseSpec &spec)
{
  if (const auto *stand = std::get_if<FourHigh>(&spec))
    return {stand->strip, stand->passes, stand->bite, stand->steel, stand->work_roll.barrel_diameter};
  const auto &bite = std::get<BiteCase>(spec);
  return {bite.strip, bite.passes, bite.bite, bite.steel, bite.roll_diameter};
}

MeasuredInputs inputs_of_measured(const BiteParts &parts, const Pass &pass)
{
  const auto asked = [&](const PassMeasure kind) {
    return std::count(parts.setup.fit.begin(), parts.setup.fit.end(), kind) > 0;
  };
  const Strip strip = with_values_of_pass(parts.strip, pass);
  MeasuredInputs inputs{strip.entry_thickness, strip.exit_thickness, strip.entry_tension, strip.exit_tension};
  if (needs_speed(strip.friction))
    inputs.speed = pass.speed;
  if (asked(PassMeasure::force)) {
    inputs.force           = {inputs_of_load(pass)};
    inputs.force_deviation = pass.force_deviation;
  }
  if (asked(PassMeasure::slip)) {
    inputs.slip           = pass.forward_slip;
    inputs.slip_deviation = pass.slip_deviation;
  }
  if (asked(PassMeasure::torque)) {
    inputs.torque           = pass.torque;
    inputs.torque_deviation = pass.torque_deviation;
  }
  return inputs;
}

bool may_be_free(const BiteArc arc)
{
  return arc == BiteArc::elastic || arc == BiteArc::automatic;
}

// Whether the case asks for a free arc, whatever the bite is like.
bool asks_free_arc(const BiteSetup &setup)
{
  return setup.arc == BiteArc::elastic ||
         (setup.arc == BiteArc::automatic && setup.strip == BiteStrip::elastic_plastic);
}

// The backup roll that holds the section of the work roll.
void add_backup(BiteInputs &inputs, const CaseSpec &spec, const std::size_t p)
{
  const auto *stand = std::get_if<FourHigh>(&spec);
  if (!stand)
    return;
  inputs.backup_diameter = stand->backup_roll.barrel_diameter;
  inputs.backup_length   = std::min(stand->work_roll.barrel_length, stand->backup_roll.barrel_length);
  inputs.backup_load     = {inputs_of_load(stand->passes[p])};
}

// The model that gives K4, with its mesh where it has one.
void add_model(BiteInputs &inputs, const BiteSetup &setup)
{
  inputs.method = word_of(setup.method);
  if (setup.method != BiteMethod::fe) {
    inputs.theory = word_of(setup.theory);
    if (may_be_free(inputs.arc))  // the strip decides the arc, and how much of the roll its section needs
      inputs.flow = word_of(setup.strip);
    return;
  }
  inputs.flow             = word_of(setup.strip);
  inputs.elements_along   = setup.elements_along;
  inputs.elements_through = setup.elements_through;
}
}  // namespace

BiteInputs inputs_of_bite(const CaseSpec &spec, const std::size_t p, const BiteReading &reading)
{
  const BiteParts parts  = parts_of_bite(spec);
  const BiteSetup &setup = parts.setup;
  const Pass &pass       = parts.passes[p];
  const bool fits        = reading.fitted && !setup.fit.empty();
  BiteInputs inputs;
  inputs.strip         = with_laws_as_read(with_values_of_pass(parts.strip, pass));
  inputs.roll_diameter = parts.roll_diameter;
  inputs.roll          = at_rest(parts.steel);
  inputs.arc           = setup.arc;
  if (needs_speed(inputs.strip.friction) || reading.speed)
    inputs.speed = pass.speed;
  if (reading.path_trim)
    inputs.path_trim = setup.path_trim;
  if (!reading.whole_width)
    inputs.strip.width = not_given;
  if (reading.by == BiteAnswers::closed_form) {
    if (setup.arc != BiteArc::rigid)
      inputs.arc = BiteArc::hitchcock;
    // Finite elements name no theory; Karman's represents them.
    inputs.theory = word_of(setup.method == BiteMethod::fe ? SlabTheory::karman : setup.theory);
  }
  // A strip that is fitted is what the model of the run makes of the measured values, whoever is asked then.
  const bool modelled = reading.by == BiteAnswers::model || fits;
  if (modelled)
    add_model(inputs, setup);
  const bool free_arc      = reading.free_arc || (modelled && may_be_free(inputs.arc));
  const bool elastic_strip = modelled && setup.method == BiteMethod::fe && setup.strip != BiteStrip::rigid_plastic;
  if (reading.section || (free_arc && asks_free_arc(setup)))
    add_backup(inputs, spec, p);
  if (reading.free_arc)
    inputs.flow = word_of(setup.strip);
  if (!free_arc && !elastic_strip && !reading.elastic)
    inputs.strip.youngs_modulus = inputs.strip.poisson_ratio = not_given;
  if (!fits)
    return inputs;
  inputs.fit            = setup.fit;
  inputs.fit_for        = setup.fit_for;
  inputs.measured_width = parts.strip.width;
  for (const Pass &one : parts.passes)
    inputs.measured.push_back(inputs_of_measured(parts, one));
  return inputs;
}

namespace {
// Whether a unit has a symbol with its power as one of its parts: "N s/m" has "N", "s" and "m", "m2" only "m2".
bool has_in_it(const std::string_view unit, const std::string_view symbol)
{
  constexpr const char *between = " /()";
  for (std::size_t begin = unit.find_first_not_of(between); begin != unit.npos;) {
    const std::size_t end = std::min(unit.find_first_of(between, begin), unit.size());
    if (unit.substr(begin, end - begin) == symbol)
      return true;
    begin = unit.find_first_not_of(between, end);
  }
  return false;
}
}  // namespace

BiteReading reading_of(const ResultRow &row, const BiteAnswers by)
{
  BiteReading reading;
  reading.by          = by;
  reading.whole_width = has_in_it(row.unit, "N") || has_in_it(row.unit, "m2");  // m2: force per stress
  reading.speed       = has_in_it(row.unit, "s");
  reading.elastic     = &row == &row::bite::elastic_share;
  return reading;
}

KeyList bite_keys(MovingKeys &keys, const std::size_t p, const BiteReading &reading)
{
  const auto &[by, whole_width, fitted, path_trim, speed, elastic, free_arc, section] = reading;
  return keys.of(fmt::format("bite {} {} {} {} {} {} {} {} {}", p, int(by), whole_width, fitted, path_trim, speed,
                             elastic, free_arc, section),
                 [&](const CaseSpec &spec) { return record_text(inputs_of_bite(spec, p, reading)); });
}
}  // namespace mill
