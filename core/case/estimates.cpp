#include "core/case/estimates.h"
#include "core/base/units.h"
#include "core/case/provenance.h"
#include "core/case/stand_reader.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
// A factor of a rule with the ends between which it is usually found.
struct Rule {
  double usual, low, high;  // -
};
constexpr Rule neck_of_barrel{0.60, 0.50, 0.70};     // neck diameter over barrel diameter
constexpr Rule work_neck_length{1.6, 1.2, 2.0};      // neck length over neck diameter, with the coupling end
constexpr Rule backup_neck_length{1.0, 0.8, 1.2};    // the same
constexpr Rule seat_on_neck{0.60, 0.50, 0.70};       // barrel end to bearing centre, over neck length
constexpr Rule bearing_outside{1.40, 1.33, 1.50};    // outside over bore, four rows
constexpr Rule bearing_width{0.90, 0.70, 1.10};      // width over bore
constexpr Rule bearing_filling{0.85, 0.75, 0.95};    // steel in the ring between bore and outside diameter
constexpr Rule chock_filling{0.80, 0.75, 0.85};      // steel in the box less the bore
constexpr double box_width = 1.7, box_height = 1.6;  // of a chock over the outside diameter, as in [bearing.*]
constexpr double box_unknown   = 0.35;               // relative, of a chock's mass whose box is not drawn
constexpr double bearing_steel = 7850;               // kg/m3
constexpr Rule window_of_rolls{3.0, 2.5, 3.5};       // window height over the sum of both diameters

// Shares of 1/M, the whole compliance of the stand with strip, rule of thumb; see theory 34.3.
struct FrameShare {
  const char *key;
  double Frame::*member;
  Rule share;
};
constexpr FrameShare frame_shares[] = {
    {"upper_post_stiffness", &Frame::upper_post_stiffness, {0.040, 0.020, 0.060}},
    {"upper_beam_stiffness", &Frame::upper_beam_stiffness, {0.120, 0.060, 0.180}},
    {"piston_stiffness", &Frame::piston_stiffness, {0.020, 0.005, 0.040}},
    {"upper_packing_stiffness", &Frame::upper_packing_stiffness, {0.010, 0.003, 0.020}},
    {"oil_column_stiffness", &Frame::oil_column_stiffness, {0.080, 0.030, 0.130}},
    {"cylinder_body_stiffness", &Frame::cylinder_body_stiffness, {0.010, 0.003, 0.020}},
    {"upper_chock_stiffness", &Frame::upper_chock_stiffness, {0.020, 0.010, 0.040}},
    {"lower_chock_stiffness", &Frame::lower_chock_stiffness, {0.020, 0.010, 0.040}},
    {"lower_post_stiffness", &Frame::lower_post_stiffness, {0.040, 0.020, 0.060}},
    {"lower_beam_stiffness", &Frame::lower_beam_stiffness, {0.120, 0.060, 0.180}},
    {"lower_packing_stiffness", &Frame::lower_packing_stiffness, {0.010, 0.003, 0.020}},
};

// Shares of the mass of one backup roll, rule of thumb.
struct MassShare {
  const char *key;
  double Frame::*member;
  Rule share;
};
constexpr MassShare mass_shares[] = {
    {"upper_packing_mass", &Frame::upper_packing_mass, {0.015, 0.005, 0.030}},
    {"piston_mass", &Frame::piston_mass, {0.040, 0.010, 0.080}},
    {"cylinder_mass", &Frame::cylinder_mass, {0.120, 0.050, 0.250}},
    {"balance_mass", &Frame::balance_mass, {0.150, 0.050, 0.300}},
    {"load_cell_mass", &Frame::load_cell_mass, {0.010, 0.004, 0.020}},
    {"lower_packing_mass", &Frame::lower_packing_mass, {0.015, 0.005, 0.030}},
};
constexpr Rule beam_of_posts{0.50, 0.30, 0.80};  // reduced mass of a beam over that of its posts

double round_area(const double diameter)
{
  return M_PI / 4 * diameter * diameter;
}

class Estimator {
public:
  Estimator(FourHigh &four_high, const EstimateWishes &asked, Reading &r)
      : stand(four_high), wishes(asked), reading(r)
  {
  }

  void rolls();
  void frame();

private:
  FourHigh &stand;
  const EstimateWishes &wishes;
  Reading &reading;

