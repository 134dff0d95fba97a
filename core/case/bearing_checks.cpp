#include "core/base/units.h"
#include "core/case/kinds.h"
#include "core/case/stand_reader.h"
#include "core/model/bearing_ratings.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill {
namespace {
// What a drawing or a catalogue fixes of a contact angle; half a degree moves Kzc by 0.6 %.
constexpr double angle_tolerance = 0.5 * M_PI / 180;

bool is_tapered(const RollerBearing &b)
{
  return b.type == BearingType::four_row_tapered;
}

double closing_roller_diameter(const RollerBearing &b)
{
  const double beta = b.roller_cone_angle / 2;
  return pitch_diameter(b) * std::tan(beta) / std::sin(b.cup_angle - beta);
}

// sin(alpha_o - beta) = r tan(beta) with r = D_pw/D_we, solved for tan(beta).
double closing_cone_angle(const RollerBearing &b)
{
  const double r = pitch_diameter(b) / b.roller_diameter;
  double beta    = std::sin(b.cup_angle) / (r + std::cos(b.cup_angle));
  for (int i = 0; i < 50; ++i)  // a contraction: beta is small
    beta = std::atan(std::sin(b.cup_angle - beta) / r);
  return 2 * beta;
}

void check_apex(const std::string &name, const RollerBearing &b, Reading &reading)
{
  const double closing = closing_cup_angle(b);
  if (!(b.roller_cone_angle > 0) || !(b.cup_angle > 0) || std::isnan(b.roller_diameter) ||
      std::isnan(pitch_diameter(b)) || std::abs(b.cup_angle - closing) <= angle_tolerance)
    return;
  const std::string closes = std::isnan(closing) ? "no cup angle closes it"
                                                 : fmt::format("cup_angle = \"{}\" closes it", degrees(closing));
  contradict(reading, name + ".cup_angle",
             fmt::format("leaves roller, cup and cone without a common apex; with a pitch diameter of {} {}, or "
                         "roller_diameter = \"{}\", or roller_cone_angle = \"{}\"",
                         millimetres(pitch_diameter(b)), closes, millimetres(closing_roller_diameter(b)),
                         degrees(closing_cone_angle(b))),
             {name + ".roller_diameter", name + ".roller_cone_angle"});
}

void check_sizes(const RollerBearing &b, Reading &reading)
{
  const auto key = [&](const char *k) { return "bearing." + b.name + "." + k; };
  if (reading.usable({key("bore"), key("outside_diameter")}) && b.bore >= b.outside_diameter)
    contradict(reading, key("bore"), "is not smaller than the outside diameter", {key("outside_diameter")});
  if (reading.usable({key("bore"), key("outside_diameter"), key("pitch_diameter")}) &&
      (b.pitch_diameter <= b.bore || b.pitch_diameter >= b.outside_diameter))
    contradict(reading, key("pitch_diameter"), "is not between bore and outside diameter",
               {key("bore"), key("outside_diameter")});
  if (reading.usable({key("rollers_per_row"), key("roller_diameter"), key("pitch_diameter"), key("bore"),
                      key("outside_diameter")})) {
    const double largest = M_PI * pitch_diameter(b) / b.rollers_per_row;
    if (b.roller_diameter > largest)
      contradict(reading, key("roller_diameter"),
                 fmt::format("makes {} rollers overlap on the pitch circle of {}; at most {} fit",
                             b.rollers_per_row, millimetres(pitch_diameter(b)), millimetres(largest)),
                 {key("rollers_per_row")});
    const double walls = (b.outside_diameter - b.bore) / 2;
    if (walls > 0 && b.roller_diameter >= walls)
      contradict(
          reading, key("roller_diameter"),
          fmt::format("leaves no rings: between bore and outside diameter there are {}", millimetres(walls)),
          {key("bore"), key("outside_diameter")});
  }
  if (reading.usable({key("roller_length"), key("width"), key("rows"), key("cup_angle")})) {
    // Rows of opposite hand lean towards each other: their raceways on one ring lie closer than the rows.
    const bool leaning = b.rows > 1 && b.arrangement.find('+') != std::string::npos &&
                         b.arrangement.find('-') != std::string::npos && std::isfinite(b.roller_diameter);
    const double axis = b.cup_angle - b.roller_cone_angle / 2;
    const double along =
        b.roller_length * std::cos(b.cup_angle) + (leaning ? b.roller_diameter * std::sin(axis) : 0);
    if (along > b.width / b.rows)
      contradict(
          reading, key("roller_length"),
          fmt::format("takes {} along the axis of a ring; a row has {}, the width of the bearing over {} rows",
                      millimetres(along), millimetres(b.width / b.rows), b.rows),
          {key("width"), key("rows")});
  }
  if (reading.usable({key("roller_length"), key("roller_total_length")}) &&
      b.roller_total_length < b.roller_length)
    contradict(reading, key("roller_total_length"), "is shorter than the effective length",
               {key("roller_length")});
}

void check_angles(const RollerBearing &b, Reading &reading)
{
  const std::string name = "bearing." + b.name;
  const auto key         = [&](const char *k) { return name + "." + k; };
  if (!reading.usable({key("type"), key("cup_angle"), key("roller_cone_angle"), key("roller_diameter")}))
    return;
  if (is_tapered(b) && b.cup_angle == 0)
    contradict(reading, key("type"), "needs a cup_angle above zero", {key("cup_angle")});
  else if (is_tapered(b) && reading.usable({key("bore"), key("outside_diameter"), key("pitch_diameter")}))
    check_apex(name, b, reading);
  if (!is_tapered(b) && (b.cup_angle != 0 || b.roller_cone_angle != 0))
    contradict(reading, key("type"), "takes neither a cup_angle nor a roller_cone_angle; leave them out",
               {key("cup_angle"), key("roller_cone_angle")});
}

void check_arrangement(const RollerBearing &b, Reading &reading)
{
  const std::string key = "bearing." + b.name + ".arrangement", rows = "bearing." + b.name + ".rows";
  if (reading.places.count(key) && reading.usable({key, rows}) && int(b.arrangement.size()) > b.rows)
    contradict(reading, key, fmt::format("arranges {} rows; the bearing has {}", b.arrangement.size(), b.rows),
               {rows});
}

void check_profile(const RollerBearing &b, Reading &reading)
{
  const auto key = [&](const char *k) { return "bearing." + b.name + "." + k; };
  if (reading.usable({key("profile"), key("crown_drop")}) &&
      (b.profile == RollerProfile::crown || b.profile == RollerProfile::three_parameter) &&
      std::isnan(b.crown_drop))
    contradict(reading, key("profile"), "needs a crown_drop", {});
  const bool logarithm = b.profile == RollerProfile::log || b.profile == RollerProfile::lundberg ||
                         b.profile == RollerProfile::three_parameter;
  const bool has_end = b.profile == RollerProfile::crown || b.profile == RollerProfile::three_parameter;
  for (const auto &[only, used] : {std::pair("crown_drop", has_end), std::pair("profile_load", logarithm)})
    if (!used && reading.places.count(key(only)) && reading.usable({key("profile")}))
      contradict(reading, key(only),
                 fmt::format("has no effect with profile = \"{}\"; leave it out", word_of(b.profile)),
                 {key("profile")});
  if (reading.usable({key("profile"), key("profile_table")}) && b.profile == RollerProfile::table &&
      b.profile_table.empty())
    contradict(reading, key("profile"), "needs a profile_table", {});
  if (reading.usable({key("profile"), key("profile_table")}) && b.profile != RollerProfile::table &&
      !b.profile_table.empty())
    contradict(reading, key("profile_table"), "is used by profile = \"table\" only", {key("profile")});
  const bool by_diameter =
      b.profile != RollerProfile::none && b.profile != RollerProfile::crown && b.profile != RollerProfile::table;
  if (reading.usable({key("profile"), key("roller_diameter")}) && by_diameter && std::isnan(b.roller_diameter))
    contradict(reading, key("profile"), "needs a roller_diameter", {});
}

// A rating for 90 million turns, which some makers of tapered bearings print, where the one for a million is
// asked.
void check_rating(const RollerBearing &b, Reading &reading)
{
  const auto key = [&](const char *k) { return "bearing." + b.name + "." + k; };
  if (!reading.places.count(key("dynamic_rating")) || !b.estimated.empty() ||
      !reading.usable({key("dynamic_rating"), key("rollers_per_row"), key("rows"), key("roller_diameter"),
                       key("roller_length"), key("cup_angle"), key("pitch_diameter"), key("bore"),
                       key("outside_diameter")}) ||
      !(b.roller_diameter > 0 && b.roller_length > 0 && b.rollers_per_row > 0 &&
        pitch_diameter(b) > b.roller_diameter))
    return;
  constexpr double scatter = 1.5;  // -, of makers' ratings about the formula: far below the factor 3.857
  const double by_formula  = ratings(b).dynamic;
  if (is_rating_of_90_million(b.dynamic_rating, by_formula, scatter))
    contradict(
        reading, key("dynamic_rating"),
        fmt::format(
            "is {:.2g} of the {:.4g} kN that ISO 281 gives with these rollers, as a rating for 90 million turns "
            "is (C/90^0.3); the rating for one million turns is needed, 90^0.3 = {:.3f} times as much: "
            "\"{:.4g} kN\"",
            b.dynamic_rating / by_formula, by_formula / 1e3, ratings_90_to_1,
            ratings_90_to_1 * b.dynamic_rating / 1e3),
        {key("roller_diameter"), key("roller_length")});
}

void check_fit(const RollerBearing &b, Reading &reading)
{
  const auto key   = [&](const char *k) { return "bearing." + b.name + "." + k; };
  const auto given = [&](const char *k) { return reading.places.count(key(k)) > 0; };
  if (given("end_play") && given("preload"))
    contradict(reading, key("end_play"), "is given together with a preload; give one of the two",
               {key("preload")});
  for (const char *axial : {"end_play", "preload"})
    if (given(axial)) {
      if (reading.usable({key("radial_clearance")}) && b.radial_clearance != 0)
        contradict(reading, key("radial_clearance"),
                   fmt::format("is given together with {}; give one of the two", axial), {key(axial)});
      if (reading.usable({key("type")}) && !is_tapered(b))
        contradict(reading, key(axial), "belongs to a tapered bearing; a cylindrical one carries no axial load",
                   {key("type")});
    }
  // Half the clearance is what a roller on the line of the load must travel; the cage does not let it.
  if (reading.usable({key("radial_clearance"), key("roller_diameter")}) &&
      b.radial_clearance / 2 > b.roller_diameter / 20)
    contradict(reading, key("radial_clearance"),
               fmt::format("is so large that no roller carries: the ring would have to move {}, a {:.0f}th of the "
                           "roller, before the first one touches both raceways; at most {} make sense",
                           millimetres(b.radial_clearance / 2), b.roller_diameter / (b.radial_clearance / 2),
                           millimetres(b.roller_diameter / 10)),
               {key("roller_diameter")});
}

void check_rings(const RollerBearing &b, Reading &reading)
{
  const auto key = [&](const char *k) { return "bearing." + b.name + "." + k; };
  std::string missing;
  for (const auto &[name, value] : {std::pair("bore", b.bore), std::pair("outside_diameter", b.outside_diameter),
                                    std::pair("width", b.width), std::pair("roller_diameter", b.roller_diameter)})
    if (std::isnan(value) && reading.usable({key(name)}))
      missing += (missing.empty() ? "" : ", ") + std::string(name);
  if (missing.empty() && counts_its_chock(b)) {
    const double across = std::min(b.chock_width, b.chock_height);
    if (reading.usable({key("chock_width"), key("chock_height"), key("outside_diameter")}) &&
        across < 1.1 * b.outside_diameter)
      contradict(reading, key(b.chock_width < b.chock_height ? "chock_width" : "chock_height"),
                 fmt::format("leaves no wall around the cup; at least 1.1 outside diameters, {}, are needed",
                             millimetres(1.1 * b.outside_diameter)),
                 {key("outside_diameter")});
    if (reading.usable({key("chock_support_width"), key("chock_width")}) && b.chock_support_width > b.chock_width)
      contradict(reading, key("chock_support_width"), "is wider than the chock", {key("chock_width")});
    if (reading.usable({key("chock_support_gap"), key("chock_support_width")}) &&
        b.chock_support_gap >= b.chock_support_width)
      contradict(reading, key("chock_support_gap"), "leaves no part of the face that carries the chock",
                 {key("chock_support_width")});
    if (reading.usable({key("chock_length"), key("width")}) && b.chock_length < b.width)
      contradict(reading, key("chock_length"), "is shorter than the bearing in it", {key("width")});
  }
  if (missing.empty() || !reading.usable({key("roller_law"), key("rings")}))
    return;
  if (b.roller_law == OneRollerLaw::fe || b.roller_law == OneRollerLaw::elastic)
    contradict(reading, key("roller_law"), "needs " + missing, {});
  if (b.rings == RingBodies::elastic)
    contradict(reading, key("rings"), "needs " + missing, {});
}
}  // namespace

