#include "core/case/given_instead.h"
#include "core/case/kinds.h"
#include "core/case/stand_reader.h"
#include "core/case/stand_sections.h"
#include <algorithm>
#include <fmt/format.h>

namespace mill {
namespace {
using Names = std::set<std::string>;

WorkRollInput read_work_roll(const Node &root, const Names &given, Reading &reading)
{
  WorkRollInput roll;
  const Section section = section_at(root, "work_roll", reading);
  read_and_echo(section, section.header(), beside_given("work_roll", work_roll_rows(), given, roll), roll, reading);
  roll.neck_length = (roll.total_length - roll.barrel_length) / 2;
  check_work_roll(roll, reading);
  return roll;
}

Roll read_backup_roll(const Node &root, const Names &given, Reading &reading)
{
  Roll roll;
  const Section section = section_at(root, "backup_roll", reading);
  read_and_echo(section, section.header(), beside_given("backup_roll", backup_roll_rows(), given, roll), roll,
                reading);
  check_backup_roll(roll, reading);
  return roll;
}

ContactSettings read_roll_contact(const Node &root, const std::string &name, Reading &reading)
{
  ContactSettings contact;
  const Section section = section_at(root, name, reading);
  read_and_echo(section, section.header(), roll_contact_rows(), contact, reading);
  contact.loads_place    = reading.place(name + ".loads");
  contact.elements_place = reading.place(name + ".elements_per_half_width");
  check_contact(name, contact, reading);
  return contact;
}
}  // namespace

namespace {
// Both backup-roll bearings together are given and neither of them is drawn: each is half of them.
void share_given_bearings(FourHigh &stand)
{
  const auto both = stand.given.find("K_Zy");
  if (!stand.backup_roll.bearing.empty() || both == stand.given.end())
    return;
  GivenValue half = both->second;
  half.parameter.value /= 2;
  half.parameter.method = "half of given.K_Zy";
  for (const char *one : {"Kzc1", "Kzc4"})
    stand.given.emplace(one, half);
}
}  // namespace

FourHigh read_four_high(const Node &root, Reading &reading)
{
  FourHigh stand;
  const Names given   = given_names(root);
  const Section steel = section_at(root, "steel", reading);
  read_and_echo(steel, steel.header(), steel_rows(), stand.steel, reading);
  stand.work_roll   = read_work_roll(root, given, reading);
  stand.backup_roll = read_backup_roll(root, given, reading);
  stand.bearings    = read_bearings(root, stand.backup_roll.bearing, reading);
  stand.oil_films   = read_oil_films(root, reading);
  stand.housing     = read_housing(root, stand.steel, reading);
  stand.screwdown   = read_screwdown(root, reading);
  const bool drawn  = section_at(root, "housing", reading).node != nullptr;
  const auto backup = std::find_if(stand.bearings.begin(), stand.bearings.end(),
                                   [&](const RollerBearing &b) { return b.name == stand.backup_roll.bearing; });
  const bool known  = backup != stand.bearings.end();
  stand.frame = read_frame(root, frame_keys_behind(drawn, stand.screwdown, known ? &*backup : nullptr), given, reading);
  if (known)
    drop_counted_chocks(stand.frame, *backup, reading);
  stand.strip  = read_strip(root, reading, given);
  stand.passes = read_passes(root, pass_rows(), reading);
  check_passes(stand.passes, reading);
  if (const Section contact = section_at(root, "contact", reading); contact.node)
    refuse_unknown_keys(contact, {}, {"upper", "lower"}, reading);
  stand.upper_contact = read_roll_contact(root, "contact.upper", reading);
  stand.lower_contact = read_roll_contact(root, "contact.lower", reading);
  stand.bite          = read_bite_setup(root, reading);
  stand.dynamics      = read_dynamics(root, dynamics_rows(), reading);
  stand.span          = read_stand_span(root, reading);
  stand.analysis      = read_chatter_analysis(root, reading);
  stand.given         = read_given(root, "given", "four-high", reading);
  stand.published     = read_given(root, "published", "four-high", reading);
  share_given_bearings(stand);
  check_four_high(stand, reading);
  return stand;
}

namespace {
using Repeat = SectionRows::Repeat;

std::vector<SectionRows> four_high_sections()
{
  std::vector<SectionRows> all{
      head_section(),
      steel_section(),
      {"work_roll",   Repeat::once,  true,  "both work rolls",                          rows_of(work_roll_rows())             },
      {"backup_roll", Repeat::once,  true,  "both backup rolls",                        rows_of(backup_roll_rows())           },
      {"bearing",     Repeat::named, true,  "a roller bearing, named by the rolls",     rows_of(bearing_rows())               },
      oil_film_section(),
      {"frame",       Repeat::once,  true,
          "masses already reduced to the moving point; stiffnesses of the whole stand, both sides together; what a "
       "drawing in [housing] or [screwdown] replaces may be left out, and KEY_tolerance beside a value says how "
       "far it "
       "may be off",                                                                       with_tolerances(rows_of(frame_rows()))},
      {"housing",     Repeat::once,  false,
          "mill housing of each side as drawn, a closed window frame; replaces masses and stiffnesses of posts and "
       "beams",                                                                            rows_of(housing_rows())               },
      {"screwdown",   Repeat::once,  false,
          "screw-down of each side as drawn; each part replaces a stiffness of the frame", rows_of(screwdown_rows())             }
  };
  for (const SectionRows &section : strip_sections())
    all.push_back(section);
  const SectionRows rest[] = {
      pass_section(true),
      {"contact.upper", Repeat::once, false, "contact of the upper rolls, K3",                    rows_of(roll_contact_rows())    },
      {"contact.lower", Repeat::once, false, "contact of the lower rolls, K5",                    rows_of(roll_contact_rows())    },
      bite_section(),
      dynamics_section(dynamics_rows()),
      {"stand",         Repeat::once, false, "the strip around the stand, for millstand chatter",
              rows_of(stand_span_rows())                                                                                                 },
      {"analysis",      Repeat::once, false, "how chatter is searched",                           rows_of(chatter_analysis_rows())},
      given_section(stand_given_rows(), false),
      published_section(stand_published_rows())
  };
  all.insert(all.end(), std::begin(rest), std::end(rest));
  return all;
}

std::vector<TemplateNote> four_high_notes()
{
  return {
      {"bearing",
       "[bearing.trb]",                     {},
       {"bore", "outside_diameter", "width", "roller_diameter", "roller_cone_angle", "cup_angle", "profile"}                    },
      {"bearing",
       "[bearing.crb]",                     {{"type", "\"four-row cylindrical\""},
        {"rollers_per_row", "32"},
        {"roller_length", "\"110 mm\""},
        {"roller_diameter", "\"75 mm\""}},
       {}                                                                                                                       },
      {"oil-film", "[bearing.oil]",         {},                                               {},                                 true}, // the backup rolls run on rollers
      {"housing",          "",                         {},                                                              {},                                                                      true}, // [frame] says it in numbers
      {"screwdown",      "",                             {},                                                                   {},                         true},
      {"strip.flow_stress",        "",                           {},         {"k"}},
      {"strip.friction",        "",{},                                        {},                                                           true}, // [strip] says it in a number
      {"pass",        "",                              {{"synthetic", "true"}},                                   {"synthetic_range"}          },
      {"pass",
       "",{{"name", "\"pass 2\""},
        {"synthetic", "true"},
        {"synthetic_range", "[\"733.705 kN\", \"742.280 kN\"]"},
        {"synthetic_seed", "2"}},
       {}}
  };
}
}  // namespace

const CaseKind &case_kind(const FourHigh *)
{
  static const CaseKind kind = [] {
    CaseKind k;
    k.name      = "four-high";
    k.title     = "four-high stand";
    k.read      = [](const Node &root, Reading &reading) -> CaseSpec { return read_four_high(root, reading); };
    k.sections  = four_high_sections();
    k.notes     = four_high_notes();
    k.given     = stand_given_rows();
    k.published = stand_published_rows();
    k.repeated  = [](const CaseSpec &spec, const std::string &section) {
      const auto &own = std::get<FourHigh>(spec);
      if (section == "bearing")
        return names_in(own.bearings);
      if (section == "oil-film")
        return names_in(own.oil_films);
      return section == "pass" ? numbers_to(own.passes.size()) : std::vector<std::string>();
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
