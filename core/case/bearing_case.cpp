#include "core/case/stand_reader.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
// [model] says some keys of the loaded bearing again; saying two things is a contradiction.
struct Model {
  std::string bearing;  // that it is about
  BearingModelInput input;
};

void apply(const Model &model, RollerBearing &bearing, Reading &reading)
{
  const auto one = [&](const char *k, auto &value, const auto &given) {
    const std::string here = std::string("model.") + k, there = "bearing." + bearing.name + "." + k;
    if (!reading.places.count(here))
      return;
    if (reading.places.count(there) && value != given)
      contradict(reading, here, "contradicts " + reading.as_written(there) + "; leave one of the two out",
                 {there});
    value                  = given;
    reading.places[there]  = reading.places.at(here);
    reading.written[there] = reading.written[here];
  };
  one("roller_law", bearing.roller_law, model.input.roller_law.value_or(bearing.roller_law));
  one("rings", bearing.rings, model.input.rings.value_or(bearing.rings));
  one("slices", bearing.slices, model.input.slices);
}

// What was assumed stays open in the echo too, so that it runs to the same results.
RollerBearing as_given(RollerBearing bearing)
{
  if (bearing.arrangement_assumed)
    bearing.arrangement.clear();
  if (bearing.chock_assumed) {
    bearing.chock_width = bearing.chock_height = bearing.chock_length = not_given;
  }
  if (bearing.support_assumed)
    bearing.chock_support_width = bearing.chock_support_gap = not_given;
  return bearing;
}

// Without those whose values are estimates, or follow from them.
std::vector<Field<RollerBearing>> known_rows(const RollerBearing &bearing, const Reading &reading)
{
  const auto &list    = bearing.estimated;
  const auto is_known = [&](const std::string &key) {
    const bool follows = !list.empty() && (key == "roller_cone_angle" || key == "cup_angle");
    return reading.places.count("bearing." + bearing.name + "." + key) ||
           (!follows && std::find(list.begin(), list.end(), key) == list.end());
  };
  std::vector<Field<RollerBearing>> rows;
  for (const Field<RollerBearing> &row : bearing_rows())
    if (is_known(row.key)) {
      rows.push_back(row);
      if (bearing.chock_assumed && row.key == std::string("chock"))
        std::get<ChoiceMember<RollerBearing>>(rows.back().member).words = [](const RollerBearing &) {
          return Value(std::string());
        };
    }
  return rows;
}

RollerBearing read_bearing(const Node::Entry &entry, const Model &model, const std::string &on_backup_roll,
                           Reading &reading)
{
  RollerBearing bearing;
  bearing.name = entry.key;
  const Section section{&entry.value, "bearing." + entry.key};
  read(section, bearing_rows_for(section), bearing, reading);
  if (bearing.name == model.bearing)
    apply(model, bearing, reading);
  complete_by_designation(bearing, reading);
  complete_bearing(bearing, bearing.name == on_backup_roll, reading);
  reading.echo +=
      fmt::format("\n[bearing.{}]\n{}{}", key_text(entry.key),
                  resolved_lines(section.name, known_rows(bearing, reading), as_given(bearing), reading),
                  estimated_lines(bearing));
  check_bearing(bearing, reading);
  return bearing;
}

std::vector<RollerBearing> read_all(const Node &root, const Model &model, const std::string &on_backup_roll,
                                    Reading &reading)
{
  std::vector<RollerBearing> bearings;
  const Section all = section_at(root, "bearing", reading);
  if (!all.node)
    return bearings;  // whoever names one then says that it does not exist
  for (const Node::Entry &entry : all.node->entries)
    if (is_oil_film(entry))
      continue;
    else if (entry.value.kind == Node::Kind::table)
      bearings.push_back(read_bearing(entry, model, on_backup_roll, reading));
    else
      reading.add(entry.value.place, fmt::format("bearing.{} = {} is a value; a section [bearing.{}] is needed",
                                                 entry.key, shown(entry.value), entry.key));
  return bearings;
}
}  // namespace

std::vector<RollerBearing> read_bearings(const Node &root, const std::string &on_backup_roll, Reading &reading)
{
  return read_all(root, {}, on_backup_roll, reading);
}

BearingCase read_bearing_case(const Node &root, Reading &reading)
{
  BearingCase spec;
  read(section_at(root, "load", reading), bearing_load_rows(), spec.load, reading);
  if (std::isnan(spec.load.loads[0]) && spec.load.radial > 0)
    spec.load.loads = {0.1 * spec.load.radial, 4 * spec.load.radial};
  Model model{spec.load.bearing, {}};
  if (const Section section = section_at(root, "model", reading); section.node)
    read(section, bearing_model_rows(), model.input, reading);
  spec.bearings  = read_all(root, model, "", reading);
  spec.oil_films = read_oil_films(root, reading);
  reading.echo += "\n[load]\n" + resolved_lines("load", bearing_load_rows(), spec.load, reading);
  const Section motion = section_at(root, "dynamics", reading);
  read_and_echo(motion, motion.header(), bearing_motion_rows(), spec.motion, reading);
  spec.published = read_given(root, "published", "bearing", reading);
  check_bearing_load(spec, reading);
  check_oil_film_load(root, spec, reading);
  return spec;
}
}  // namespace mill
