#include "app/stages/bearing/bearing_store.h"
#include "app/stages/bite/bite_roll_stage.h"
#include "app/stages/bite/bite_stage.h"
#include "app/stages/bite/strip_flow_stage.h"
#include "app/stages/contact/contact_stage.h"
#include "app/stages/contact/contact_store.h"
#include "app/stages/contact/fourier_stage.h"
#include "app/stages/stand/stand_components.h"
#include "app/trace/closed_form_parts.h"
#include "core/base/files.h"
#include "core/case/provenance.h"
#include "core/records/record_text.h"
#include "reduce/bite/members.h"
#include "reduce/chain/line_contact.h"
#include "tests/support/changed_rows.h"
#include "tests/support/film_pass.h"
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <unistd.h>

// The key of a cache entry is a text of everything it depends on.  Every row of every section is changed, and
// the text of each kept stage must follow, unless the row stands in the list of those that the stage does not see.
namespace {
using namespace mill;
using Texts = std::map<std::string, std::string>;  // of the inputs, by stage

std::string text_of_pair(const PlannedPair &plan, const Material &steel)
{
  std::string text;
  for (const PlannedRoll *roll : {&plan.backup, &plan.work})
    for (const bool companion : {false, true})
      text += roll_inputs(roll->geometry, roll->size, steel, plan.wanted, companion);
  return text;
}

void add_contact(Texts &texts, const FourHigh &stand, const std::string &name, const ContactSettings &settings)
{
  std::vector<double> loads;
  for (const Pass &pass : stand.passes)
    loads.push_back(pass.load);
  const auto range       = swept_range(name, settings, loads);
  const PlannedPair plan = planned_rolls(stand, settings, range[1], first_reach);
  texts["rolls"] += text_of_pair(plan, stand.steel);
  fem::FourierOptions options;
  options.half_width = range[1];  // whatever it is made of, the largest load is in it
  options.both_sides = plan.wanted.both_sides;
  for (const PlannedRoll *roll : {&plan.backup, &plan.work})
    texts["Fourier solver"] += fourier_inputs(roll->geometry, stand.steel, options, {});
  texts["contacts"] += contact_inputs(stand, name, settings, loads);
}

Texts texts_of(const FourHigh &stand)
{
  Texts texts;
  add_contact(texts, stand, "upper", stand.upper_contact);
  add_contact(texts, stand, "lower", stand.lower_contact);
  for (const Pass &pass : stand.passes) {
    for (const auto &[roll, share] : {std::pair(&stand.work_roll, 0.05), std::pair(&stand.backup_roll, 0.5)}) {
      const auto &bearing = bearing_of(stand.bearings, roll->bearing);
      const double load   = std::isnan(roll->bearing_load) ? share * pass.load : roll->bearing_load;
      texts["rollers"] += roller_inputs(bearing, bearing::roller_load_bound(bearing, load, 0));
      texts["rings"] += ring_inputs(bearing);
      BearingQuestion question;
      question.bearing = bearing;
      question.radial  = load;
      texts["bearings"] += bearing_inputs_text(question, bearing::largest_roller_load(question.bearing, question));
    }
    BiteQuestion section;
    section.bite  = bite_of(stand.strip, pass, stand.work_roll.barrel_diameter, stand.steel);
    section.setup = stand.bite;
    section.backup_half_width =
        reduce::line_contact({stand.work_roll.barrel_diameter, stand.backup_roll.barrel_diameter,
                              std::min(stand.work_roll.barrel_length, stand.backup_roll.barrel_length),
                              stand.steel},
                             pass.load)
            .half_width;
    texts["bite sections"] += section_inputs(section);
    const FlowQuestion q{bite_of(stand.strip, pass, stand.work_roll.barrel_diameter, stand.steel), stand.bite, ""};
    texts["bite"] += flow_inputs(q, nullptr);
  }
  for (const bool coarse : {false, true}) {
    for (const Roll *roll : {&stand.work_roll, &stand.backup_roll})
      texts["components of the rolls"] += roll_component_inputs(*roll, stand, coarse);
    texts["component of the housing"] += housing_component_inputs(stand, coarse);
  }
  return texts;
}

Texts texts_of(const TwoCylinders &pair)
{
  Texts texts;
  for (const RoundBody *body : {&pair.upper, &pair.lower}) {
    if (body->plane() || body->rigid || pair.in_space)
      continue;
    const PlannedRoll plan = planned_cylinder(pair, body->diameter);
    for (const bool companion : {false, true})
      texts["rolls"] +=
          roll_inputs(plan.geometry, plan.size, material_of(*body, pair.steel), {true, false, false}, companion);
  }
  return texts;
}

Texts texts_of(const BearingCase &spec)
{
  BearingQuestion q = question_of(spec);
  q.cage_angle      = 0;
  q.loads           = {spec.load.loads[0], spec.load.loads[1]};
  return {{"rollers", roller_inputs(q.bearing, bearing::largest_roller_load(q.bearing, q))},
          {"rings", ring_inputs(q.bearing)},
          {"bearings", bearing_inputs_text(q, bearing::largest_roller_load(q.bearing, q))}};
}

Texts texts_of(const BiteCase &spec)
{
  Texts texts;
  for (const Pass &pass : spec.passes) {
    const FlowQuestion q{bite_of(spec.strip, pass, spec.roll_diameter, spec.steel), spec.bite, ""};
    texts["bite"] += flow_inputs(q, nullptr);
  }
  return texts;
}

// Nothing of these is kept.
Texts texts_of(const Lumped &)
{
  return {};
}
Texts texts_of(const ChatterCase &)
{
  return {};
}
// Its computed contacts are rolls in plane strain, kept as those of two cylinders.
Texts texts_of(const ClusterCase &)
{
  return {};
}
// Nothing of it is kept: it takes a second.
Texts texts_of(const StackCase &)
{
  return {};
}

Texts texts_of(const Case &the_case)
{
  return std::visit([](const auto &spec) { return texts_of(spec); }, the_case.spec);
}

using Patterns = std::map<std::string, std::vector<std::string>>;  // by stage

// Changes each row of the case and compares the stages that followed with those whose list does not have it.
// @param unseen  rows that a stage does not see
void expect_followed(const BaseCase &base, const Patterns &unseen)
{
  const Case the_case = read(base);
  const Texts before  = texts_of(the_case);
  for (const TraceKey &key : keys_of(the_case)) {
    const auto others = changed(base, the_case, key.name);
    for (const auto &[stage, text] : before) {
      const bool blind = fits_any(unseen.at(stage), key.name);
      bool followed    = false;
      for (const Case &other : others)
        followed = followed || texts_of(other).at(stage) != text;
      if (others.empty())
        EXPECT_TRUE(blind) << key.name << " took no other value, so it is not known whether " << stage
                           << " see it";
      else
        EXPECT_EQ(followed, !blind) << key.name << (followed ? " enters " : " does not enter ") << "what the "
                                    << stage << " are kept under";
    }
  }
}

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string> &b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Rows of one section.
std::vector<std::string> of(const std::string &section, const std::string &rows)
{
  return keys_in(section, rows);
}

const std::vector<std::string> head{"schema",       "kind",     "title",  "confirmed", "bearing.another.*",
                                    "monitoring.*", "advice.*", "plant.*"};
// Of a pass what is neither its load nor a number of the bite.  What was measured moves the strip, where a fit is
// asked, and the strip is seen.
const std::vector<std::string> records =
    of("pass.#", "name force measured synthetic published_peak measured_peak synthetic_range synthetic_duration "
                 "synthetic_seed synthetic_bandwidth forward_slip torque force_deviation slip_deviation "
                 "torque_deviation");
const std::vector<std::string> pass_of_strip =
    of("pass.#", "entry_thickness exit_thickness entry_tension exit_tension speed");
const std::vector<std::string> after_the_springs{"dynamics.*",  "stand.*",    "analysis.*",           "given.*",
                                                 "published.*", "campbell.*", "frequency_response.*", "drive.*"};
const std::vector<std::string> frame{"frame.*", "housing.*", "screwdown.*"};
// Ground and thermal profile are the right-hand side of the contact, which is solved again in every run.
const std::string profile =
    " crown crown_table crown_polynomial thermal_crown thermal_crown_table end_chamfer_length "
    "end_chamfer_depth";
const std::string seat =
    " bearing bearing_mass bearing_load chock_mass_upper chock_mass_lower bending_model estimate";
const std::string no_inertia = "density yield_stress";

std::vector<std::string> not_seen_by_a_roll_mesh()
{
  auto keys = head + records + pass_of_strip + after_the_springs + frame + of("steel", no_inertia) +
              std::vector<std::string>{"bearing.*", "strip.*", "bite.*"} + of("work_roll", profile + seat) +
              of("backup_roll", profile + seat);
  // One force on both chocks, an angle or an offset alone leave both sides alike.
  keys = keys + of("work_roll", "bending_force");
  for (const char *contact : {"contact.upper", "contact.lower"})
    keys = keys + of(contact, "samples path_trim cross_angle axis_offset");
  return keys;
}

// Clearance, profile and slices belong to the equilibrium of all rollers, which is solved again.
const std::string equilibrium = " radial_clearance end_play preload profile crown_drop profile_load profile_share "
                                "profile_table yield_pressure slices rib_angle raceway_flow_stress";

// Inputs of the rating life, and a catalogue, which a drawn bearing does not use together with its sizes.
const std::string rated = " designation catalogue dynamic_rating static_rating viscosity_ratio contamination "
                          "raceway_flow_state";

// Of a profile that the case does not have: no other value is tried.
const std::string no_other_profile = "crown_drop profile_load profile_table";

std::vector<std::string> not_seen_by_a_bearing()
{
  return head + records + pass_of_strip + after_the_springs + frame +
         of("work_roll", "barrel_diameter barrel_length neck_diameter total_length bearing_span axial_shift "
                         "bending_force bearing_mass chock_mass_upper chock_mass_lower estimate" +
                             profile) +
         of("backup_roll", "barrel_diameter barrel_length neck_diameter neck_length bearing_span bearing_mass "
                           "chock_mass_upper chock_mass_lower bending_model estimate" +
                               profile) +
         std::vector<std::string>{"steel.*",   "strip.*",       "bite.*",
                                  "contact.*", "bearing.crb.*", "bearing.trb.type"};
}

// Every constant of every law, so that each law may take the place of the other.
const std::string every_friction = "strip.friction={law = \"coulomb\", coefficient = 0.1, entry_factor = 0.1, "
                                   "exit_factor = 0.12, at_unit_speed = "
                                   "0.067, mu0 = 0.012, mu1 = 0.142, decay = \"2.43 1/um\", viscosity = \"0.005 "
                                   "Pa s\", pressure_viscosity = \"2e-8 "
                                   "1/Pa\"}";
std::string every_flow_stress(const std::string &k)
{
  return "strip.flow_stress={law = \"constant\", k = \"" + k + "\", eps0 = 0.9, n = 0.2, k0 = \"" + k +
         "\", table = [[0.0, \"" + k + "\"], [1.0, \"1200 MPa\"]]}";
}

// A stand with a drawn frame, its forces as numbers, without swept ranges: those follow from the loads.
BaseCase drawn_stand()
{
  std::string text   = read_text("cases/four-high-drawn.toml");
  const auto replace = [&](const std::string &from, const std::string &to) {
    for (auto position = text.find(from); position != std::string::npos;
         position      = text.find(from, position + to.size()))
      text.replace(position, from.size(), to);
  };
  replace("force          = \"data/pass-1.csv\"", "load = \"976 kN\"\nspeed = \"2 m/s\"");
  replace("force          = \"data/pass-2.csv\"", "load = \"975 kN\"\nspeed = \"2 m/s\"");
  replace("loads = [\"100 kN\", \"2000 kN\"]", "");
  replace("crown            = \"0 um\"", "");  // a table may stand instead
  // That of the work rolls goes on no neck of a backup roll; this one does.
  text += "\n[bearing.another]\ntype = \"four-row cylindrical\"\nrows = 4\nrollers_per_row = 31\nroller_length = "
          "\"100 mm\"\n"
          "roller_diameter = \"70 mm\"\nbore = \"950 mm\"\noutside_diameter = \"1200 mm\"\nwidth = \"600 mm\"\n";
  const std::string file = testing::TempDir() + "cache-keys-" + std::to_string(getpid()) + ".toml";
  write_atomically(file, text);
  return {file,
          {"bearing.trb.roller_total_length=34 mm", "bearing.crb.bore=960 mm",
           "bearing.crb.outside_diameter=1200 mm", "work_roll.end_chamfer_length=50 mm",
           "backup_roll.end_chamfer_length=50 mm", "bite.arc=elastic", every_friction,
           every_flow_stress("28 MPa")}};
}

// Keys that do not belong to a roller and its raceways.  Loads enter in steps of a factor of two, so that
// neighbouring cases share a mesh; the raceway goes on by a tenth of the roller's length while there is room
// between the rows.
const std::string beside_a_roller =
    "rollers_per_row width arrangement roller_cone_angle cup_angle rings chock chock_width "
    "chock_height chock_length chock_support_width chock_support_gap" +
    equilibrium + rated;
const std::string beside_the_rings = "rollers_per_row roller_total_length roller_law" + equilibrium + rated;
}  // namespace