namespace {
// What holds the chock, where the drawing does not say it.  A work roll's hangs on the bending cylinders at both
// of its sides; a backup roll's is pressed on its face by screw and beam.
void complete_support(RollerBearing &b, const bool of_backup_roll, const bool given)
{
  if (std::isnan(b.chock_width))
    return;
  b.support_assumed = !given && b.chock == ChockForm::block;
  const auto say    = [&](const char *key, const double value, const std::string &why) {
    b.filled.push_back(
           fmt::format("bearing.{}.{} is not given: {} assumed, {}", b.name, key, millimetres(value), why));
  };
  if (std::isnan(b.chock_support_width)) {
    b.chock_support_width = b.chock_width;
    say("chock_support_width", b.chock_width, "the width of the chock");
  }
  if (given || of_backup_roll)
    return;
  b.chock_support_gap = b.chock_width * 2 / 3;
  say("chock_support_gap", b.chock_support_gap,
      "two thirds of its width: two feet, as of a work roll's chock on its bending cylinders");
}
}  // namespace

// Roller, cup and cone share one apex: sin(alpha_m) = (D_pw/D_we) tan(beta), cup angle alpha_m + beta, with beta
// half the roller cone.
double closing_cup_angle(const RollerBearing &b)
{
  const double beta = b.roller_cone_angle / 2;
  return beta > 0 ? std::asin(pitch_diameter(b) / b.roller_diameter * std::tan(beta)) + beta : not_given;
}