  // One value: base times a rule.
  void add(const std::string &key, const char *unit_text, double &value, const double base, const Rule &rule,
           const std::string &description, const std::vector<std::string> &from)
  {
    if (!std::isnan(value) || !is_wanted(key) || std::isnan(base))
      return;
    value = base * rule.usual;
    stand.estimates.push_back({key, value, base * rule.low, base * rule.high, unit_text, description, from});
  }
  bool is_wanted(const std::string &key) const
  {
    return reading.usable({key}) && wishes.needless.count(key) == 0;
  }
  const RollerBearing *drawn(const Roll &roll) const
  {
    for (const RollerBearing &b : stand.bearings)
      if (b.name == roll.bearing && std::isfinite(b.outside_diameter) && std::isfinite(b.width) &&
          std::isfinite(b.bore))
        return &b;
    return nullptr;
  }
  void neck(const std::string &section, Roll &roll, const Rule &length);
  void masses_on_neck(const std::string &section, Roll &roll);
  void posts_and_beams(double E, double density);
};

void Estimator::neck(const std::string &section, Roll &roll, const Rule &length)
{
  const RollerBearing *bearing = drawn(roll);
  if (bearing)
    add(section + ".neck_diameter", "mm", roll.neck_diameter, bearing->bore, {1, 0.95, 1},
        "the bore of its bearing (34.3)", {"bearing." + bearing->name + ".bore"});
  add(section + ".neck_diameter", "mm", roll.neck_diameter, roll.barrel_diameter, neck_of_barrel,
      "0.60 (0.50 .. 0.70) barrel diameters, rule of thumb (34.3)", {section + ".barrel_diameter"});
  const std::string long_key = section + (section == "work_roll" ? ".total_length" : ".neck_length");
  if (std::isnan(roll.neck_length) && is_wanted(long_key)) {
    const bool work = section == "work_roll";
    const double d = roll.neck_diameter, L = work ? roll.barrel_length : 0, sides = work ? 2 : 1;
    roll.neck_length = length.usual * d;
    stand.estimates.push_back(
        {long_key,
         L + sides * length.usual * d,
         L + sides * length.low * d,
         L + sides * length.high * d,
         "mm",
         fmt::format("necks of {:.2g} ({:.2g} .. {:.2g}) neck diameters, rule of thumb (34.4)", length.usual,
                     length.low, length.high),
         {section + ".barrel_length", section + ".neck_diameter"}});
  }
  if (std::isnan(roll.bearing_span) && reading.usable({section + ".bearing_span"})) {
    const double least = bearing ? bearing->width / 2 : 0;
    const auto span    = [&](const double part) {
      return roll.barrel_length + 2 * std::max(part * roll.neck_length, least);
    };
    roll.bearing_span = span(seat_on_neck.usual);
    stand.estimates.push_back(
        {section + ".bearing_span",
         roll.bearing_span,
         span(seat_on_neck.low),
         span(seat_on_neck.high),
         "mm",
         "bearing centres 0.60 (0.50 .. 0.70) of the neck from the barrel, rule of thumb (34.5)",
         {section + ".barrel_length", section + (section == "work_roll" ? ".total_length" : ".neck_length")}});
  }
}

void Estimator::masses_on_neck(const std::string &section, Roll &roll)
{
  const RollerBearing *b = drawn(roll);
  const double d = b ? b->bore : roll.neck_diameter, D = b ? b->outside_diameter : bearing_outside.usual * d,
               B = b ? b->width : bearing_width.usual * d;
  const KeyList of_ring =
      b ? keys_in("bearing." + b->name, "bore outside_diameter width") : keys_in(section, "neck_diameter");
  const double ring = bearing_steel * (round_area(D) - round_area(d)) * B;
  // Without its drawing the section of the ring goes with the square of the outside diameter and with the width.
  const auto wider = [&](const Rule &rule, const double more) {
    return b ? rule : Rule{rule.usual, rule.low * (1 - more), rule.high * (1 + more)};
  };
  add(section + ".bearing_mass", "kg", roll.bearing_mass, ring, wider(bearing_filling, 0.4),
      b ? "0.85 (0.75 .. 0.95) of the ring between bore and outside diameter (34.6)"
        : "0.85 of a ring of 1.4 neck diameters outside and 0.9 wide, rule of thumb (34.6)",
      of_ring);
  const bool box = b && std::isfinite(b->chock_width) && !b->chock_assumed;
  const double w = box ? b->chock_width : box_width * D, h = box ? b->chock_height : box_height * D,
               l      = box ? b->chock_length : B;
  const double volume = w * h * l - round_area(D) * l;
  const Rule filling  = box ? chock_filling
                            : Rule{chock_filling.usual, chock_filling.low * (1 - box_unknown),
                                  chock_filling.high * (1 + box_unknown)};
  const std::string how =
      box ? "0.80 (0.75 .. 0.85) of its box less the bore, times the density (34.7)"
          : "0.80 of a box of 1.7 x 1.6 outside diameters of the bearing less the bore, rule of thumb (34.7)";
  const KeyList of_box =
      joined(of_ring, KeyList{"steel.density"},
             box ? keys_in("bearing." + b->name, "chock_width chock_height chock_length") : KeyList{});
  add(section + ".chock_mass_upper", "kg", roll.chock_mass_upper, stand.steel.density * volume, filling, how,
      of_box);
  add(section + ".chock_mass_lower", "kg", roll.chock_mass_lower, stand.steel.density * volume, filling, how,
      of_box);
}

