#include "core/case/advice_rows.h"
#include "core/case/kinds.h"
#include "core/case/monitoring.h"
#include "core/case/plant.h"
#include "core/case/stand_reader.h"
#include "core/case/stand_sections.h"
#include <utility>

namespace mill {
namespace {
using Repeat = SectionRows::Repeat;

std::vector<SectionRows> chatter_sections()
{
  std::vector<SectionRows> all{head_section()};
  const auto add = [&](const char *name, const Repeat repeat, const bool needed, const char *meaning,
                       std::vector<Row> rows) {
    all.push_back({name, repeat, needed, meaning, std::move(rows)});
  };
  add("steel", Repeat::once, false, "material of the rolls", rows_of(chatter_steel_rows()));
  add("work_roll", Repeat::once, true, "both work rolls", rows_of(bite_roll_rows()));
  add("strip", Repeat::once, true, "the strip in the bite", rows_of(chatter_strip_rows()));
  add("strip.flow_stress", Repeat::once, true, "plane-strain flow stress of the strip",
      rows_of(flow_stress_rows()));
  add("strip.friction", Repeat::once, false, "friction without [oil], if it is not a single number",
      rows_of(friction_rows()));
  add("oil", Repeat::once, false, "the film between roll and strip", rows_of(oil_rows()));
  add("oil.friction", Repeat::once, false, "friction over that film", rows_of(oil_friction_rows()));
  add("stand", Repeat::once, true, "the stand around the bite and the strip around the stand",
      rows_of(chatter_stand_rows()));
  add("variant", Repeat::named, false,
      "another model of the stand; values that it leaves out are those of [stand]", rows_of(chatter_stand_rows()));
  add("condition", Repeat::list, true, "what rolls at one working point", rows_of(condition_rows()));
  add("analysis", Repeat::once, false, "how chatter is searched", rows_of(chatter_analysis_rows()));
  all.push_back(monitoring_section());
  all.push_back(ball_bearing_section());
  all.push_back(plant_section());
  all.push_back(chatter_advice_section());
  return all;
}
}  // namespace

const CaseKind &case_kind(const ChatterCase *)
{
  static const CaseKind kind = [] {
    CaseKind k;
    k.name     = word_of(KindOfCase::chatter);
    k.title    = "chatter of a stand";
    k.read     = [](const Node &root, Reading &reading) -> CaseSpec { return read_chatter(root, reading); };
    k.sections = chatter_sections();
    k.notes    = {{"work_roll", "", {{"diameter", "\"600 mm\""}}, {}},
                  {"strip", "", {}, {"initial_thickness"}},
                  {"strip.flow_stress",
                   "",
                   {{"law", "\"reduction-power\""}, {"k", "\"829.64 MPa\""}, {"eps0", "0.00817"}, {"n", "0.3"}},
                   {"k"}},
                  {"strip.friction", "", {}, {}, true},
                  {"stand", "", {}, {"masses", "stiffnesses", "dampings", "entry_distance", "exit_distance"}},
                  {"variant", "", {}, {}, true},  // [stand] says it
                  {"analysis", "", {}, {"speeds"}}};
    k.notes.push_back(monitoring_note());
    k.notes.push_back(ball_bearing_note());
    k.notes.push_back(plant_note());
    k.notes.push_back(chatter_advice_note());
    k.repeated = [](const CaseSpec &spec, const std::string &section) {
      const auto &the_case = std::get<ChatterCase>(spec);
      if (section == "variant")
        return names_in(the_case.variants);
      return section == "condition" ? numbers_to(the_case.conditions.size()) : std::vector<std::string>();
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
