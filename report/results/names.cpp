#include "report/results/names.h"
#include "core/records/contact_name.h"
#include "core/records/result_names.h"
#include "core/records/result_words.h"
#include "report/results/named_mode.h"
#include <algorithm>

namespace mill::report {
namespace {
struct Words {
  const char *name;
  const char *meaning;
};
const Words quantities[] = {
    {"K1", "ground to M1: upper frame, screw-down"},
    {"K2", "M1 to M2: oil column, cylinder, chock, bearing, roll"},
    {"K3", "upper backup roll on upper work roll"},
    {"K4", "bite, between the work rolls"},
    {"K5", "lower work roll on lower backup roll"},
    {"K6", "M5 to M6: roll, bearing, chock"},
    {"K7", "M6 to ground: lower frame"},
    {"C", "damper parallel to K4"},
    {"K_Zy", "two upper backup bearings, part of K2"},
    {"K_Zy_lower", "two lower backup bearings, part of K6"},
    {"K_ZW", "bending and shear of a backup roll"},
    {"M1", "upper frame and screw-down"},
    {"M2", "upper backup roll with bearings, chocks, cylinders"},
    {"M3", "upper work roll"},
    {"M4", "lower work roll"},
    {"M5", "lower backup roll with bearings, chocks"},
    {"M6", "lower frame, load cell"},
    {"Kzc", "the bearing at its load"},
    {"Kzc1", "one bearing of the upper backup roll"},
    {"Kzc2", "one bearing of the upper work roll"},
    {"Kzc3", "one bearing of the lower work roll"},
    {"Kzc4", "one bearing of the lower backup roll"},
    {"Kzc1_across", "one bearing of the upper backup roll, across its load"},
    {"Kzc2_across", "one bearing of the upper work roll, across its load"},
    {"Kzc3_across", "one bearing of the lower work roll, across its load"},
    {"Kzc4_across", "one bearing of the lower backup roll, across its load"},
    {"housing", "the bare housing on its feet"},
    {"stand", "the stand"},
    {"mode", "mode by name"},
    {"open", "open stand, without the strip between the work rolls"},
    {"gap_share", "share of the static compliance of the gap"},
    {"frf", "accelerance"},
    {"campbell", "resonance with what turns"},
    {"nonlinear", "contacts and bearings on their curves"},
};
const Words aspects[] = {
    {"tangent", "tangent dF/d\u03b4"},
    {"modulus", "mill modulus"},
    {"kiss", "work rolls touching, tangent"},
    {"kiss_secant", "work rolls touching, secant"},
    {"by_width", "change with the width of the strip"},
    {"K_ww", "contact of the two work rolls"},
    {"K_bend", "bending of both work rolls under the strip"},
    {"screw_sensitivity", "exit thickness per motion of the screw"},
    {"thickness_by", "exit thickness per"},
    {"force_by", "rolling force per"},
    {"screw", "motion of the screw"},
    {"eccentricity", "growth of a roll's radius"},
    {"entry_thickness", "entry thickness"},
    {"entry_tension", "back tension"},
    {"exit_tension", "front tension"},
    {"flow_stress", "factor on the flow stress"},
    {"roll_speed", "speed of the rolls"},
    {"secant", "secant F/\u03b4"},
    {"tangent_across", "tangent across the load"},
    {"axial", "axial tangent, other motions held"},
    {"tilting", "tangent against tilt in the plane of the load"},
    {"tilt", "tangent against tilt in the plane of the load"},
    {"displacement", "displacement of the inner ring"},
    {"closing_cup_angle", "cup angle that closes the apex condition"},
    {"heaviest_angle", "angle of the heaviest roller from the load line"},
    {"rib_max", "largest force on the rib"},
    {"rollers_times_Z5", "sum of one roller per row, times Z/5"},
    {"rollers_times_stribeck", "sum of one roller per row, times Z cos\u00b2\u03b1/4.085"},
    {"load_that_fits_tangent", "load at which the tangent takes the published value"},
    {"load_that_fits_secant", "load at which the secant takes the published value"},
    {"motion", "a mass on it"},
    {"frequency", "natural frequency along the load"},
    {"frequency_across", "natural frequency across the load"},
    {"peak_acceleration", "largest acceleration"},
    {"peak_force", "largest force of the bearing"},
    {"without_contact", "share of the time without contact"},
    {"spectrum_peak", "highest line of the spectrum"},
    {"bearing", "bearing"},
    {"film", "oil film"},
    {"attitude", "angle between load and narrowest gap"},
    {"minimum_film", "thinnest film"},
    {"power_loss", "power lost to friction"},
    {"friction_torque", "torque of the friction"},
    {"side_flow", "oil that leaves at both ends"},
    {"temperature", "temperature of the film"},
    {"outlet_temperature", "temperature of the oil that leaves"},
    {"viscosity", "viscosity at the film's temperature"},
    {"sommerfeld", "Sommerfeld number"},
    {"k_xx", "stiffness along the load"},
    {"k_xy", "stiffness, force along by motion across"},
    {"k_yx", "stiffness, force across by motion along"},
    {"k_yy", "stiffness across the load"},
    {"b_xx", "damping along the load"},
    {"b_xy", "damping, force along by motion across"},
    {"b_yx", "damping, force across by motion along"},
    {"b_yy", "damping across the load"},
    {"k_static", "slope of the load over the displacement at rest"},
    {"least_speed", "speed from which a film carries"},
    {"layer_stiffness", "stiffness of bush and sleeve"},
    {"series_stiffness", "film and layers in series"},
    {"tilting_stiffness", "moment per tilt"},
    {"C0", "basic static rating"},
    {"P", "equivalent dynamic load"},
    {"S0", "static safety"},
    {"L10", "basic rating life"},
    {"L10r", "reference rating life by slices"},
    {"L10mr", "modified reference rating life"},
    {"L10_time", "basic rating life at the speed"},
    {"L10r_time", "reference rating life at the speed"},
    {"L10mr_time", "modified reference rating life at the speed"},
    {"cage_speed", "speed of the cage"},
    {"centrifugal_force", "centrifugal force of a roller"},
    {"stiffness_spread", "spread of the stiffness over the estimated rollers"},
    {"in_stand_tangent", "tangent with the rolls held as in the stand"},
    {"in_stand_secant", "secant with the rolls held as in the stand"},
    {"path_plateau", "nodal value on the contact path"},
    {"plastic_slope", "plastic slope of the pass"},
    {"flattening", "elastic flattening of the rolls"},
    {"combined", "plastic slope and flattening in series"},
    {"roller_secant", "one roller, secant"},
    {"roller_tangent", "one roller, tangent"},
    {"roller_max", "most loaded roller"},
    {"loaded_rollers", "rollers that carry load"},
    {"level", "rms over that of the linear run"},
    {"least_force", "smallest force over that at rest"},
    {"scale_to_part", "multiple of the record at which a contact parts"},
    {"parting_force", "amplitude of a harmonic force that parts a contact"},
    {"parting_frequency", "frequency of that force"},
    {"bend", "change of a frequency until a contact parts"},
    {"half_width", "half width of the contact at mid-length"},
    {"peak_pressure", "largest contact pressure at mid-length"},
    {"approach", "approach of the two roll axes"},
    {"loaded_length", "length that carries"},
    {"line_load_ratio", "largest load per length over the mean"},
    {"edge_factor", "largest pressure over that at mid-length"},
    {"moment", "moment about mid-length"},
    {"stick_half_width", "half width of what sticks"},
    {"tangential_displacement", "tangential displacement"},
    {"tangential_stiffness", "tangential stiffness before any slip"},
    {"tangential_tangent", "tangential stiffness at the tangential load"},
    {"line_load", "load per length"},
    {"bite", "bite"},
    {"force", "roll force"},
    {"torque", "torque of one roll"},
    {"film_thickness", "mean oil film"},
    {"sticking_length", "part of the arc on which friction is at its limit"},
    {"friction_margin", "friction over the least that draws the strip in"},
    {"elastic_share", "elastic zones over the arc"},
    {"arc_over_thickness", "projected arc over mean thickness"},
    {"arc_length", "projected length of the arc"},
    {"forward_slip", "forward slip"},
    {"neutral_position", "where strip and roll run equally fast"},
    {"neutral_angle", "neutral angle"},
    {"entry_speed", "speed of the strip at the entry"},
    {"exit_speed", "speed of the strip at the exit"},
    {"exit_thickness", "thickness of the strip that leaves the stand"},
    {"smallest_thickness", "smallest thickness of the strip, under load"},
    {"entry_position", "where the contact begins"},
    {"exit_position", "where the contact ends"},
    {"flux_balance", "flow out against flow in"},
    {"force_balance", "horizontal forces on the strip"},
    {"power_balance", "power brought in against power dissipated"},
    {"force_by_entry_thickness", "force per entry thickness"},
    {"force_by_exit_thickness", "force per exit thickness"},
    {"force_by_entry_tension", "force per back tension"},
    {"force_by_exit_tension", "force per front tension"},
    {"force_by_friction", "force per coefficient of friction"},
    {"force_by_flow_stress", "force per unit factor on the flow stress"},
    {"force_by_roll_speed", "force per speed of the rolls"},
    {"fe", "finite elements"},
    {"karman", "K\u00e1rm\u00e1n's slab"},
    {"karman-rigid", "K\u00e1rm\u00e1n's slab, rigid roll"},
    {"karman-elastic-arc", "K\u00e1rm\u00e1n's slab, free arc"},
    {"orowan", "Orowan"},
    {"bland-ford", "Bland and Ford"},
    {"hu-ehmann", "Hu and Ehmann"},
    {"sims", "Sims"},
    {"friction", "friction in the bite"},
    {"flattened_radius", "radius of the flattened roll"},
    {"friction_low", "friction in the bite, low end"},
    {"friction_high", "friction in the bite, high end"},
    {"friction_factor", "factor on the friction"},
    {"friction_factor_low", "factor on the friction, low end"},
    {"friction_factor_high", "factor on the friction, high end"},
    {"flow_stress_factor", "factor on the flow stress"},
    {"flow_stress_factor_low", "factor on the flow stress, low end"},
    {"flow_stress_factor_high", "factor on the flow stress, high end"},
    {"correlation", "correlation of friction and flow stress"},
    {"misfit", "sum of squares over the deviations"},
    {"freedom", "measured values less unknowns"},
    {"worst_deviation", "deviation along the direction known worst"},
    {"worst_friction", "friction in the direction known worst"},
    {"worst_flow_stress", "flow stress in the direction known worst"},
    {"residual", "distance to a measured value, standard deviations"},
    {"slip", "forward slip"},
    {"peak_g", "largest acceleration"},
    {"rms_g", "rms acceleration"},
    {"upper_work_roll", "upper work roll"},
    {"lower_work_roll", "lower work roll"},
    {"upper_backup_roll", "upper backup roll"},
    {"lower_backup_roll", "lower backup roll"},
    {"upper_backup_chock", "upper backup-roll chock"},
    {"lower_backup_chock", "lower backup-roll chock"},
    {"upper_work_roll_chock", "upper work-roll chock"},
    {"lower_work_roll_chock", "lower work-roll chock"},
    {"peak", "largest magnitude"},
};

// "row2_share", without the number of the row.
const std::pair<std::string, std::string> of_rows[] = {{"row_share", "share of row "},
                                                       {"row_axial", "axial force of row "}};

// Words that mean something else in one family.
struct WordsOfFamily {
  const char *family;
  std::size_t least;  // place in the name from which on it is this word, not the name of a bearing or a pass
  const char *name, *meaning;
};
const WordsOfFamily of_one_family[] = {
    {curve::bearing.family, 2, "C", "basic dynamic rating"},  // alone it is the damper of the chain
    {curve::bearing.family, 2, "eccentricity", "eccentricity over the clearance"},
    {family::bite, 2, "peak_pressure", "largest pressure apart from the edge of the contact"},
    {family::frf, 1, "bite", "force in the bite"},
    {family::frf, 1, "frequency", "frequency of the largest magnitude"},
    {family::mode, 2, "frequency", "natural frequency"},
};

std::string words_of(const std::string &part)
{
  for (const Words &words : quantities)
    if (part == words.name)
      return words.meaning;
  for (const Words &words : aspects)
    if (part == words.name)
      return words.meaning;
  for (const auto &[name, meaning] : of_rows)
    if (part.size() == 10 && part.substr(0, 3) + part.substr(4) == name)
      return meaning + part.substr(3, 1);
  return "";
}

// "f1" -> "1": a natural frequency.  Empty when the name is something else.
std::string number_after(const std::string &prefix, const std::string &name)
{
  if (name.size() <= prefix.size() || name.compare(0, prefix.size(), prefix) != 0)
    return "";
  const std::string number = name.substr(prefix.size());
  return std::all_of(number.begin(), number.end(), [](const char c) { return c >= '0' && c <= '9'; }) ? number
                                                                                                      : "";
}

// "gap_first_kind" -> "gap first kind"
std::string words_of_crossing(std::string part)
{
  if (is_word(part, ResultWord::distance))
    return "distance from the working range";
  if (is_word(part, ResultWord::speed))
    return "speed of the rolls' surface";
  std::replace(part.begin(), part.end(), '_', ' ');
  return part;
}

void add(Group &group, const Result *result)
{
  if (result)
    group.results.push_back(result);
}
}  // namespace

bool ends_with(const std::string &name, const std::string &ending)
{
  return name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

std::string meaning_of(const std::string &name)
{
  if (const std::string words = chatter_meaning(name); !words.empty())
    return words;
  if (const std::string words = cluster_meaning(name); !words.empty())
    return words;
  if (const std::string words = stack_meaning(name); !words.empty())
    return words;
  if (const std::string words = marks_meaning(name); !words.empty())
    return words;
  if (const std::string number = number_after("fh", name); !number.empty())
    return "natural frequency " + number + ", horizontal";
  if (const std::string number = number_after("f", name); !number.empty())
    return "natural frequency " + number + ", vertical";
  std::string meaning;
  const auto parts = parts_of(name);
  if (parts.size() > 1 && parts[0] == family::open)
    return words_of(family::open) + ", " + meaning_of(name.substr(parts[0].size() + 1));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::string words = words_of(parts[i]);
    if (i == 1 && parts[0] == curve::bearing.family)
      words = parts[1];
    if (i == 0 && words.empty() && parts.size() > 1 && parts[0] != family::contact)
      words = parts[0];  // the name of a pass
    const bool of_fit = i > 0 && parts[0] == family::bite && parts[1] == bite_fit;
    if (parts[0] == family::nonlinear && (i == 1 || (words.empty() && !number_after("f", parts[i]).empty())))
      words = i == 1 ? parts[1] : "mode " + number_after("f", parts[i]);
    if (i == 1 && (parts[0] == family::bite || (parts[0] == family::stand && words.empty())))
      words = of_fit ? "fit to measured values" : parts[1];
    if (i > 2 && of_fit && words.empty())
      words = parts[i];  // the name of a pass
    for (const WordsOfFamily &one : of_one_family)
      if (i >= one.least && parts[0] == one.family && parts[i] == one.name)
        words = one.meaning;
    if (parts[0] == family::campbell && i > 0)
      words = words_of_crossing(parts[i]);
    if (i == 1 && parts[0] == family::contact)
      words = contact_title(parts[1]);
    if (!words.empty())
      meaning += (meaning.empty() ? "" : ", ") + words;
  }
  return meaning;
}

const Result *chain_value(const Run &run, const std::string &name)
{
  for (const char *ending : {"", ".tangent", ".combined"})
    if (const Result *result = run.find(name + ending))
      return result;
  return nullptr;
}

std::vector<Group> short_groups(const Run &run)
{
  if (run.manifest.kind == KindOfCase::bearing)
    return bearing_groups(run);
  if (run.manifest.kind == KindOfCase::bite)
    return bite_groups(run);
  if (run.manifest.kind == KindOfCase::chatter)
    return chatter_groups(run);
  if (run.manifest.kind == KindOfCase::cluster)
    return cluster_groups(run);
  if (run.manifest.kind == KindOfCase::stack)
    return stack_groups(run);
  Group contact{"Contact", {}}, stiffness{"Stiffness", {}}, mass{"Equivalent mass", {}}, named{"", {}},
      chain{"", {}}, fit{"Fit to measured values", {}};
  if (run.manifest.kind == KindOfCase::two_cylinders || !chain_value(run, "K1"))
    for (const Result &result : run.results)
      if (is_of(result.name, family::contact))
        contact.results.push_back(&result);
  for (int i = 1; i <= 7; ++i)
    add(stiffness, chain_value(run, "K" + std::to_string(i)));
  for (int i = 1; i <= 4; ++i)
    add(stiffness, chain_value(run, "Kzc" + std::to_string(i)));
  for (const Result &result : run.results)  // of every pass
    if (is_of(result.name, family::stand) &&
        (ends_with(result.name, ".modulus.tangent") || ends_with(result.name, ".modulus.kiss")))
      stiffness.results.push_back(&result);
  for (int i = 1; i <= 6; ++i)
    add(mass, run.find("M" + std::to_string(i)));
  // The modes of the best model lead, those of the six masses follow for comparison.
  const bool detailed = run.find("craig-bampton.f1") || run.find("beam.f1");
  for (const Result &result : run.results)
    if (detailed && is_of(result.name, family::mode) && ends_with(result.name, ".frequency")) {
      named.title = "Natural frequency, " + named_mode(result).model;
      named.results.push_back(&result);
    }
  for (int i = 1; i <= 6; ++i)
    add(chain, run.find("f" + std::to_string(i)));
  for (const char *number : {"friction", "friction_factor", "flow_stress_factor"})
    add(fit, run.find(result_name({family::bite, bite_fit, number})));
  chain.title = detailed ? "Natural frequency, compared with six masses" : "Natural frequency";

  std::vector<Group> groups;
  for (Group &group :
       {std::ref(contact), std::ref(stiffness), std::ref(mass), std::ref(named), std::ref(chain), std::ref(fit)})
    if (!group.results.empty())
      groups.push_back(group);
  for (const Group &group : chatter_groups(run))
    if (group.title.rfind("Chatter", 0) == 0)
      groups.push_back(group);
  return groups;
}

std::string contact_title(const std::string &contact)
{
  const auto name = choice_named<ContactName>(contact);
  if (!name)
    return "contact " + contact;
  switch (*name) {
  case ContactName::upper:
    return "upper contact (K3)";
  case ContactName::lower:
    return "lower contact (K5)";
  case ContactName::line:
    return "line contact";
  case ContactName::space:
    break;
  }
  return "contact in space";
}
}  // namespace mill::report