void Estimator::rolls()
{
  if (wishes.work_roll.estimate && reading.usable({"work_roll.barrel_diameter", "work_roll.barrel_length"})) {
    neck("work_roll", stand.work_roll, work_neck_length);
    masses_on_neck("work_roll", stand.work_roll);
  }
  if (wishes.backup_roll.estimate &&
      reading.usable({"backup_roll.barrel_diameter", "backup_roll.barrel_length"})) {
    neck("backup_roll", stand.backup_roll, backup_neck_length);
    masses_on_neck("backup_roll", stand.backup_roll);
  }
}

// The section that gives the posts their stiffness has the mass of the posts.
void Estimator::posts_and_beams(const double E, const double density)
{
  Frame &f       = stand.frame;
  const double H = window_of_rolls.usual * (stand.work_roll.barrel_diameter + stand.backup_roll.barrel_diameter);
  const std::string description =
      "a third of posts whose section has the stiffness of the posts over a window of 3.0 (2.5 .. "
      "3.5) times both diameters (34.9)";
  for (const auto &[post, stiffness, beam, post_key, beam_key] :
       {std::tuple(&f.upper_post_mass, f.upper_post_stiffness, &f.upper_beam_mass, "upper_post_mass",
                   "upper_beam_mass"),
        std::tuple(&f.lower_post_mass, f.lower_post_stiffness, &f.lower_beam_mass, "lower_post_mass",
                   "lower_beam_mass")}) {
    const std::string stiffness_key = std::string(post_key).substr(0, 10) + "_stiffness";
    const double area               = stiffness * H / (8 * E);  // four posts, half the height
    const double mass               = density * 4 * area * H / 2 / 3;
    const KeyList from =
        joined(KeyList{"frame." + stiffness_key}, keys_in("work_roll", "barrel_diameter"),
               keys_in("backup_roll", "barrel_diameter"), keys_in("steel", "youngs_modulus density"));
    add(std::string("frame.") + post_key, "kg", *post, mass, {1, 0.35, 2.0}, description, from);
    add(std::string("frame.") + beam_key, "kg", *beam, mass,
        {beam_of_posts.usual, 0.35 * beam_of_posts.low, 2 * beam_of_posts.high},
        "half of its posts, rule of thumb (34.9)", from);
  }
}

void Estimator::frame()
{
  const double M = wishes.frame.modulus;
  if (!wishes.frame.estimate)
    return;
  Frame &f   = stand.frame;
  bool lacks = false;
  for (const FrameShare &part : frame_shares) {
    const std::string key = std::string("frame.") + part.key;
    if (!std::isnan(f.*part.member) || !is_wanted(key))
      continue;
    lacks = lacks || std::isnan(M);
    f.closing.insert(part.key);
    // A share of the compliance: the larger it is the softer the part.
    add(key, "kN/mm", f.*part.member, M, {1 / part.share.usual, 1 / part.share.high, 1 / part.share.low},
        fmt::format("{:.2g} % ({:.2g} .. {:.2g}) of the stand's compliance, rule of thumb (34.8)",
                    100 * part.share.usual, 100 * part.share.low, 100 * part.share.high),
        {"frame.modulus"});
  }
  if (lacks && reading.usable({"frame.modulus"})) {
    reading.add(
        reading.place("frame.estimate"),
        "frame.estimate = true estimates stiffnesses from the modulus of the stand; add for example modulus = "
        "\"5 MN/mm\", of a calibration with touching rolls or of a stand of this type");
    reading.bad.insert("frame.modulus");
    return;
  }
  if (!reading.usable({"work_roll.barrel_diameter", "backup_roll.barrel_diameter", "frame.modulus"}))
    return;
  posts_and_beams(stand.steel.youngs_modulus, stand.steel.density);
  const Roll &b     = stand.backup_roll;
  const double roll = stand.steel.density * (round_area(b.barrel_diameter) * b.barrel_length +
                                             2 * round_area(b.neck_diameter) * b.neck_length);
  for (const MassShare &part : mass_shares)
    add(std::string("frame.") + part.key, "kg", f.*part.member, roll, part.share,
        fmt::format("{:.2g} % ({:.2g} .. {:.2g}) of the mass of a backup roll, rule of thumb (34.10)",
                    100 * part.share.usual, 100 * part.share.low, 100 * part.share.high),
        joined(keys_in("backup_roll", "barrel_diameter barrel_length neck_diameter neck_length"),
               KeyList{"steel.density"}));
  for (const Field<Frame> &row : frame_rows()) {
    const std::string key = std::string("frame.") + row.key;
    if (row.fallback.kind == Fallback::Kind::required && is_wanted(key) &&
        std::isnan(f.*std::get<double Frame::*>(row.member)))
      reading.add(
          reading.place("frame.estimate"),
          fmt::format("frame.estimate = true finds no {}: the stiffness it is estimated from is not known; add "
                      "for example {} = {}",
                      row.key, row.key, example_toml(row_of(row))));
  }
  f.modulus       = M;
  f.modulus_error = wishes.frame.modulus_tolerance;
  f.modulus_place = reading.place("frame.modulus");
  if (!std::isnan(M) && f.closing.empty())
    contradict(
        reading, "frame.modulus",
        "has no effect: every stiffness of the frame is given or drawn; leave out those that are least known", {});
  for (const Estimate &e : stand.estimates)
    if (e.key.rfind("frame.", 0) == 0)
      f.tolerance[e.key.substr(6)] = half_width(e);
}
}  // namespace

