#include "app/trace/closed_form_stand.h"
#include "app/stages/stand/gauge_results.h"
#include "app/stages/stand/mode_results.h"
#include "core/base/force_text.h"
#include "core/case/modulus_inputs.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/model/four_high.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_stand.h"
#include "reduce/stand/stand_modulus.h"
#include <fmt/format.h>
#include <utility>

namespace mill {
namespace {
ClosedFormResult made(const std::string &name, const char *unit, const double value, const char *method,
                      const OperatingPoint &load)
{
  ClosedFormResult r;
  r.name             = name;
  r.parameter.unit   = unit;
  r.parameter.value  = value;
  r.parameter.method = method;
  r.parameter.at     = load;
  return r;
}

// The first pass on its way into the list.
struct ClosedFormModulus {
  std::vector<ClosedFormResult> &all;
  const FourHigh &stand;
  const SpringFactors &factors;
  OperatingPoint at;
  double load;
  MovingKeys *keys;  // null: no lists

  ResultName name_of(const RowOf<1> &row) const
  {
    return stand_result(stand, 0, row);
  }
  double value(const std::string &name) const
  {
    return find(all, name)->parameter.value;
  }
  void add(ClosedFormResult r, const std::vector<std::string> &from, const KeyList &keys, const char *file,
           const char *equation) const
  {
    r.from     = from;
    r.relation = "mill modulus";
    r.file     = file;
    r.equation = equation;
    inherit(r, all, keys);
    all.push_back(std::move(r));
  }
  // Springs of the chain on the path of the force, then others.
  static std::vector<std::string> path(const std::vector<std::string> &others)
  {
    std::vector<std::string> names{"K1", "K2", "K3", "K5", "K6", "K7"};
    names.insert(names.end(), others.begin(), others.end());
    return names;
  }
  double series(const std::vector<std::string> &names, const double more = 0) const
  {
    double compliance = more;
    for (const std::string &name : names)
      compliance += 1 / value(name);
    return 1 / compliance;
  }
  void add_kissing() const;
  bool add_bite() const;
  void add_with_strip() const;
};

void ClosedFormModulus::add_kissing() const
{
  const std::string touching = name_of(row::stand::K_ww_tangent);
  add(made(touching, "N/m", reduce::line_contact(reduce::work_roll_pair(stand), load).tangent,
           "Hertz line contact of both work rolls over the barrel", at),
      {}, keys ? touching_roll_keys(*keys, 0) : KeyList(), "reduce/chain/line_contact", "(3.5b)");
  const auto names = path({touching});
  add(made(name_of(row::stand::modulus_kiss), "N/m", series(names), "springs in series, work rolls on each other",
           at),
      names, {}, "reduce/chain/mill_modulus", "(30.1)");
}

// What moves the flattening on a rigid arc, and what does not move the plastic slope there.
KeyList without(const KeyList &keys, const KeyList &others)
{
  KeyList left;
  for (const std::string &key : keys)
    if (!holds(others, key))
      left.push_back(key);
  return left;
}

// Flattening and plastic slope by the slab theory that gives K4; false where it has no answer or K4 is given.
bool ClosedFormModulus::add_bite() const
{
  const ClosedFormResult *K4 = find(all, "K4");
  const auto stiffness       = stand.given.count("K4") ? std::nullopt : closed_form_bite_stiffness(stand, 0);
  if (!K4 || !stiffness || !(stiffness->flattening > 0))
    return false;
  const bool rigid       = stand.bite.arc == BiteArc::rigid;
  const KeyList elastic  = keys_in("steel", "youngs_modulus poisson_ratio"),
                arc      = joined(keys_in("strip", "width entry_thickness exit_thickness"),
                                  keys_in("pass.0", "entry_thickness exit_thickness"),
                                  KeyList{"work_roll.barrel_diameter", "bite.arc"}, elastic);
  ClosedFormResult slope = *K4, flattening = *K4;
  slope.name                 = "K4.plastic_slope";
  slope.parameter.value      = stiffness->plastic_slope * factor(factors, slope.name);
  flattening.name            = "K4.flattening";
  flattening.parameter.value = stiffness->flattening * factor(factors, flattening.name);
  if (rigid) {
    slope.closed      = without(slope.closed, elastic);
    flattening.closed = without(arc, without(arc, K4->closed));
  }
  all.push_back(std::move(slope));
  all.push_back(std::move(flattening));
  return true;
}

void ClosedFormModulus::add_with_strip() const
{
  const double K3 = value("K3"), K5 = value("K5");
  const double bend = reduce::work_rolls_bending(stand, nullptr, stand.strip.width, K3, K5);
  std::vector<std::string> more{"K4.flattening"};
  if (bend * K3 > reduce::least_bending) {
    ClosedFormResult r =
        made(name_of(row::stand::K_bend), "N/m", factor(factors, name_of(row::stand::K_bend)) / bend,
             "Euler beam on its contact line", at);
    r.symbol = "K_bend";
    if (stand.backup_roll.bending_model == BendingModel::solid)
      r.stands_for = "the work rolls by finite elements, backup_roll.bending_model = \"solid\"";
    add(std::move(r), {"K3", "K5"}, keys ? bent_work_roll_keys(*keys, false) : KeyList(),
        "reduce/chain/mill_modulus", "(30.3)");
    more.push_back(name_of(row::stand::K_bend));
  }
  const auto names          = path(more);
  const double M            = series(names, 1 / value("K4.flattening"));  // both rolls are flattened
  const std::string modulus = name_of(row::stand::modulus_tangent), slope = "K4.plastic_slope";
  add(made(modulus, "N/m", M, "springs in series, strip between the work rolls", at), names, {},
      "reduce/chain/mill_modulus", "(30.1)");
  const reduce::GaugeCoupling gauge{M, value(slope)};
  if (!(gauge.Q > 0))
    return;
  add(made(name_of(row::stand::screw_sensitivity), "1", gauge.screw(), "mill modulus and plastic slope", at),
      {modulus, slope}, {}, "app/stages/stand/gauge_results", "(30.7)");
  add(made(name_of(row::stand::force_by_screw), "N/m", gauge.force_by_screw(), "mill modulus and plastic slope",
           at),
      {modulus, slope}, {}, "app/stages/stand/gauge_results", "(30.9)");
}
}  // namespace

void add_quick_modulus(std::vector<ClosedFormResult> &all, const FourHigh &stand, const double load,
                       const SpringFactors &factors, MovingKeys *keys)
{
  const ClosedFormModulus modulus{all, stand, factors, force_text(load), load, keys};
  modulus.add_kissing();
  if (modulus.add_bite())
    modulus.add_with_strip();
}

void add_named_modes_of_chain(std::vector<ClosedFormResult> &all, const LumpedModel &model,
                              const DynamicsSettings &settings, const GapState named,
                              const std::string &stands_for, MovingKeys *const keys)
{
  const auto names = chain_with_modes(model, settings).names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const ClosedFormResult *f = find(all, row::modes::vertical.of(word_of_state(named), std::to_string(i + 1)));
    if (!f || names[i].key.empty() || !names[i].listed)
      continue;
    ClosedFormResult r = *f;
    r.name             = row::modes::frequency.of(word_of_state(named), names[i].key);
    r.parameter.method = "six-mass chain, " + names[i].name;
    r.from             = {f->name};
    r.own_keys         = {};
    r.relation         = "modes by name";
    r.file             = "reduce/stand/gap_modes";
    r.equation         = "(22.23)";
    r.stands_for       = stands_for;
    if (!stands_for.empty() && keys)
      r.parameter.inputs = joined(std::move(r.parameter.inputs), detailed_model_keys(*keys));
    ClosedFormResult share = r;
    share.name             = row::modes::gap_share.of(word_of_state(named), names[i].key);
    share.parameter.value  = names[i].gap_share;
    share.parameter.unit   = "1";
    share.relation         = "share of a mode in the compliance of the gap";
    for (const ChainNumber spring : gap_compliance_parts(settings))  // the halves share the gap
      if (!holds(f->from, word_of(spring)))
        share.from.push_back(word_of(spring));
    inherit(share, all, {});
    share.parameter.inputs = joined(std::move(share.parameter.inputs), r.parameter.inputs);
    all.push_back(std::move(r));
    all.push_back(std::move(share));
  }
}
}  // namespace mill