TEST(CacheKeys, EveryRowOfAFourHighEntersOrIsListedAsNotEntering)
{
  const BaseCase base  = drawn_stand();
  const auto roll_mesh = not_seen_by_a_roll_mesh();
  // Solved contacts are kept with the whole rolls, solved bearings with the whole bearing, under their loads; so
  // are the fields of a contact and the readings of a bearing, under the same texts.
  const auto contacts = head + records + pass_of_strip + after_the_springs + frame + of("steel", no_inertia) +
                        of("work_roll", seat) + of("backup_roll", seat) +
                        of("strip", "youngs_modulus poisson_ratio") +
                        std::vector<std::string>{"bearing.*", "bite.*", "strip.f*", "strip.initial*", "strip.e*"};
  const auto bearings =
      head + records + pass_of_strip + after_the_springs + frame +
      of("work_roll", "barrel_diameter barrel_length neck_diameter total_length bearing_span axial_shift "
                      "bending_force bearing_mass chock_mass_upper chock_mass_lower estimate" +
                          profile) +
      of("backup_roll", "barrel_diameter barrel_length neck_diameter neck_length bearing_span bearing_mass "
                        "chock_mass_upper chock_mass_lower bending_model estimate" +
                            profile) +
      std::vector<std::string>{"steel.*", "strip.*", "bite.*", "contact.*"} +
      of("bearing.trb", "type " + no_other_profile + rated) +
      of("bearing.crb",
         "type pitch_diameter width roller_total_length roller_cone_angle cup_angle end_play preload "
         "rings " +
             no_other_profile + rated);
  const auto sections =
      head + records + after_the_springs + frame + of("pass.#", "entry_tension exit_tension speed") +
      of("steel", no_inertia) + std::vector<std::string>{"bearing.*", "contact.*"} +
      of("backup_roll", "neck_diameter neck_length bearing_span" + profile + seat) +
      of("strip", "width initial_thickness entry_tension exit_tension youngs_modulus poisson_ratio") +
      std::vector<std::string>{"strip.f*"} +
      of("bite", "method theory samples path_trim arc mesh elements_along elements_through fit fit_for") +
      of("work_roll", "neck_diameter total_length bearing_span axial_shift bending_force" + profile + seat);
  const auto loads   = of("pass.#", "load") + of("work_roll", "bearing_load") + of("backup_roll", "bearing_load");
  const auto bearing = not_seen_by_a_bearing() + loads;
  const auto vibration =
      head + records + pass_of_strip + of("pass.#", "load") + of("steel", "yield_stress") +
      std::vector<std::string>{"bearing.*",   "strip.*",     "bite.*",     "contact.*",
                               "stand.*",     "frame.*",     "analysis.*", "given.*",
                               "published.*", "screwdown.*", "campbell.*", "frequency_response.*",
                               "drive.*"} +
      of("dynamics",
         "modal_damping force_meaning output_rate frame mass_reference mass_source model model_files contact");
  const auto second = roll_mesh + of("contact.upper", "elements_per_half_width friction") +
                      of("contact.lower", "elements_per_half_width friction");
  const auto bite =
      head + records + after_the_springs + frame + of("pass.#", "load") + of("steel", no_inertia) +
      std::vector<std::string>{"bearing.*", "backup_roll.*", "contact.*"} +
      of("bite", "method theory samples path_trim fit fit_for") +
      of("work_roll",
         "barrel_length neck_diameter total_length bearing_span axial_shift bending_force" + profile + seat);
  const auto rolls = vibration + std::vector<std::string>{"housing.*"} +
                     of("work_roll", "axial_shift bending_force" + profile + seat) +
                     of("backup_roll", profile + seat);
  const auto housing = vibration + std::vector<std::string>{"work_roll.*", "backup_roll.*"} +
                       of("dynamics", "elements_per_radius") +
                       of("housing", "stiffness");  // stands in place of a drawing, which this case has
  expect_followed(base, {{"rolls", roll_mesh},
                         {"Fourier solver", second},
                         {"rollers", bearing + of("bearing.trb", beside_a_roller)},
                         {"rings", bearing + of("bearing.trb", beside_the_rings)},
                         {"bite", bite},
                         {"contacts", contacts},
                         {"bearings", bearings},
                         {"bite sections", sections},
                         {"components of the rolls", rolls},
                         {"component of the housing", housing}});
  std::filesystem::remove(base.file);
}

