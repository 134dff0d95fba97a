#include "app/stages/bearing/bearing_model.h"
#include "app/stages/bearing/bearing_study.h"
#include "app/stages/contact/contact_stage.h"
#include "app/trace/closed_form_chain.h"
#include "app/trace/closed_form_parts.h"
#include "core/base/force_text.h"
#include "core/case/moving_keys.h"
#include "core/model/case.h"
#include "core/model/seat_load.h"
#include "core/records/record_text.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_bearing.h"
#include "reduce/bearing/oil_film/oil_film_state.h"
#include <cmath>
#include <fmt/format.h>
#include <utility>

// Bearings between rigid rings, for the closed-form model.
namespace mill {
namespace {
bool by_elements(const RollerBearing &b)
{
  return b.roller_law == OneRollerLaw::fe || b.rings == RingBodies::elastic;
}

std::string closed_method(const RollerBearing &b)
{
  const std::string law = b.roller_law == OneRollerLaw::palmgren  ? "Palmgren's law of one roller"
                          : b.roller_law == OneRollerLaw::elastic ? "elastic line contact of one roller"
                                                                  : "laminae of ISO/TS 16281";
  return law + ", rigid rings, reduce/bearing/assembly (5.23)";
}

// The keys that the closed form of a result follows.
BearingReading closed(BearingReading reading)
{
  reading.closed_form = true;
  return reading;
}

bearing::AssemblyState solved(const RollerBearing &b, const bearing::RingLoading &loading,
                              const double cage_angle = 0, const double centrifugal = 0)
{
  auto model              = bearing::rigid_model(bearing::between_rigid_rings(b));
  model.cage_angle        = cage_angle;
  model.centrifugal_force = centrifugal;
  return bearing::BearingAssembly(model).solve(loading);
}

// Under a radial load; of neighbouring cases few have another bearing.
const bearing::AssemblyState &remembered_bearing(const RollerBearing &b, const double load,
                                                 ClosedFormMemory &memory)
{
  const auto key   = std::make_pair(record_text(b), load);
  const auto known = memory.bearings.find(key);
  return known != memory.bearings.end()
             ? known->second
             : memory.bearings.emplace(key, solved(b, bearing::radial_drive(load))).first->second;
}

// An oil film on the coarser of its two grids.
ClosedFormResult closed_form_film(const char *name, const OilFilmBearing &film, const bearing::OilFilmLoad &load,
                                  const KeyList &keys, const bool across)
{
  ClosedFormResult r;
  r.name             = name;
  const auto state   = bearing::coarse_oil_film(film, load).at;
  r.parameter.value  = state.stiffness(across, across);
  r.film_damper      = state.damping(across, across);
  r.parameter.unit   = "N/m";
  r.parameter.method = across ? "oil film on one grid, across the load" : "oil film on one grid";
  r.parameter.at     = {"{} on one bearing", {{load.load, "kN", force_form(load.load)}}};
  r.closed           = keys;
  r.relation         = "oil film";
  r.file             = "reduce/bearing/oil_film/film_reactions";
  r.equation         = "(29.7)";
  r.stands_for       = "the same on two grids";
  return r;
}

bearing::OilFilmLoad film_load(const BearingCase &spec)
{
  return {spec.load.radial, 2 * M_PI * spec.load.speed, {spec.load.tilt, spec.load.tilt_across}};
}
}  // namespace

std::vector<ClosedFormResult> closed_form_bearings(const FourHigh &stand, const double F, const std::size_t pass,
                                                   ClosedFormMemory &memory, MovingKeys *keys)
{
  std::vector<ClosedFormResult> all;
  const auto add_both = [&](const ClosedFormResult &one, const char *name) {
    ClosedFormResult r = one;
    r.name             = name;
    r.parameter.value *= 2;
    r.film_damper *= 2;
    all.push_back(r);
  };
  for (int i = 0; i < 4; ++i) {
    const bool backup   = i == 0 || i == 3;
    const auto &contact = i < 2 ? stand.upper_contact : stand.lower_contact;
    const Roll &roll    = backup ? stand.backup_roll : stand.work_roll;
    const double load   = seat_load(stand, backup, contact, F).value;
    if (roll.bearing.empty()) {  // not drawn, since all of its stiffnesses are given
      ClosedFormResult r;
      r.name      = fmt::format("Kzc{}", i + 1);
      r.parameter = stand.given.at(r.name).parameter;
      r.load      = load;
      all.push_back(r);
      if (backup)
        add_both(r, i == 0 ? "K_Zy" : "K_Zy_lower");
      continue;
    }
    if (const OilFilmBearing *film = oil_film_of(stand.oil_films, roll.bearing)) {
      const bearing::OilFilmLoad on{load, stand.passes[pass].speed / (roll.barrel_diameter / 2), {0, 0}};
      const std::string name = fmt::format("Kzc{}", i + 1);
      const KeyList list     = keys ? seat_keys(*keys, std::size_t(i), pass) : KeyList();
      ClosedFormResult r     = closed_form_film(name.c_str(), *film, on, list, false);
      r.load                 = load;
      all.push_back(r);
      add_both(r, i == 0 ? "K_Zy" : "K_Zy_lower");
      all.push_back(closed_form_film((name + "_across").c_str(), *film, on, list, true));
      continue;
    }
    const auto &b      = bearing_of(stand.bearings, roll.bearing);
    const auto loading = bearing::radial_drive(load);
    const auto &state  = remembered_bearing(b, load, memory);
    ClosedFormResult r;
    r.name             = fmt::format("Kzc{}", i + 1);
    r.parameter.value  = bearing::radial_tangent(state, loading);
    r.parameter.unit   = "N/m";
    r.parameter.method = closed_method(b);
    r.parameter.at     = {"{} on one bearing", {{load, "kN", force_form(load)}}};
    r.load             = load;
    if (keys)
      r.closed = seat_keys(*keys, std::size_t(i), pass, closed({}));
    r.relation   = backup ? "bearings of the backup rolls" : "bearings of the work rolls";
    r.file       = "reduce/bearing/assembly";
    r.equation   = "(5.23)";
    r.stands_for = by_elements(b) ? model_name(b) : "";
    all.push_back(r);
    if (backup)
      add_both(r, i == 0 ? "K_Zy" : "K_Zy_lower");
    r.name += "_across";
    if (keys)
      r.closed = seat_keys(*keys, std::size_t(i), pass, closed({BearingAsks::across}));
    r.parameter.value = stiffness_along(state, loading, 1);
    r.parameter.method += ", across the load";
    r.file       = "app/stages/bearing/bearing_across";
    r.stands_for = by_elements(b) ? model_name(b) + ", a block chock on its liner" : "";
    all.push_back(r);
  }
  return all;
}

std::vector<ClosedFormResult> closed_form_bearing_case(const BearingCase &spec, MovingKeys *keys)
{
  const auto keys_of = [&](const BearingReading &reading) {
    return keys ? bearing_case_keys(*keys, reading) : KeyList();
  };
  if (const OilFilmBearing *film = oil_film_of(spec.oil_films, spec.load.bearing)) {
    const KeyList inputs = keys_of({});
    std::vector<ClosedFormResult> both;
    for (const bool across : {false, true}) {
      both.push_back(
          closed_form_film(across ? "Kzc.tangent_across" : "Kzc.tangent", *film, film_load(spec), inputs, across));
      both.back().parameter.inputs = inputs;
    }
    return both;
  }
  const RollerBearing &b         = bearing_of(spec.bearings, spec.load.bearing);
  const BearingQuestion question = question_of(spec);
  const auto loading             = bearing::drive_of(question, spec.load.radial);
  const auto state               = solved(b, loading, spec.load.cage_angle, question.centrifugal);
  std::vector<ClosedFormResult> all;
  const auto add = [&](const RowOf<1> &row, const double value, const char *equation) {
    ClosedFormResult r;
    r.name             = row.of(family::bearing).text();
    r.parameter.value  = value;
    r.parameter.unit   = row.unit;
    r.parameter.method = closed_method(b);
    r.closed           = keys_of(closed(reading_of_bearing(row)));
    r.parameter.inputs = keys_of(reading_of_bearing(row));
    r.relation         = "equilibrium of all rollers";
    r.file             = "reduce/bearing/assembly";
    r.equation         = equation;
    r.stands_for       = by_elements(b) ? model_name(b) : "";
    all.push_back(r);
  };
  add(row::bearing::tangent, bearing::radial_tangent(state, loading), "(5.23)");
  if (spec.load.radial > 0)
    add(row::bearing::secant, bearing::radial_secant(state), "(5.22)");
  add(row::bearing::tangent_across, bearing::stiffness_along(state, loading, 1), "(5.23)");
  add(row::bearing::axial, state.tangent(2, 2), "(5.23)");
  add(row::bearing::roller_max, state.roller_load.maxCoeff(), "(5.22)");
  return all;
}

}  // namespace mill
