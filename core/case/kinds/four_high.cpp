#include "core/case/advice_rows.h"
#include "core/case/estimates.h"
#include "core/case/given_instead.h"
#include "core/case/kinds.h"
#include "core/case/monitoring.h"
#include "core/case/plant.h"
#include "core/case/stand_reader.h"
#include "core/case/stand_sections.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using Names = std::set<std::string>;

// A roll with what of it may be given or estimated instead.
template <class T>
T read_roll(const Node &root, const std::string &name, const std::vector<Field<T>> &rows, const Names &given,
            EstimateInput &wish, Reading &reading)
{
  T roll;
  const Section section    = section_at(root, name, reading);
  const auto estimate_rows = roll_estimate_rows();
  wish                     = read_estimate(section, estimate_rows, reading);
  read_and_echo(section, section.header(),
                beside_estimate(name, beside_given(name, rows, given, roll), wish.estimate, roll), roll, reading,
                {estimate_rows.front().key});
  reading.echo += resolved_lines(name, estimate_rows, wish, reading);
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
// Keys of [frame] that a drawing replaces, and all that lies behind given values.
Names needless_keys(const std::vector<std::string> &of_frame, const Names &given)
{
  Names keys;
  for (const std::string &key : of_frame)
    keys.insert("frame." + key);
  for (const BehindGiven &one : behind_given())
    for (const std::string &key : one.keys)
      if (is_needless(one.section, key, given))
        keys.insert(one.section + "." + key);
  return keys;
}

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
  EstimateWishes wishes;
  WorkRollInput work_roll = read_roll(root, "work_roll", work_roll_rows(), given, wishes.work_roll, reading);
  work_roll.neck_length   = (work_roll.total_length - work_roll.barrel_length) / 2;
  stand.work_roll         = work_roll;
  stand.backup_roll       = read_roll(root, "backup_roll", backup_roll_rows(), given, wishes.backup_roll, reading);
  stand.bearings          = read_bearings(root, stand.backup_roll.bearing, reading);
  stand.oil_films         = read_oil_films(root, reading);
  stand.housing           = read_housing(root, stand.steel, reading);
  stand.screwdown         = read_screwdown(root, reading);
  const bool drawn  = section_at(root, "housing", reading).node != nullptr && std::isnan(stand.housing.stiffness);
  const auto backup = std::find_if(stand.bearings.begin(), stand.bearings.end(),
                                   [&](const RollerBearing &b) { return b.name == stand.backup_roll.bearing; });
  const bool known  = backup != stand.bearings.end();
  const auto replaced = frame_keys_behind(drawn, stand.screwdown, known ? &*backup : nullptr);
  stand.frame         = read_frame(root, replaced, given, wishes.frame, reading);
  if (known)
    drop_counted_chocks(stand.frame, *backup, reading);
  if (!std::isnan(stand.housing.stiffness) && !wishes.frame.estimate)
    contradict(reading, "housing.stiffness", "has no effect without frame.estimate = true", {});
  wishes.needless = needless_keys(replaced, given);
  estimate_stand(stand, wishes, reading);
  work_roll.total_length         = stand.work_roll.barrel_length + 2 * stand.work_roll.neck_length;
  static_cast<Roll &>(work_roll) = stand.work_roll;
  check_work_roll(work_roll, reading);
  check_backup_roll(stand.backup_roll, reading);
  stand.strip  = read_strip(root, reading, &given);
  stand.passes = read_passes(root, pass_rows(), reading);
  check_passes(stand.passes, reading);
  if (const Section contact = section_at(root, "contact", reading); contact.node)
    refuse_unknown_keys(contact, {}, {"upper", "lower"}, reading);
  stand.upper_contact      = read_roll_contact(root, "contact.upper", reading);
  stand.lower_contact      = read_roll_contact(root, "contact.lower", reading);
  stand.bite               = read_bite_setup(root, reading);
  stand.dynamics           = read_dynamics(root, dynamics_rows(), reading);
  stand.frequency_response = read_frequency_response(root, reading);
  stand.campbell           = read_campbell(root, campbell_rows(), reading);
  stand.drive              = read_drive_orders(root, reading);
  stand.span               = read_stand_span(root, reading);
  read_plant(root, reading);
  read_monitoring(root, reading);  // checked here, used by those who read records
  stand.analysis  = read_chatter_analysis(root, reading);
  stand.advice    = read_four_high_advice(root, reading);
  stand.given     = read_given(root, "given", "four-high", reading);
  stand.published = read_given(root, "published", "four-high", reading);
  share_given_bearings(stand);
  check_four_high(stand, reading);
  reading.echo += estimate_lines(stand.estimates);
  return stand;
}