TEST(CacheKeys, EveryRowOfTheOtherKindsEntersOrIsListedAsNotEntering)
{
  // Rows of a contact in space are refused in plane strain; friction and the depth of a plane belong to half
  // planes, which are not kept; a cylinder with a diameter is not a plane.
  const std::string beside_the_mesh = " friction tangential_load plane_depth";
  const std::string of_a_face =
      "shape length crown_radius profile profile_length profile_drop profile_load profile_table";
  const auto in_space =
      std::vector<std::string>{"contact.space.*"} + of("upper", of_a_face) + of("lower", of_a_face);
  expect_followed({"cases/two-cylinders.toml", {}},
                  {{"rolls", head + of("steel", no_inertia) +
                                 of("contact.line", "length at samples" + beside_the_mesh) + in_space}});
  // Without a tangential load friction has no effect, and says so.
  expect_followed(
      {"cases/two-cylinders.toml", {"contact.line.friction=0.2", "contact.line.tangential_load=100 N/mm"}},
      {{"rolls",
        head + of("steel", no_inertia) + of("contact.line", "length at samples" + beside_the_mesh) + in_space}});
  // [model] says law and rings of the bearing again.
  const auto bearing =
      head + std::vector<std::string>{"dynamics.*", "published.*"} + of("bearing.trb", "type roller_law rings") +
      of("load",
         "bearing axial cage_angle samples radial loads axial_displacement moment speed tilt_across speeds") +
      of("model", "slices");
  expect_followed(
      {"cases/bearing-266.toml", {"bearing.trb.roller_total_length=34 mm"}},
      {{"rollers", bearing + of("bearing.trb", beside_a_roller) + of("model", "rings")},
       {"rings", bearing + of("bearing.trb", beside_the_rings) + of("model", "roller_law") + of("load", "tilt")},
       {"bearings", head + std::vector<std::string>{"dynamics.*", "published.*"} +
                        of("load", "bearing cage_angle samples tilt_across speeds") +
                        of("bearing.trb", "type roller_law rings slices " + no_other_profile + rated)}});
  const auto bite = head + records + of("pass.#", "load") + of("steel", no_inertia) +
                    std::vector<std::string>{"published.*"} +
                    of("bite", "method theory samples path_trim fit fit_for");
  expect_followed({"cases/cold-strip.toml", {every_friction, every_flow_stress("1180 MPa")}}, {{"bite", bite}});
}

TEST(CacheKeys, AChangedOilIsAnotherBite)
{
  FlowQuestion q{film_pass(), {}, "pass"};
  const std::string before = flow_inputs(q, nullptr);
  for (double Friction::*member : {&Friction::mu0, &Friction::mu1, &Friction::decay, &Friction::viscosity,
                                   &Friction::pressure_viscosity, &Friction::film_factor}) {
    FlowQuestion other = q;
    other.bite.strip.friction.*member *= 1.01;
    EXPECT_NE(flow_inputs(other, nullptr), before);
  }
  bite::ArcFlexibility section{Eigen::VectorXd::LinSpaced(3, 0, 1), Eigen::MatrixXd::Identity(3, 3), ""};
  const std::string shaped = flow_inputs(q, &section);
  EXPECT_NE(shaped, before);
  section.influence(2, 1) = 1e-20;
  EXPECT_NE(flow_inputs(q, &section), shaped);
}
