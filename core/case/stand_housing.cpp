#include "core/case/estimates.h"
#include "core/case/given_instead.h"
#include "core/case/stand_reader.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

// [housing] and [screwdown]: parts of the frame as drawn, instead of the stiffnesses and masses that follow.
namespace mill {
const std::vector<Field<MillHousing>> &housing_rows()
{
  using T                                 = MillHousing;
  static const std::vector<Field<T>> rows = [] {
    std::vector<Field<T>> all;
    const auto length = [&](const char *key, Member<T> member, Range range, const char *example,
                            const char *meaning) {
      all.push_back({key, member, "mm", range, required, example, meaning});
    };
    length("thickness", &T::thickness, {50, 5000}, "700 mm", "of one housing, along the rolls");
    length("post_width", &T::post_width, {50, 5000}, "650 mm", "of each post, along the pass line");
    length("window_width", &T::window_width, {100, 10000}, "1620 mm", "between the posts");
    length("window_height", &T::window_height, {200, 20000}, "5600 mm", "between the beams");
    length("upper_beam_height", &T::upper_beam_height, {50, 6000}, "1200 mm", "of the beam that holds the nut");
    length("lower_beam_height", &T::lower_beam_height, {50, 6000}, "1200 mm", "of the beam that the chocks press");
    length("fillet_radius", &T::fillet_radius, {0, 3000}, "250 mm", "of the corners of the window");
    length("foot_height", &T::foot_height, {-6000, 20000}, "900 mm",
           "level at which the posts stand on the foundation, from the bottom of the window");
    length("screw_pad", &T::screw_pad, {20, 5000}, "600 mm",
           "side of the square under the upper beam that the nut presses on");
    length("seat_pad", &T::seat_pad, {20, 5000}, "700 mm",
           "side of the square on the lower beam that the chock presses on");
    all.push_back(
        {"youngs_modulus", &T::modulus, "GPa", {1, 1000}, absent, "205 GPa", "when absent that of [steel]"});
    all.push_back(
        {"density", &T::density, "kg/m3", {500, 25000}, absent, "7800 kg/m3", "when absent that of [steel]"});
    all.push_back({"stiffness",
                   &T::stiffness,
                   "MN/mm",
                   {0.1, 100},
                   absent,
                   "18 MN/mm",
                   "in place of the drawing: of one housing, force over what screw and seat move apart; "
                   "frame.estimate = true shares it among posts and beams"});
    return all;
  }();
  return rows;
}

const std::vector<Field<Screwdown>> &screwdown_rows()
{
  using T                                 = Screwdown;
  static const std::vector<Field<T>> rows = [] {
    std::vector<Field<T>> all;
    const auto length = [&](const char *key, Member<T> member, Range range, const char *example,
                            const char *meaning) {
      all.push_back({key, member, "mm", range, absent, example, meaning});
    };
    length("screw_diameter", &T::screw_diameter, {10, 3000}, "440 mm", "core of the screw");
    length("screw_length", &T::screw_length, {1, 10000}, "600 mm", "free length of the screw below the nut");
    length("nut_outside_diameter", &T::nut_outside_diameter, {10, 5000}, "700 mm", "of the nut around the screw");
    length("nut_height", &T::nut_height, {1, 10000}, "900 mm", "engaged length of the thread");
    all.push_back(
        {"nut_modulus", &T::nut_modulus, "GPa", {1, 1000}, 110, "110 GPa", "Young's modulus of the nut"});
    length("piston_diameter", &T::piston_diameter, {10, 5000}, "800 mm", "of piston and oil column");
    length("piston_length", &T::piston_length, {1, 5000}, "300 mm", "of the piston under load");
    length("stroke", &T::stroke, {0.1, 5000}, "40 mm", "height of the oil column");
    all.push_back({"oil_modulus", &T::oil_modulus, "GPa", {0.01, 10}, 1.4, "1.4 GPa", "bulk modulus of the oil"});
    length("load_cell_diameter", &T::load_cell_diameter, {10, 5000}, "500 mm", "outside, of one load cell");
    all.push_back({"load_cell_bore", &T::load_cell_bore, "mm", {0, 5000}, 0, "0 mm", "its hole"});
    length("load_cell_height", &T::load_cell_height, {1, 2000}, "120 mm", "of the load cell");
    return all;
  }();
  return rows;
}

namespace {
// Keys of [frame] that a drawing makes needless.
const std::vector<std::string> behind_housing{
    "upper_post_mass",      "upper_beam_mass",      "lower_post_mass",      "lower_beam_mass",
    "upper_post_stiffness", "upper_beam_stiffness", "lower_post_stiffness", "lower_beam_stiffness"};

struct ChockSpring {
  const char *key;
  double Frame::*stiffness;
};
constexpr std::array<ChockSpring, 2> chock_springs{{{"upper_chock_stiffness", &Frame::upper_chock_stiffness},
                                                    {"lower_chock_stiffness", &Frame::lower_chock_stiffness}}};

void check_housing(const MillHousing &h, Reading &reading)
{
  const auto key = [](const char *name) { return std::string("housing.") + name; };
  for (const auto &[pad, size] : {std::pair("screw_pad", h.screw_pad), std::pair("seat_pad", h.seat_pad)}) {
    if (reading.usable({key(pad), key("thickness")}) && size > h.thickness)
      contradict(reading, key(pad), "is wider than the housing is thick", {key("thickness")});
    if (reading.usable({key(pad), key("window_width"), key("fillet_radius")}) &&
        size > h.window_width - 2 * h.fillet_radius)
      contradict(reading, key(pad), "does not fit between the fillets of the window",
                 {key("window_width"), key("fillet_radius")});
  }
  if (reading.usable({key("fillet_radius"), key("window_width"), key("window_height")}) &&
      h.fillet_radius >= 0.5 * std::min(h.window_width, h.window_height))
    contradict(reading, key("fillet_radius"), "is half the window or more",
               {key("window_width"), key("window_height")});
  if (reading.usable({key("fillet_radius"), key("post_width")}) && h.fillet_radius < 0.05 * h.post_width)
    contradict(reading, key("fillet_radius"),
               fmt::format("leaves a sharp corner, at which no stress converges; give {} or more",
                           millimetres(0.05 * h.post_width)),
               {key("post_width")});
  const double low = h.fillet_radius + 0.05 * h.post_width, high = h.window_height - low;
  if (reading.usable({key("foot_height"), key("window_height"), key("fillet_radius"), key("post_width")}) &&
      (h.foot_height < low || h.foot_height > high))
    contradict(reading, key("foot_height"),
               fmt::format("is not on the straight part of the posts, {} .. {} above the bottom of the window",
                           millimetres(low), millimetres(high)),
               {key("window_height"), key("fillet_radius")});
}

// Two keys of which the one says nothing without the other.
void need_both(const std::pair<const char *, double> &first, const std::pair<const char *, double> &second,
               Reading &reading)
{
  const std::string a = std::string("screwdown.") + first.first, b = std::string("screwdown.") + second.first;
  if (!reading.usable({a, b}) || std::isnan(first.second) == std::isnan(second.second))
    return;
  const bool has_first = !std::isnan(first.second);
  contradict(reading, has_first ? a : b, fmt::format("needs {} too", has_first ? b : a), {});
}

void check_screwdown(const Screwdown &s, Reading &reading)
{
  need_both({"screw_diameter", s.screw_diameter}, {"screw_length", s.screw_length}, reading);
  need_both({"nut_outside_diameter", s.nut_outside_diameter}, {"nut_height", s.nut_height}, reading);
  need_both({"load_cell_diameter", s.load_cell_diameter}, {"load_cell_height", s.load_cell_height}, reading);
  const auto needs_piston = [&](const char *name, const double value) {
    const std::string key = std::string("screwdown.") + name;
    if (reading.usable({key, "screwdown.piston_diameter"}) && !std::isnan(value) && std::isnan(s.piston_diameter))
      contradict(reading, key, "needs screwdown.piston_diameter too", {});
  };
  needs_piston("stroke", s.stroke);
  needs_piston("piston_length", s.piston_length);
  if (reading.usable({"screwdown.piston_diameter"}) && !std::isnan(s.piston_diameter) && std::isnan(s.stroke) &&
      std::isnan(s.piston_length))
    contradict(reading, "screwdown.piston_diameter", "needs screwdown.stroke or screwdown.piston_length too", {});
  if (reading.usable({"screwdown.nut_outside_diameter", "screwdown.screw_diameter"}) &&
      !std::isnan(s.nut_outside_diameter)) {
    if (std::isnan(s.screw_diameter))
      contradict(reading, "screwdown.nut_outside_diameter", "needs screwdown.screw_diameter too", {});
    else if (s.nut_outside_diameter <= s.screw_diameter)
      contradict(reading, "screwdown.nut_outside_diameter", "is not larger than the screw",
                 {"screwdown.screw_diameter"});
  }
  if (reading.usable({"screwdown.load_cell_bore", "screwdown.load_cell_diameter"}) &&
      s.load_cell_bore >= s.load_cell_diameter)
    contradict(reading, "screwdown.load_cell_bore", "is not smaller than the load cell",
               {"screwdown.load_cell_diameter"});
}
}  // namespace

MillHousing read_housing(const Node &root, const Material &steel, Reading &reading)
{
  MillHousing housing;
  const Section section = section_at(root, "housing", reading);
  if (!section.node)
    return housing;
  std::vector<Field<MillHousing>> rows = housing_rows();
  const bool known                     = section.node->find("stiffness") != nullptr;
  if (known)  // no drawing
    for (Field<MillHousing> &row : rows)
      row.fallback = absent;
  read_and_echo(section, section.header(), rows, housing, reading);
  if (known) {
    for (const Field<MillHousing> &row : rows)
      if (const std::string key = section.key(row.key); reading.places.count(key) && key != "housing.stiffness")
        contradict(reading, key, "has no effect with housing.stiffness, which is in place of the drawing", {});
    housing.thickness = not_given;
    return housing;
  }
  housing.steel = steel;
  if (!std::isnan(housing.modulus))
    housing.steel.youngs_modulus = housing.modulus;
  if (!std::isnan(housing.density))
    housing.steel.density = housing.density;
  check_housing(housing, reading);
  return housing;
}

Screwdown read_screwdown(const Node &root, Reading &reading)
{
  Screwdown screwdown;
  const Section section = section_at(root, "screwdown", reading);
  if (!section.node)
    return screwdown;
  read_and_echo(section, section.header(), screwdown_rows(), screwdown, reading);
  check_screwdown(screwdown, reading);
  return screwdown;
}

std::vector<std::string> frame_keys_behind(const bool housing, const Screwdown &screwdown,
                                           const RollerBearing *backup_bearing)
{
  std::vector<std::string> keys;
  if (housing)
    keys = behind_housing;
  if (!std::isnan(screwdown.stroke))
    keys.push_back("oil_column_stiffness");
  if (!std::isnan(screwdown.screw_length) || !std::isnan(screwdown.nut_height) ||
      !std::isnan(screwdown.piston_length))
    keys.push_back("piston_stiffness");
  if (!std::isnan(screwdown.load_cell_height))
    keys.push_back("load_cell_stiffness");
  if (backup_bearing && counts_its_chock(*backup_bearing))
    for (const ChockSpring &chock : chock_springs)
      keys.push_back(chock.key);
  return keys;
}

void drop_counted_chocks(Frame &frame, RollerBearing &bearing, const Reading &reading)
{
  if (!counts_its_chock(bearing))
    return;
  for (const ChockSpring &chock : chock_springs) {
    const std::string key = std::string("frame.") + chock.key;
    if (reading.places.count(key) && reading.usable({key}))
      bearing.filled.push_back(fmt::format(
          "{} is left out of the chain: bearing.{} deflects with its chock (rings = \"elastic\", chock = "
          "\"{}\"), "
          "which the stiffness of the bearing already includes; chock = \"rigid\" leaves the chock to [frame]",
          reading.as_written(key), bearing.name, word_of(bearing.chock)));
    frame.*chock.stiffness = INFINITY;
  }
}

Frame read_frame(const Node &root, const std::vector<std::string> &needless, const std::set<std::string> &given,
                 EstimateInput &wish, Reading &reading)
{
  Frame frame;
  const Section section = section_at(root, "frame", reading);
  wish                  = read_estimate(section, estimate_rows(), reading);
  std::vector<Field<Frame>> rows =
      beside_estimate("frame", beside_given("frame", frame_rows(), given, frame), wish.estimate, frame);
  for (Field<Frame> &row : rows)
    if (std::find(needless.begin(), needless.end(), row.key) != needless.end()) {
      row.fallback = absent;
      set_member(row, Value(not_given), frame);
    }
  std::vector<std::string> others;
  for (const Row &row : tolerance_rows(rows_of(rows)))
    others.push_back(row.key);
  for (const Row &row : rows_of(estimate_rows()))
    others.push_back(row.key);
  read_and_echo(section, section.header(), rows, frame, reading, others);
  reading.echo += resolved_lines("frame", estimate_rows(), wish, reading);
  frame.tolerance = read_tolerances(rows_of(rows), section, reading);
  for (const Field<Frame> &row : rows)
    if (frame.tolerance.count(row.key) && std::isnan(std::get<double>(member_value(row, frame))) &&
        std::find(needless.begin(), needless.end(), row.key) == needless.end())
      contradict(reading, "frame." + tolerance_key(row.key),
                 std::string("belongs to frame.") + row.key + ", which is not given; give both or neither", {});
  return frame;
}
}  // namespace mill