void complete_bearing(RollerBearing &b, const bool of_backup_roll, const Reading &reading)
{
  const std::string name = "bearing." + b.name;
  const auto left_out    = [&](const char *k) {
    return !reading.places.count(name + "." + k) && reading.usable({name + "." + k}) &&
           std::find(b.estimated.begin(), b.estimated.end(), k) == b.estimated.end();
  };
  const auto fill = [&](double &value, const double filling, const char *k, const std::string &reason) {
    if (!left_out(k) || std::isnan(filling))
      return;
    value = filling;
    b.filled.push_back(fmt::format("{}.{} is not given: {}", name, k, reason));
  };
  if (is_tapered(b)) {
    const int missing =
        int(left_out("roller_diameter")) + int(left_out("cup_angle")) + int(left_out("roller_cone_angle"));
    if (missing == 1 && left_out("roller_diameter"))
      fill(b.roller_diameter, closing_roller_diameter(b), "roller_diameter",
           fmt::format("{} closes the apex condition", millimetres(closing_roller_diameter(b))));
    if (missing == 1 && left_out("cup_angle"))
      fill(b.cup_angle, closing_cup_angle(b), "cup_angle",
           fmt::format("{} closes the apex condition", degrees(closing_cup_angle(b))));
    if (missing == 1 && left_out("roller_cone_angle"))
      fill(b.roller_cone_angle, closing_cone_angle(b), "roller_cone_angle",
           fmt::format("{} closes the apex condition", degrees(closing_cone_angle(b))));
  }
  if (std::isfinite(b.raceway_flow) && left_out("yield_pressure")) {
    b.yield_pressure =
        yield_pressure_of(b.raceway_flow, b.raceway_state == RacewayTest::plane_strain, b.poisson_ratio);
    b.filled.push_back(fmt::format("{}.yield_pressure follows from raceway_flow_stress: {:.0f} MPa, where a line "
                                   "contact first yields, (5.42)",
                                   name, b.yield_pressure / 1e6));
  }
  const bool drawn = std::isfinite(b.bore) && std::isfinite(b.outside_diameter) && std::isfinite(b.width) &&
                     std::isfinite(b.roller_diameter);
  if (left_out("roller_law"))
    b.roller_law = drawn ? OneRollerLaw::fe : OneRollerLaw::iso;
  if (left_out("rings"))
    b.rings = drawn ? RingBodies::elastic : RingBodies::rigid;
  b.arrangement_assumed   = is_tapered(b) && b.rows > 1 && left_out("arrangement");
  const std::size_t hands = b.rows < 4 ? 2 : 4;
  if (b.arrangement == "back-to-back")
    b.arrangement = std::string("+-+-", hands);
  if (b.arrangement == "face-to-face")
    b.arrangement = std::string("-+-+", hands);
  if (!counts_its_chock(b))
    return;
  b.chock_assumed = true;
  for (const char *k : {"chock", "chock_width", "chock_height", "chock_length"})
    b.chock_assumed = b.chock_assumed && left_out(k);
  const auto size = [&](double &value, const double filling, const char *k, const char *rule) {
    fill(value, filling, k, fmt::format("{} assumed, {}", millimetres(filling), rule));
  };
  size(b.chock_width, 1.7 * b.outside_diameter, "chock_width", "1.7 outside diameters");
  size(b.chock_height, 1.6 * b.outside_diameter, "chock_height", "1.6 outside diameters");
  size(b.chock_length, b.width, "chock_length", "the width of the bearing");
  complete_support(b, of_backup_roll, !left_out("chock_support_width") || !left_out("chock_support_gap"));
}