namespace {
using Repeat = SectionRows::Repeat;

std::vector<Row> with_rows(std::vector<Row> rows, const std::vector<Row> &more)
{
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

std::vector<SectionRows> four_high_sections()
{
  std::vector<SectionRows> all{
      head_section(),
      steel_section(),
      {"work_roll", Repeat::once, true, "both work rolls",
       with_rows(rows_of(work_roll_rows()), rows_of(roll_estimate_rows()))},
      {"backup_roll", Repeat::once, true, "both backup rolls",
       with_rows(rows_of(backup_roll_rows()), rows_of(roll_estimate_rows()))},
      {"bearing", Repeat::named, false,
       "a roller bearing, named by the rolls; rolls whose Kzc are given need none", rows_of(bearing_rows())},
      oil_film_section(),
      {"frame", Repeat::once, false,
       "masses already reduced to the moving point; stiffnesses of the whole stand, both sides together; what a "
       "drawing in [housing] or [screwdown] replaces, what K1, K2, K6, K7, M1, M2 and M6 of [given] stand for and "
       "what "
       "estimate = true finds may be left out, and KEY_tolerance states the uncertainty of a value",
       with_rows(with_tolerances(rows_of(frame_rows())), rows_of(estimate_rows()))},
      {"housing", Repeat::once, false,
       "mill housing of each side as drawn, a closed window frame; replaces masses and stiffnesses of posts and "
       "beams",
       rows_of(housing_rows())},
      {"screwdown", Repeat::once, false,
       "screw-down of each side as drawn; each part replaces a stiffness of the frame",
       rows_of(screwdown_rows())}};
  for (const SectionRows &section : strip_sections())
    all.push_back(section);
  const SectionRows rest[] = {
      pass_section(true),
      {"contact.upper", Repeat::once, false, "contact of the upper rolls, K3", rows_of(roll_contact_rows())},
      {"contact.lower", Repeat::once, false, "contact of the lower rolls, K5", rows_of(roll_contact_rows())},
      bite_section(),
      dynamics_section(dynamics_rows()),
      frequency_response_section(),
      campbell_section(campbell_rows()),
      drive_order_section(),
      {"stand", Repeat::once, false, "the strip around the stand, for millstand chatter",
       rows_of(stand_span_rows())},
      {"analysis", Repeat::once, false, "how chatter is searched", rows_of(chatter_analysis_rows())},
      monitoring_section(),
      ball_bearing_section(),
      plant_section(),
      given_section(stand_given_rows(), false),
      published_section(stand_published_rows())};
  all.insert(all.end(), std::begin(rest), std::end(rest));
  for (const SectionRows &section : four_high_advice_sections())
    all.push_back(section);
  return all;
}

std::vector<TemplateNote> four_high_notes()
{
  return {{"bearing",
           "[bearing.trb]",
           {},
           {"bore", "outside_diameter", "width", "rows", "roller_diameter", "roller_cone_angle", "cup_angle",
            "profile"}},
          {"bearing",
           "[bearing.crb]",
           {{"type", "\"four-row cylindrical\""},
            {"rollers_per_row", "32"},
            {"roller_length", "\"110 mm\""},
            {"roller_diameter", "\"75 mm\""}},
           {}},
          {"oil-film", "[bearing.oil]", {}, {}, true},  // the backup rolls run on rollers
          {"housing", "", {}, {}, true},                // [frame] says it in numbers
          {"screwdown", "", {}, {}, true},
          {"strip.flow_stress", "", {}, {"k"}},
          {"strip.friction", "", {}, {}, true},  // [strip] says it in a number
          drive_order_note(),
          monitoring_note(),
          ball_bearing_note(),
          plant_note(),
          {"work_roll", "", {{"estimate", "true"}}, {}},
          {"backup_roll", "", {{"estimate", "true"}}, {}},
          {"frame", "", {{"estimate", "true"}, {"modulus", "\"1.95 MN/mm\""}}, {"modulus"}},  // of the demo stand
          {"pass", "", {{"synthetic", "true"}}, {"synthetic_range"}}};
}

// In the order of a roll drawing, a bearing catalogue, the general arrangement and a pass schedule.
std::vector<DrawingValue> four_high_drawing()
{
  return {
      {"work_roll", "barrel_diameter", "roll drawing: diameter of the barrel, as ground at present"},
      {"work_roll", "barrel_length", "roll drawing: length of the barrel, without chamfers"},
      {"work_roll", "neck_diameter", "roll drawing: diameter of the seat of the bearing"},
      {"work_roll", "total_length", "roll drawing: overall length"},
      {"work_roll", "bearing_span", "general arrangement of the roll set: between the centres of both bearings"},
      {"work_roll", "bearing", "a name of your own for a section [bearing.NAME] below"},
      {"backup_roll", "barrel_diameter", "roll drawing: diameter of the barrel, as ground at present"},
      {"backup_roll", "barrel_length", "roll drawing: length of the barrel, without chamfers"},
      {"backup_roll", "neck_diameter", "roll drawing: diameter of the seat of the bearing"},
      {"backup_roll", "neck_length", "roll drawing: from the end of the barrel to the end of the roll"},
      {"backup_roll", "bearing_span", "general arrangement of the roll set: between the centres of both bearings"},
      {"backup_roll", "bearing", "a name of your own for a section [bearing.NAME] below"},
      {"bearing", "designation", "bearing list or catalogue; it makes all but the name needless"},
      {"bearing", "type", "bearing list or catalogue"},
      {"bearing", "bore", "bearing catalogue: d"},
      {"bearing", "outside_diameter", "bearing catalogue: D"},
      {"bearing", "width", "bearing catalogue: B or T, over all rows"},
      {"bearing", "rows", "bearing catalogue"},
      {"bearing", "rollers_per_row", "bearing drawing, or counted; estimated with a designation"},
      {"bearing", "roller_length", "bearing drawing: effective length; estimated with a designation"},
      {"bearing", "roller_diameter", "bearing drawing: mean diameter; estimated with a designation"},
      {"bearing", "roller_cone_angle", "bearing drawing: included angle of the roller"},
      {"bearing", "cup_angle", "bearing drawing: angle of the outer raceway"},
      {"frame", "modulus",
       "calibration of the screw-down: slope of force over screw position with touching rolls"},
      {"strip", "width", "pass schedule"},
      {"strip", "entry_thickness", "pass schedule"},
      {"strip", "exit_thickness", "pass schedule"},
      {"strip", "friction", "force model of the mill: cold 0.03 .. 0.1 with oil, hot 0.2 .. 0.35"},
      {"strip.flow_stress", "law", "force model of the mill"},
      {"strip.flow_stress", "k", "force model of the mill: plane strain, 1.15 times the yield stress"},
      {"pass", "name", "pass schedule"},
      {"pass", "load", "pass schedule or force meter: rolling force of both sides together"},
      {"pass", "force",
       "recorder of the force meters: a file of any format of records, its path from the folder of this file"},
      {"pass", "synthetic_range", "in place of a record: smallest and largest rolling force"},
  };
}
}  // namespace

const CaseKind &case_kind(const FourHigh *)
{
  static const CaseKind kind = [] {
    CaseKind k;
    k.name     = word_of(KindOfCase::four_high);
    k.title    = "four-high stand";
    k.read     = [](const Node &root, Reading &reading) -> CaseSpec { return read_four_high(root, reading); };
    k.sections = four_high_sections();
    k.notes    = four_high_notes();
    for (const TemplateNote &note : stand_advice_notes())
      k.notes.push_back(note);
    k.drawing   = four_high_drawing();
    k.given     = stand_given_rows();
    k.published = stand_published_rows();
    k.repeated  = [](const CaseSpec &spec, const std::string &section) {
      const auto &stand = std::get<FourHigh>(spec);
      if (section == "bearing")
        return names_in(stand.bearings);
      if (section == "oil-film")
        return names_in(stand.oil_films);
      if (section == "drive.order")
        return numbers_to(stand.drive.size());
      if (section == "advice.damper")
        return numbers_to(stand.advice.dampers.size());
      if (section == "advice.tuned_damper")
        return numbers_to(stand.advice.tuned.size());
      return section == "pass" ? numbers_to(stand.passes.size()) : std::vector<std::string>();
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