const std::vector<Field<EstimateInput>> &estimate_rows()
{
  using T = EstimateInput;
  static const std::vector<Field<T>> rows{
      {"estimate", &T::estimate, "flag", any, 0, "true",
       "what is left out of this section is estimated by rules, marked in every result that depends on it, and "
       "included in the error estimate"},
      {"modulus",
       &T::modulus,
       "MN/mm",
       {0.5, 50},
       absent,
       "5 MN/mm",
       "slope of force over screw position with touching work rolls, of the whole stand: what rolls, contacts and "
       "bearings leave of it is shared by the parts of the frame that estimate = true finds"},
      {"modulus_tolerance",
       &T::modulus_tolerance,
       "%",
       {0.1, 50},
       3,
       "3 %",
       "how far the modulus may be off, of its value: the error of its calibration"},
  };
  return rows;
}

std::vector<Field<EstimateInput>> roll_estimate_rows()
{
  return {estimate_rows().front()};
}

const std::vector<std::string> &estimable_keys(const std::string &section)
{
  static const std::vector<std::string> frame = [] {
    std::vector<std::string> keys;
    for (const Field<Frame> &row : frame_rows())
      keys.push_back(row.key);
    return keys;
  }();
  static const std::vector<std::string> roll{"neck_diameter",   "total_length", "neck_length",
                                             "bearing_span",    "bearing_mass", "chock_mass_upper",
                                             "chock_mass_lower"};
  static const std::vector<std::string> none;
  return section == "frame" ? frame : section == "work_roll" || section == "backup_roll" ? roll : none;
}

EstimateInput read_estimate(const Section &section, const std::vector<Field<EstimateInput>> &rows,
                            Reading &reading)
{
  EstimateInput wish;
  if (!section.node)
    return wish;
  for (const Field<EstimateInput> &field : rows)
    if (const auto value = read_row(row_of(field), section, reading))
      set_member(field, *value, wish);
  if (reading.places.count(section.key("modulus")) && !wish.estimate)
    contradict(reading, section.key("modulus"), "has no effect without estimate = true", {});
  if (reading.places.count(section.key("modulus_tolerance")) && std::isnan(wish.modulus))
    contradict(reading, section.key("modulus_tolerance"),
               "belongs to " + section.key("modulus") + ", which is not given; give both or neither", {});
  return wish;
}

void estimate_stand(FourHigh &stand, const EstimateWishes &wishes, Reading &reading)
{
  Estimator estimator(stand, wishes, reading);
  estimator.rolls();
  estimator.frame();
}

void set_estimated(FourHigh &stand, const std::string &key, const double value)
{
  const auto dot            = key.find('.');
  const std::string section = key.substr(0, dot), name = key.substr(dot + 1);
  if (section == "frame") {
    for (const Field<Frame> &row : frame_rows())
      if (name == row.key)
        set_member(row, Value(value), stand.frame);
    return;
  }
  Roll &roll = section == "work_roll" ? stand.work_roll : stand.backup_roll;
  if (name == "total_length")
    roll.neck_length = (value - roll.barrel_length) / 2;
  for (const Field<Roll> &row : backup_roll_rows())
    if (name == row.key)
      set_member(row, Value(value), roll);
}

std::string estimate_lines(const Estimates &estimates)
{
  std::string text = estimates.empty() ? "" : "\n# Estimated, since their sections say estimate = true:\n";
  for (const Estimate &e : estimates)
    text += fmt::format("# {} = {:.4g} {} ({:.4g} .. {:.4g}): {}\n", e.key, from_si(e.value, unit(e.unit)), e.unit,
                        from_si(e.low, unit(e.unit)), from_si(e.high, unit(e.unit)), e.rule);
  return text;
}
}  // namespace mill
