#include "core/base/files.h"
#include "core/case/bearing_catalogue.h"
#include "core/case/stand_reader.h"
#include "core/model/bearing_ratings.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

// What a designation gives a bearing, and estimates of what no catalogue prints.
namespace mill {
namespace {
// Contact angle of roll-neck bearings, where nothing says it: e = 1.5 tan(alpha) of 0.32 .. 0.49 in catalogues.
constexpr double usual_angle = 15 * M_PI / 180, usual_angle_spread = 3 * M_PI / 180;

std::string kilonewtons(const double force)
{
  return fmt::format("{:.6g} kN", force / 1e3);
}

/// The keys of one bearing as they stand in the case.
struct Keys {
  const RollerBearing &bearing;
  Reading &reading;
  std::string full(const std::string &key) const
  {
    return "bearing." + bearing.name + "." + key;
  }
  bool given(const std::string &key) const
  {
    return reading.places.count(full(key)) > 0;
  }
  bool left_out(const std::string &key) const
  {
    return !given(key) && reading.usable({full(key)});
  }
  // Keys that wait for a catalogue cause no further errors.
  void give_up() const
  {
    for (const char *key : {"type", "bore", "outside_diameter", "width", "rows", "rollers_per_row",
                            "roller_length", "roller_diameter", "cup_angle"})
      if (!given(key))
        reading.bad.insert(full(key));
  }
};

std::vector<CatalogueBearing> own_catalogue(const Keys &keys)
{
  if (keys.bearing.catalogue.empty())
    return {};
  try {
    return catalogue_of(keys.bearing.catalogue, read_text(keys.bearing.catalogue));
  } catch (const SystemError &) {
    throw;
  } catch (const InputError &error) {
    for (Problem problem : error.problems) {
      if (problem.place.line == 0)  // the file as a whole
        problem.place = keys.reading.place(keys.full("catalogue"));
      keys.reading.problems.push_back(problem);
    }
    keys.give_up();
    return {};
  }
}

// nullptr: the reason was reported.
const CatalogueBearing *looked_up(const Keys &keys, const std::vector<CatalogueBearing> &catalogue)
{
  const RollerBearing &b = keys.bearing;
  if (const CatalogueBearing *bearing = find_bearing(catalogue, b.designation))
    return bearing;
  if (const CatalogueBearing *bearing = find_bearing(shipped_catalogue(), b.designation))
    return bearing;
  keys.give_up();
  if (!b.catalogue.empty() && catalogue.empty())
    return nullptr;  // unreadable
  std::vector<CatalogueBearing> all = catalogue;
  all.insert(all.end(), shipped_catalogue().begin(), shipped_catalogue().end());
  std::string near;
  for (const std::string &name : nearest_designations(all, b.designation))
    near += (near.empty() ? "" : ", ") + name;
  keys.reading.add(keys.reading.place(keys.full("designation")),
                   fmt::format("{} is {}; nearest: {}", keys.reading.as_written(keys.full("designation")),
                               catalogue.empty()
                                   ? "not in the catalogue"
                                   : "neither in " + b.catalogue + " nor in the catalogue of the program",
                               near));
  return nullptr;
}

// A length or a count of the catalogue against the one that is given.
template <class T>
void fill(const Keys &keys, const char *key, T &value, const T &from, const std::string &as_text)
{
  if (keys.left_out(key))
    value = from;
  else if (keys.given(key) && std::abs(double(value) / double(from) - 1) > 1e-3)
    contradict(keys.reading, keys.full(key),
               fmt::format("is not that of the designation, for which the catalogue has {}", as_text),
               {keys.full("designation")});
}

void take_sizes(RollerBearing &b, const Keys &keys, const CatalogueBearing &from)
{
  if (keys.left_out("type"))
    b.type = from.type;
  else if (keys.given("type") && b.type != from.type)
    contradict(
        keys.reading, keys.full("type"),
        fmt::format("is not that of the designation, for which the catalogue has \"{}\"", word_of(*from.type)),
        {keys.full("designation")});
  fill(keys, "bore", b.bore, from.bore, millimetres(from.bore));
  fill(keys, "outside_diameter", b.outside_diameter, from.outside_diameter, millimetres(from.outside_diameter));
  fill(keys, "width", b.width, from.width, millimetres(from.width));
  fill(keys, "rows", b.rows, from.rows, std::to_string(from.rows));
  b.catalogue_source = from.source;
  std::string message =
      fmt::format("bearing.{}: {} in the catalogue has {} x {} x {}, {} rows", b.name, from.designation,
                  millimetres(from.bore), millimetres(from.outside_diameter), millimetres(from.width), from.rows);
  if (std::isfinite(from.dynamic_rating)) {
    if (keys.left_out("dynamic_rating"))
      b.dynamic_rating = from.dynamic_rating;
    if (keys.left_out("static_rating"))
      b.static_rating = from.static_rating;
    message += fmt::format(", C {}, C0 {}", kilonewtons(from.dynamic_rating), kilonewtons(from.static_rating));
  }
  b.filled.push_back(message + " (" + from.source + ")");
}

// The candidates with the angle at both ends of what it may be.
void add_other_angles(const RollerBearing &b, std::vector<RollerCandidate> &candidates)
{
  KnownRollers same;
  same.rollers_per_row = candidates.front().rollers_per_row;
  for (const double angle : {usual_angle - usual_angle_spread, usual_angle + usual_angle_spread}) {
    RollerBearing other = b;
    other.cup_angle     = angle;
    for (const RollerCandidate &c : roller_candidates(other, same))
      candidates.push_back(c);
  }
  relate_stiffness(candidates);
}

std::string estimate_text(const RollerBearing &b, const std::string &keys)
{
  const RollerCandidate &c = b.candidates.front();
  int least = c.rollers_per_row, most = least;
  for (const RollerCandidate &other : b.candidates) {
    least = std::min(least, other.rollers_per_row);
    most  = std::max(most, other.rollers_per_row);
  }
  const std::string others = least == most ? "" : fmt::format("; {} .. {} rollers do so too", least, most);
  const std::string angle  = c.cup_angle > 0 ? " at a contact angle of " + degrees(c.cup_angle) : "";
  return fmt::format("bearing.{}.{}: estimated, {} rollers of {:.4g} x {:.4g} mm in each row, filling {:.0f} % of "
                     "the pitch circle, give C {} and C0 {}{}, (5.40), (5.41){}; the radial stiffness is known to "
                     "{:.2g} % through that",
                     b.name, keys, c.rollers_per_row, 1e3 * c.roller_diameter, 1e3 * c.roller_length,
                     100 * c.filling, kilonewtons(b.dynamic_rating), kilonewtons(b.static_rating), angle, others,
                     std::max(0.01, 100 * stiffness_spread(b.candidates)));
}

void refuse_to_estimate(const Keys &keys, const std::string &why)
{
  keys.give_up();
  const std::string key = keys.full("designation");
  keys.reading.add(keys.reading.place(key), fmt::format("{}: {}", keys.reading.as_written(key), why));
}

// Takes over what the first candidate says of these keys.
void take_rollers(RollerBearing &b, std::vector<std::string> keys, const bool angle)
{
  const RollerCandidate &chosen = b.candidates.front();
  std::string names;
  if (angle)
    keys.push_back("cup_angle");
  for (const std::string &key : keys) {
    if (key == "rollers_per_row")
      b.rollers_per_row = chosen.rollers_per_row;
    else if (key == "roller_diameter")
      b.roller_diameter = chosen.roller_diameter;
    else if (key == "roller_length")
      b.roller_length = chosen.roller_length;
    else
      b.cup_angle = chosen.cup_angle;
    names += (names.empty() ? "" : ", ") + key;
  }
  b.estimated = keys;
  b.filled.push_back(estimate_text(b, names));
}

// Rollers, and the angle of a tapered bearing, that no key gives.
void estimate(RollerBearing &b, const Keys &keys, const CatalogueBearing &from)
{
  std::vector<std::string> missing;
  for (const char *key : {"rollers_per_row", "roller_diameter", "roller_length"})
    if (keys.left_out(key))
      missing.push_back(key);
  if (missing.empty() || !keys.reading.usable({keys.full("type"), keys.full("rows"), keys.full("bore"),
                                               keys.full("outside_diameter"), keys.full("pitch_diameter")}))
    return;
  if (!(b.dynamic_rating > 0 && b.static_rating > 0)) {
    if (missing == std::vector<std::string>{"roller_diameter"})
      return;  // which a bearing can do without
    return refuse_to_estimate(keys,
                              "the catalogue has no ratings of it, from which rollers could be estimated; give "
                              "rollers_per_row, roller_diameter and roller_length, or dynamic_rating and "
                              "static_rating");
  }
  const bool angle = b.type == BearingType::four_row_tapered && keys.left_out("cup_angle");
  const KnownRollers known{b.rollers_per_row, b.roller_diameter,
                           b.roller_length > 0 ? b.roller_length : not_given};
  RollerBearing trial = b;
  if (angle)
    trial.cup_angle = std::isfinite(from.e) ? std::atan(from.e / 1.5) : usual_angle;
  b.candidates = roller_candidates(trial, known);
  if (b.candidates.empty()) {
    trial.dynamic_rating *= ratings_90_to_1;
    const bool of_90_million = !roller_candidates(trial, known).empty();
    return refuse_to_estimate(
        keys, fmt::format(
                  "no rollers of {} x {} give C {} and C0 {} by ISO 281 and ISO 76; give {}", millimetres(b.bore),
                  millimetres(b.outside_diameter), kilonewtons(b.dynamic_rating), kilonewtons(b.static_rating),
                  of_90_million ? fmt::format("dynamic_rating for one million turns: C {} is one for 90 million "
                                              "turns, and 90^0.3 = {:.3f} times as much is \"{}\"",
                                              kilonewtons(b.dynamic_rating), ratings_90_to_1,
                                              kilonewtons(trial.dynamic_rating))
                                : "rollers_per_row, roller_diameter and roller_length"));
  }
  const bool open_angle = angle && keys.left_out("roller_cone_angle");
  if (open_angle && std::isnan(from.e))
    add_other_angles(trial, b.candidates);
  take_rollers(b, missing, open_angle);
}
}  // namespace

std::vector<Field<RollerBearing>> bearing_rows_for(const Section &section)
{
  std::vector<Field<RollerBearing>> rows = bearing_rows();
  if (section.node && section.node->find("designation"))
    for (Field<RollerBearing> &row : rows)
      if (row.fallback.kind == Fallback::Kind::required)
        row.fallback = absent;
  return rows;
}

void complete_by_designation(RollerBearing &b, Reading &reading)
{
  const Keys keys{b, reading};
  if (b.designation.empty()) {
    if (keys.given("designation") || !reading.usable({keys.full("designation")}))
      keys.give_up();
    if (keys.given("designation"))
      reading.add(reading.place(keys.full("designation")),
                  fmt::format("{} is empty; leave it out", reading.as_written(keys.full("designation"))));
    if (keys.given("catalogue") && reading.usable({keys.full("designation")}))
      contradict(reading, keys.full("catalogue"), "has no effect without a designation; leave it out", {});
    return;
  }
  const auto catalogue          = own_catalogue(keys);
  const CatalogueBearing *entry = looked_up(keys, catalogue);
  if (!entry)
    return;
  take_sizes(b, keys, *entry);
  estimate(b, keys, *entry);
}

std::string estimated_lines(const RollerBearing &b)
{
  std::string text;
  for (const Field<RollerBearing> &row : bearing_rows())
    if (std::find(b.estimated.begin(), b.estimated.end(), row.key) != b.estimated.end())
      text += fmt::format("# {} = {} is estimated\n", row.key, toml_of(row_of(row), member_value(row, b)));
  return text;
}
}  // namespace mill
