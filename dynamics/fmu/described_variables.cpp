#include "core/base/text.h"
#include "dynamics/fmu/description.h"
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace mill::fmu {
namespace {
std::string spoken(std::string label)
{
  for (char &c : label)
    if (c == '_')
      c = ' ';
  return label;
}

}  // namespace

std::string force_text(const ExportedModel &model)
{
  const char *meaning = model.force_meaning == ForceMeaning::measured
                            ? "the whole measured bite force; K4 and C are zero, since their forces are part of it"
                        : model.force_meaning == ForceMeaning::disturbance
                            ? "the part of the bite force that the motion of the gap does not cause"
                            : "as published: in parallel with K4 and C, the mean included";
  return fmt::format("rolling force, positive pushes the work rolls apart: {}", meaning);
}

namespace {
std::string spring_text(const ExportedModel &model, const Variable &v)
{
  const SpringData &spring = model.data.springs[std::size_t(v.index)];
  const auto end           = [&](const int mass) {
    return mass == fixed_end ? std::string("ground") : spoken(model.data.points[std::size_t(mass)]);
  };
  return fmt::format("stiffness between {} and {}", end(spring.from), end(spring.to));
}

std::string bite_number_text(const Variable &v)
{
  switch (BiteNumber(v.index)) {
  case BiteNumber::roll_speed:
    return "surface speed of the work rolls, held over each step; the working point follows";
  case BiteNumber::reduction:
    return "reduction of thickness relative to that of the entry; the working point follows";
  case BiteNumber::entry_thickness:
    return "thickness of the strip at the entry, held over each step; the working point follows";
  case BiteNumber::entry_tension:
    return "steady back tension, held over each step; the working point follows";
  case BiteNumber::exit_tension:
    return "steady front tension, held over each step; the working point follows";
  case BiteNumber::viscosity:
    return "viscosity of the oil at the inlet of the bite; the working point follows";
  case BiteNumber::friction:
    return "friction coefficient; the working point follows";
  case BiteNumber::friction_scale:
    return "factor on the friction coefficient of its law; the working point follows";
  case BiteNumber::entry_thickness_change:
    return "change of the entry thickness from entry_thickness, held over each step; the working point stays";
  case BiteNumber::start:
    break;
  }
  return "displacement of both work rolls away from the strip at the start, all else at rest";
}

std::string steady_number_text(const Variable &v)
{
  static const std::map<std::string, const char *> texts{
      {"F_steady", "rolling force of the working point"},
      {"mu_steady", "friction coefficient of the working point"}};
  const auto text = texts.find(v.name);
  return text == texts.end() ? "radius of the flattened rolls, which the vibration does not change" : text->second;
}

std::string bite_reading_text(const Variable &v)
{
  switch (BiteReadingKind(v.index)) {
  case BiteReadingKind::gap_change:
    return "change of the roll gap, open positive";
  case BiteReadingKind::exit_thickness:
    return "thickness of the strip at the exit";
  case BiteReadingKind::force:
    return "rolling force, positive pushes the work rolls apart; zero where the strip is free";
  case BiteReadingKind::force_change:
    return "change of the rolling force from that of the working point";
  case BiteReadingKind::entry_tension:
    return "back tension; zero where the strip is slack";
  case BiteReadingKind::exit_tension:
    return "front tension; zero where the strip is slack";
  case BiteReadingKind::friction:
    return "friction coefficient in the bite";
  case BiteReadingKind::events:
    break;
  }
  return "number of events so far: strip that becomes slack or taut, rolls that skid or grip, strip that loses or "
         "gains "
         "contact, rolls that separate or touch";
}

std::string text_of(const ExportedModel &model, const Variable &v)
{
  const auto point   = [&] { return spoken(model.data.points[std::size_t(v.index)]); };
  const bool chatter = model.data.kind == StandKind::chatter;
  switch (v.role) {
  case Role::time:
    return "time";
  case Role::bite_force:
    return model.data.kind == StandKind::chatter
               ? "force in addition to that of the bite, positive pushes the work rolls apart"
               : force_text(model);
  case Role::bite_number:
    return bite_number_text(v);
  case Role::bite_reading:
    return bite_reading_text(v);
  case Role::steady_number:
    return steady_number_text(v);
  case Role::mean_force:
    return std::string("mean rolling force: displacements count from the state of rest under it") +
           (model.data.kind == StandKind::curves
                ? "; it cannot be changed, since the springs are loaded by it at rest"
                : "");
  case Role::stored_force:
    return "true plays resources/force.csv, linear between its samples, for any F_roll; false does not. Where "
           "it is "
           "not set, the record is played until F_roll is set";
  case Role::mass:
    return "mass of the " + point();
  case Role::spring:
    return spring_text(model, v);
  case Role::gap_damper:
    return "damper between the work rolls";
  case Role::modal_damping:
    return "damping of every mode, ratio of critical, follows the modes when stiffnesses change";
  case Role::acceleration:
    return "acceleration of the " + point() + (chatter ? ", away from the strip" : ", up positive");
  case Role::displacement:
    return "displacement of the " + point() +
           (chatter ? ", away from the strip, from the working point"
                    : ", up positive, from the state of rest under F_mean");
  case Role::cell_force:
    return "force on the load cell, compression positive, with its share of F_mean";
  case Role::frequency:
    break;
  }
  return fmt::format("undamped natural frequency of mode {}", v.index + 1);
}

bool is_legal(const Variable &v)
{
  switch (v.causality) {
  case Causality::parameter:
  case Causality::calculated_parameter:
    return v.variability == Variability::fixed || v.variability == Variability::tunable;
  case Causality::input:
  case Causality::output:
    return v.variability == Variability::discrete || v.variability == Variability::continuous;
  case Causality::independent:
    break;
  }
  return v.variability == Variability::continuous;
}

bool shows(const UnitRow &unit, const std::string &display)
{
  for (const auto &[name, factor] : unit.displays)
    if (name == display)
      return true;
  return display.empty();
}
}  // namespace

std::vector<DescribedVariable> described_variables(const ExportedModel &model, const int fmi_version)
{
  std::vector<DescribedVariable> all;
  const auto table = variables_of(model.data);
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i].role == Role::time && fmi_version == 2)
      continue;
    std::string text   = text_of(model, table[i]);
    const auto written = model.source.find(table[i].name);
    if (written != model.source.end())
      text += " (" + written->second + ")";
    all.push_back({table[i], text, unsigned(i)});
  }
  return all;
}