namespace {
void check_yield(const RollerBearing &b, Reading &reading)
{
  const auto key = [&](const char *k) { return "bearing." + b.name + "." + k; };
  if (!std::isfinite(b.raceway_flow) || !reading.places.count(key("yield_pressure")) ||
      !reading.usable(
          {key("yield_pressure"), key("raceway_flow_stress"), key("raceway_flow_state"), key("poisson_ratio")}))
    return;
  const double follows =
      yield_pressure_of(b.raceway_flow, b.raceway_state == RacewayTest::plane_strain, b.poisson_ratio);
  if (std::abs(b.yield_pressure / follows - 1) > 1e-3)
    contradict(reading, key("yield_pressure"),
               fmt::format("differs from the {:.0f} MPa that follow from raceway_flow_stress; give one of the two",
                           follows / 1e6),
               {key("raceway_flow_stress")});
}
}  // namespace

void check_bearing(const RollerBearing &bearing, Reading &reading)
{
  check_sizes(bearing, reading);
  check_angles(bearing, reading);
  check_arrangement(bearing, reading);
  check_profile(bearing, reading);
  check_fit(bearing, reading);
  check_rating(bearing, reading);
  check_rings(bearing, reading);
  check_yield(bearing, reading);
}

void check_bearing_name(const std::string &key, const std::string &bearing, const std::vector<std::string> &names,
                        Reading &reading)
{
  if (!reading.usable({key}) ||
      (bearing.empty() && !reading.places.count(key)))  // not given where it may be left out
    return;
  if (std::find(names.begin(), names.end(), bearing) != names.end())
    return;
  std::string remedy = "add it";
  if (const std::string near = nearest_word(bearing, names); !near.empty())
    remedy = "did you mean '" + near + "'? If not, add the section";
  else if (!names.empty())
    remedy = fmt::format("add it, or name one that is given: {}", fmt::join(names, ", "));
  reading.add(reading.place(key),
              fmt::format("{}: no section [bearing.{}] is given; {}", reading.as_written(key), bearing, remedy));
}

