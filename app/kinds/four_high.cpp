#include "app/kinds/manifest_parts.h"
#include "app/kinds/mark_sources.h"
#include "app/kinds/pipeline.h"
#include "app/review/case_review.h"
#include "app/run/run_kind.h"
#include "app/stages/bite/bite_stage.h"
#include "app/trace/closed_form_chain.h"
#include "app/trace/trace_key.h"
#include "core/model/case.h"
#include <nlohmann/json.hpp>
#include <utility>

namespace mill {
namespace {
using json = nlohmann::ordered_json;

json geometry_of(const FourHigh &stand)
{
  json geometry  = {{"work_roll_diameter", stand.work_roll.barrel_diameter},
                    {"work_roll_length", stand.work_roll.barrel_length},
                    {"work_neck_diameter", stand.work_roll.neck_diameter},
                    {"work_total_length", stand.work_roll.barrel_length + 2 * stand.work_roll.neck_length},
                    {"work_bearing_span", stand.work_roll.bearing_span},
                    {"backup_diameter", stand.backup_roll.barrel_diameter},
                    {"backup_length", stand.backup_roll.barrel_length},
                    {"backup_neck_diameter", stand.backup_roll.neck_diameter},
                    {"backup_neck_length", stand.backup_roll.neck_length},
                    {"backup_bearing_span", stand.backup_roll.bearing_span},
                    {"strip_width", stand.strip.width},
                    {"entry_thickness", stand.strip.entry_thickness},
                    {"exit_thickness", stand.strip.exit_thickness}};
  const auto add = [&](const char *name, const double length) {
    if (length > 0)  // false for what is not given
      geometry[name] = length;
  };
  if (const MillHousing &h = stand.housing; h.present()) {
    add("housing_thickness", h.thickness);
    add("housing_post_width", h.post_width);
    add("housing_window_width", h.window_width);
    add("housing_window_height", h.window_height);
    add("housing_upper_beam_height", h.upper_beam_height);
    add("housing_lower_beam_height", h.lower_beam_height);
  }
  const Screwdown &s = stand.screwdown;
  add("screw_diameter", s.screw_diameter);
  add("screw_length", s.screw_length);
  add("nut_outside_diameter", s.nut_outside_diameter);
  add("nut_height", s.nut_height);
  add("piston_diameter", s.piston_diameter);
  add("piston_length", s.piston_length);
  add("stroke", s.stroke);
  add("load_cell_diameter", s.load_cell_diameter);
  add("load_cell_height", s.load_cell_height);
  return geometry;
}

std::optional<StandIn> four_high_stand_in(const Case &the_case, const TraceKey &key,
                                          const std::vector<ClosedFormResult> &closed)
{
  const auto &stand = std::get<FourHigh>(the_case.spec);
  if (key.name.rfind("given.", 0) == 0)
    return computed_instead(closed, key.row.key);
  if (const auto pass = pass_of(key)) {
    const std::string prefix = *pass == 0 ? "" : stand.passes[*pass].name + ".";
    if (const ClosedFormResult *contact = find(closed, prefix + "K3");
        key.row.key == "load" && contact && contact->load > 0)
      return StandIn{contact->load, "not given: mean of the force record"};
    return strip_instead(stand.strip, key);
  }
  if (key.name == "strip.initial_thickness")
    return StandIn{stand.strip.entry_thickness, "not given: the entry thickness"};
  if (key.row.key != "bearing_load")
    return {};
  const bool backup               = key.name.rfind("backup_roll.", 0) == 0;
  const ClosedFormResult *bearing = find(closed, backup ? "Kzc1" : "Kzc2");
  if (!bearing)
    return {};
  return StandIn{bearing->load,
                 backup ? "not given: half the rolling force" : "not given: from the rolling force, assumed"};
}
}  // namespace

const RunKind &run_kind(const FourHigh &)
{
  static const RunKind kind = [] {
    RunKind k;
    k.verbs  = {Verb::run, Verb::stiffness, Verb::masses, Verb::modes, Verb::chatter, Verb::simulate};
    k.check  = check_bites;
    k.review = review_stand;
    k.stages = [](const Case &) -> std::vector<std::pair<std::string, double>> {
      return {{"condensation", 1}, {"condensation", 10}, {"condensation", 1},
              {"condensation", 8}, {"contact upper", 2}, {"contact lower", 2},
              {"components", 3},   {"bite, curves", 8},  {"passes", 4}};
    };
    k.run = [](RunContext &run, const Goal goal, const std::string &force_file) {
      run_four_high(run, std::get<FourHigh>(run.the_case.spec), goal, force_file);
    };
    k.driven = [](RunContext &run, const std::string &pass) {
      return driven_four_high(run, std::get<FourHigh>(run.the_case.spec), pass);
    };
    k.mark_sources = [](const Case &the_case) { return mark_sources(std::get<FourHigh>(the_case.spec)); };
    k.describe     = [](const Case &the_case, json &manifest) {
      const auto &stand    = std::get<FourHigh>(the_case.spec);
      manifest["geometry"] = geometry_of(stand);
      add_bearings(manifest, stand.bearings);
      add_passes(manifest, stand.passes, stand.dynamics.force_meaning);
    };
    k.trace = [](const Case &the_case, ClosedFormMemory &memory, const std::map<std::string, double> &factors) {
      return closed_form_four_high(std::get<FourHigh>(the_case.spec), memory, factors);
    };
    k.stand_in = four_high_stand_in;
    return k;
  }();
  return kind;
}
}  // namespace mill
