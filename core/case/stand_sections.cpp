#include "core/case/stand_rows.h"
#include <fmt/format.h>

namespace mill {
namespace {
// Published values of the 1400 mm four-high stand, doi 10.21203/rs.3.rs-1441429/v1, are the examples of [given].
Row stiffness_beside(const std::string &key, const char *unit, const Range &range, const char *example,
                     const std::string &meaning)
{
  return {key, Kind::quantity, unit, range, absent, example, meaning};
}

void add_roller_rows(std::vector<Row> &rows)
{
  const char *rollers[] = {"6.78395e5 N/mm", "6.37958e5 N/mm", "6.23286e5 N/mm", "6.47685e5 N/mm"};
  for (int i = 0; i < 4; ++i)
    rows.push_back(stiffness_beside(fmt::format("row{}_roller", i + 1), "N/mm", {1, 1e9}, rollers[i],
                                    fmt::format("stiffness of one roller in row {}", i + 1)));
}

std::vector<Row> made_bite_rows()
{
  return {stiffness_beside("K4", "kN/mm", {0.001, 1e9}, "1.91141e5 kN/mm", "stiffness between the work rolls")};
}

std::vector<Row> made_bearing_rows()
{
  std::vector<Row> rows{
      stiffness_beside("Kzc", "kN/mm", {0.001, 1e9}, "2.01e4 kN/mm", "radial stiffness of the bearing")};
  add_roller_rows(rows);
  return rows;
}

std::vector<Row> made_given_rows(const bool lumped)
{
  const char *masses[]       = {"9321.943 kg", "59716.884 kg", "1888.705 kg",
                                "3094.684 kg", "42200.563 kg", "4663.290 kg"};
  const char *springs[]      = {"6.3086e3 kN/mm",  "1.0233e4 kN/mm", "7.53399e5 kN/mm", "1.91141e5 kN/mm",
                                "6.58293e5 kN/mm", "2.9301e4 kN/mm", "6.8789e3 kN/mm"};
  const char *mass_text[]    = {"upper frame",     "upper backup roll", "upper work roll",
                                "lower work roll", "lower backup roll", "lower frame"};
  const char *spring_text[]  = {"ground to M1",
                                "M1 to M2",
                                "M2 to M3, contact of the upper rolls",
                                "M3 to M4, bite",
                                "M4 to M5, contact of the lower rolls",
                                "M5 to M6",
                                "M6 to ground"};
  const char *bearing_text[] = {"upper backup roll", "upper work roll", "lower work roll", "lower backup roll"};
  const Fallback chain       = lumped ? required : absent;
  std::vector<Row> rows;
  const auto number = [](const int i) { return std::to_string(i + 1); };
  for (int i = 0; i < 6; ++i)
    rows.push_back({
        "M" + number(i),
        Kind::quantity,
        "kg",
        {0.001, 1e7},
        chain,
        masses[i],
        std::string("equivalent mass, ") + mass_text[i]
    });
  for (int i = 0; i < 7; ++i)
    rows.push_back({
        "K" + number(i),
        Kind::quantity,
        "kN/mm",
        {i == 3 ? 0 : 0.001, 1e9},
        chain,
        springs[i],
        spring_text[i]
    });  // an open bite is a case of its own, any other open spring a torn stand
  for (int i = 0; i < 4; ++i)
    rows.push_back({
        "Kzc" + number(i),
        Kind::quantity,
        "kN/mm",
        {0.001, 1e9},
        absent,
        "2.01e4 kN/mm",
        std::string("radial stiffness of one bearing along its load, ") + bearing_text[i]
    });
  for (int i = 0; i < 4; ++i)
    rows.push_back({
        "Kzc" + number(i) + "_across",
        Kind::quantity,
        "kN/mm",
        {0.001, 1e9},
        absent,
        "2.01e4 kN/mm",
        std::string("the same across its load, for the horizontal motion; when absent that along the load, ") +
            bearing_text[i]
    });
  rows.push_back({
      "C", Kind::quantity, "N s/m", {0, 1e12},
         absent, "1.91141e5 N s/m", "damper beside K4"
  });
  if (!lumped) {
    rows.push_back({
        "K_Zy",
        Kind::quantity,
        "kN/mm",
        {0.001, 1e9},
        absent,
        "1.0229e5 kN/mm",
        "two backup-roll bearings together"
    });
    rows.push_back({
        "K_ZW",
        Kind::quantity,
        "kN/mm",
        {0.001, 1e9},
        absent,
        "6.8123e4 kN/mm",
        "bending and shear of a backup roll"
    });
  }
  return rows;
}

std::vector<Row> with_tolerances(std::vector<Row> rows)
{
  const auto tolerances = tolerance_rows(rows);
  rows.insert(rows.end(), tolerances.begin(), tolerances.end());
  return rows;
}

std::vector<SectionRows> chatter_sections(const SectionRows &head)
{
  using Repeat = SectionRows::Repeat;
  std::vector<SectionRows> all{head};
  const auto add = [&](const char *name, const Repeat repeat, const bool needed, const char *meaning,
                       std::vector<Row> rows) {
    all.push_back({name, repeat, needed, meaning, std::move(rows)});
  };
  add("steel", Repeat::once, false, "material of the rolls", rows_of(chatter_steel_rows()));
  add("work_roll", Repeat::once, true, "both work rolls", rows_of(bite_roll_rows()));
  add("strip", Repeat::once, true, "the strip in the bite", rows_of(chatter_strip_rows()));
  add("strip.flow_stress", Repeat::once, true, "plane-strain flow stress of the strip",
      rows_of(flow_stress_rows()));
  add("strip.friction", Repeat::once, false, "friction where there is no [oil] and it is no number",
      rows_of(friction_rows()));
  add("oil", Repeat::once, false, "the film between roll and strip", rows_of(oil_rows()));
  add("oil.friction", Repeat::once, false, "friction over that film", rows_of(oil_friction_rows()));
  add("stand", Repeat::once, true, "the stand around the bite and the strip around the stand",
      rows_of(chatter_stand_rows()));
  add("variant", Repeat::named, false, "another reading of the stand; what it leaves out is that of [stand]",
      rows_of(chatter_stand_rows()));
  add("condition", Repeat::list, true, "what rolls at one working point", rows_of(condition_rows()));
  add("analysis", Repeat::once, false, "how chatter is searched", rows_of(chatter_analysis_rows()));
  return all;
}
}  // namespace

const std::vector<Row> &given_rows(const std::string &kind, const bool published)
{
  static const std::vector<Row> lumped = made_given_rows(true), four_high = made_given_rows(false),
                                bearing = made_bearing_rows(), bite = made_bite_rows();
  static const std::vector<Row> beside_stand = [] {
    auto rows = made_given_rows(false);
    add_roller_rows(rows);
    return rows;
  }();
  return kind == "lumped"    ? lumped
         : kind == "bearing" ? bearing
         : kind == "bite"    ? bite
         : published         ? beside_stand
                             : four_high;
}

const std::vector<std::string> &case_kinds()
{
  static const std::vector<std::string> kinds{"four-high", "lumped", "two-cylinders",
                                              "bearing",   "bite",   "chatter"};
  return kinds;
}

std::vector<SectionRows> sections_of(const std::string &kind)
{
  using Repeat = SectionRows::Repeat;
  const SectionRows head{"", Repeat::once, true, "what the file is", rows_of(head_rows())};
  const SectionRows steel{"steel", Repeat::once, false, "material of every solid", rows_of(steel_rows())};
  const SectionRows dynamics{"dynamics", Repeat::once, false, "runs of the lumped model",
                             rows_of(kind == "lumped" ? chain_dynamics_rows() : dynamics_rows())};
  const SectionRows pass{"pass", Repeat::list, kind == "four-high",
                         "one pass: its rolling force and what is known of it", rows_of(pass_rows())};
  const std::vector<Row> &published_rows = given_rows(kind, true);
  const SectionRows strip{"strip", Repeat::once, true, "the strip in the bite", rows_of(strip_rows())};
  const SectionRows flow_stress{"strip.flow_stress", Repeat::once, true, "plane-strain flow stress of the strip",
                                rows_of(flow_stress_rows())};
  const SectionRows friction{"strip.friction", Repeat::once, false,
                             "friction between roll and strip, where it is no number", rows_of(friction_rows())};
  const SectionRows bite{"bite", Repeat::once, false, "how the roll bite is computed", rows_of(bite_rows())};
  const SectionRows given{"given", Repeat::once, kind == "lumped",
                          "values that replace computed ones, each a quantity or { value, source, ... }; "
                          "KEY_tolerance beside one says "
                          "how far it may be off",
                          with_tolerances(given_rows(kind))};
  if (kind == "two-cylinders")
    return {
        head,
        steel,
        {"upper",        Repeat::once, true, "the upper cylinder", rows_of(upper_cylinder_rows())},
        {"lower",        Repeat::once, true, "the lower cylinder", rows_of(lower_cylinder_rows())},
        {"contact.line", Repeat::once, true, "their contact",      rows_of(line_contact_rows())  }
    };
  if (kind == "lumped")
    return {head, given, pass, dynamics};
  if (kind == "bearing")
    return {
        head,
        {"bearing",   Repeat::named, true,  "a roller bearing and its chock",                   rows_of(bearing_rows())      },
        {"load",      Repeat::once,  true,  "what acts on one of them",                         rows_of(bearing_load_rows()) },
        {"model",     Repeat::once,  false, "how that one is computed",                         rows_of(bearing_model_rows())},
        {"dynamics",  Repeat::once,  false, "a mass that swings on the bearing's curve",
          rows_of(bearing_motion_rows())                                                                                      },
        {"published", Repeat::once,  false,
          "published or measured values to stand beside the computed ones; nothing is replaced", given_rows(kind)             }
    };
  if (kind == "bite")
    return {
        head,
        steel,
        {"work_roll", Repeat::once, true,  "both work rolls",                                   rows_of(bite_roll_rows())},
        strip,
        flow_stress,
        friction,
        {"pass",      Repeat::list, true,  "one pass, where it differs from the strip",         rows_of(bite_pass_rows())},
        bite,
        {"published", Repeat::once, false,
          "published or measured values to stand beside the computed ones; nothing is replaced", given_rows(kind)         }
    };
  if (kind == "chatter")
    return chatter_sections(head);
  return {
      head,
      steel,
      {"work_roll",     Repeat::once,  true,  "both work rolls",                                   rows_of(work_roll_rows())             },
      {"backup_roll",   Repeat::once,  true,  "both backup rolls",                                 rows_of(backup_roll_rows())           },
      {"bearing",       Repeat::named, true,  "a roller bearing, named by the rolls",              rows_of(bearing_rows())               },
      {"frame",         Repeat::once,  true,
        "masses already reduced to the moving point; stiffnesses of the whole stand, both sides together; what a "
       "drawing in [housing] or [screwdown] replaces may be left out, and KEY_tolerance beside a value says how "
       "far it "
       "may be off",                                                                                with_tolerances(rows_of(frame_rows()))},
      {"housing",       Repeat::once,  false,
        "mill housing of each side as drawn, a closed window frame; replaces masses and stiffnesses of posts and "
       "beams",                                                                                     rows_of(housing_rows())               },
      {"screwdown",     Repeat::once,  false,
        "screw-down of each side as drawn; each part replaces a stiffness of the frame",            rows_of(screwdown_rows())             },
      strip,
      flow_stress,
      friction,
      pass,
      {"contact.upper", Repeat::once,  false, "contact of the upper rolls, K3",                    rows_of(roll_contact_rows())          },
      {"contact.lower", Repeat::once,  false, "contact of the lower rolls, K5",                    rows_of(roll_contact_rows())          },
      bite,
      dynamics,
      {"stand",         Repeat::once,  false, "the strip around the stand, for millstand chatter",
        rows_of(stand_span_rows())                                                                                                        },
      {"analysis",      Repeat::once,  false, "how chatter is searched",                           rows_of(chatter_analysis_rows())      },
      given,
      {"published",     Repeat::once,  false,
        "published or measured values to stand beside the computed ones; nothing is replaced",      published_rows                        }
  };
}
}  // namespace mill