const char *name_of(const Causality causality)
{
  switch (causality) {
  case Causality::parameter:
    return "parameter";
  case Causality::calculated_parameter:
    return "calculatedParameter";
  case Causality::input:
    return "input";
  case Causality::output:
    return "output";
  case Causality::independent:
    break;
  }
  return "independent";
}

const char *name_of(const Variability variability)
{
  switch (variability) {
  case Variability::fixed:
    return "fixed";
  case Variability::tunable:
    return "tunable";
  case Variability::discrete:
    return "discrete";
  case Variability::continuous:
    break;
  }
  return "continuous";
}

bool is_calculated(const Variable &variable)
{
  return variable.causality != Causality::input && variable.causality != Causality::independent &&
         variable.causality != Causality::parameter;
}

std::string initial_of(const Variable &variable)
{
  if (is_calculated(variable))
    return "calculated";
  return variable.causality == Causality::parameter ? "exact" : "";
}

const std::vector<UnitRow> &unit_rows()
{
  static const std::vector<UnitRow> rows{{"kg", 1, 0, 0, {}},
                                         {"m", 0, 1, 0, {{"um", 1e6}, {"mm", 1e3}}},
                                         {"s", 0, 0, 1, {}},
                                         {"N", 1, 1, -2, {{"kN", 1e-3}}},
                                         {"N/m", 1, 0, -2, {{"kN/mm", 1e-6}}},
                                         {"N.s/m", 1, 0, -1, {}},
                                         {"m/s2", 0, 1, -2, {{"g", 1 / 9.80665}}},
                                         {"Hz", 0, 0, -1, {}},
                                         {"m/s", 0, 1, -1, {}},
                                         {"Pa", 1, -1, -2, {{"MPa", 1e-6}}},
                                         {"Pa.s", 1, -1, -1, {}},
                                         {"1", 0, 0, 0, {{"%", 100}}}};
  return rows;
}

std::vector<std::string> broken_rules(const std::vector<DescribedVariable> &variables)
{
  std::vector<std::string> broken;
  std::set<std::string> names;
  std::set<unsigned> references;
  for (const DescribedVariable &described : variables) {
    const Variable &v   = described.variable;
    const auto complain = [&](const std::string &what) { broken.push_back(v.name + ": " + what); };
    if (v.name.empty() || has_any(v.name, "\r\n\t\\"))
      complain("illegal name");
    if (!names.insert(v.name).second)
      complain("the name is not unique");
    if (!references.insert(described.reference).second)
      complain("the value reference is not unique");
    if (!is_legal(v))
      complain(fmt::format("{} and {} cannot be combined", name_of(v.causality), name_of(v.variability)));
    if (v.type != Type::real && v.variability == Variability::continuous)
      complain("only real numbers can be continuous");
    if (v.has_start() && !std::isfinite(v.start))
      complain("the start value is not a finite number");
    if (v.has_start() && v.bounded() && (v.start < v.low || v.start > v.high))
      complain(
          fmt::format("the start value {:g} {} is out of the range {:g} .. {:g}", v.start, v.unit, v.low, v.high));
    if (v.type != Type::real)
      continue;
    const UnitRow *unit = nullptr;
    for (const UnitRow &row : unit_rows())
      if (std::string(row.name) == v.unit)
        unit = &row;
    if (!unit)
      complain(fmt::format("the unit \"{}\" is not defined", v.unit));
    else if (!shows(*unit, v.display_unit))
      complain(fmt::format("the display unit {} does not belong to {}", v.display_unit, v.unit));
  }
  return broken;
}
}  // namespace mill::fmu