namespace {
// Loads of the bearing in addition to a radial load, and instead of one.
void check_other_loads(const BearingCase &spec, Reading &reading)
{
  const BearingLoad &l = spec.load;
  const bool displaced = std::isfinite(l.axial_displacement), turned = std::isfinite(l.moment);
  if (reading.usable({"load.axial", "load.axial_displacement"}) && l.axial != 0 && displaced)
    contradict(reading, "load.axial_displacement", "is given together with an axial load; give one of the two",
               {"load.axial"});
  if (reading.usable({"load.tilt", "load.moment"}) && l.tilt != 0 && turned)
    contradict(reading, "load.moment", "is given together with a tilt; give one of the two", {"load.tilt"});
  if (!reading.usable({"load.radial", "load.axial", "load.axial_displacement", "load.tilt", "load.moment"}) ||
      l.radial > 0)
    return;
  if (l.axial == 0 && l.tilt == 0 && !(displaced && l.axial_displacement != 0) && !(turned && l.moment != 0))
    contradict(reading, "load.radial",
               "leaves the bearing without a load; give axial, axial_displacement, moment or tilt", {});
  if (reading.places.count("load.loads") && reading.usable({"load.loads"}))
    contradict(reading, "load.loads", "sweeps a radial load, which this case does not have; leave it out",
               {"load.radial"});
  if (reading.usable({"dynamics.mass"}) && std::isfinite(spec.motion.mass))
    contradict(reading, "dynamics.mass", "swings on the curve of a radial load, which this case does not have",
               {"load.radial"});
}
}  // namespace

void check_bearing_load(const BearingCase &spec, Reading &reading)
{
  check_bearing_name("load.bearing", spec.load.bearing, bearing_names(spec), reading);
  check_other_loads(spec, reading);
  const auto &loads = spec.load.loads;
  if (!reading.usable({"load.loads", "load.radial"}) || std::isnan(loads[0]) || !(spec.load.radial > 0))
    return;
  if (!(loads[1] > loads[0]))
    contradict(reading, "load.loads", "does not increase; the smaller load comes first", {});
  else if (reading.places.count("load.loads") && (spec.load.radial < loads[0] || spec.load.radial > loads[1]))
    contradict(reading, "load.radial",
               "is outside " + reading.as_written("load.loads") + "; change one of the two", {"load.loads"});
}
}  // namespace mill
