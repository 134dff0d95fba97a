#include "core/base/short_number.h"
#include "core/base/units.h"
#include "core/case/estimates.h"
#include "core/case/provenance.h"
#include "core/case/stand_reader.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

// The rules of theory 34.3: sizes from the force that the backup roll's necks bear, masses from the volume that
// remains around neck and bearing.
namespace mill {
namespace {
constexpr double usual_calibration = 0.03;  // -, error of a measured mill modulus
// A value with the ends between which it is to be expected.
struct Spread {
  double usual = not_given, low = not_given, high = not_given;
};
Spread operator*(const double factor, const Spread &s)
{
  return {factor * s.usual, factor * s.low, factor * s.high};
}
Spread operator+(const double more, const Spread &s)
{
  return {more + s.usual, more + s.low, more + s.high};
}

Spread at_most(const double bound, const Spread &s)
{
  return {std::min(s.usual, bound), std::min(s.low, bound), std::min(s.high, bound)};
}

// Factors of the rules: usual, low, high.
constexpr Spread neck_of_barrel{0.60, 0.50, 0.70};    // neck diameter over barrel diameter
constexpr Spread work_neck_length{1.95, 1.4, 2.5};    // neck length over neck diameter, with the coupling end
constexpr Spread work_end{0.85, 0.5, 1.25};           // bearing centre to the end of the roll, over neck diameter
constexpr Spread backup_neck_length{1.2, 0.85, 1.6};  // neck length over neck diameter
constexpr Spread backup_end{0.75, 0.42, 1.05};        // bearing centre to the end of the roll, over neck diameter
constexpr Spread backup_seal{0.12, 0.03, 0.25};       // barrel end to bearing, over neck diameter
constexpr Spread work_seal{0.70, 0.30, 1.05};         // the same of a work roll, whose bearing lies in the window
constexpr Spread spans{0.97, 0.80, 1.06};             // bearing span of the work roll over that of the backup roll
constexpr Spread ring_filling{0.85, 0.70, 1.20};      // steel in the ring of a bearing, with spacers and seals
constexpr Spread ring_undrawn{0.80, 0.48, 1.40};      // the same where the ring is not drawn
constexpr Spread box_filling{1.05, 0.62, 1.80};       // steel in what remains of a chock's box, with its covers
constexpr double outside_of_bore = 1.33, width_of_bore = 0.75;  // of a bearing that is not drawn
constexpr double bearing_steel = 7850;                          // kg/m3
constexpr double neck_stress = 110e6, oil_pressure = 21e6, post_stress = 14e6, cell_stress = 60e6;  // Pa
constexpr Spread section_spread{1, 0.59, 1.72};  // of what goes with a section that is sized by stress

double round_area(const double diameter)
{
  return M_PI / 4 * diameter * diameter;
}

// Of screws with half their nuts and of pistons, both sides, as drawn or by the stiffness that is known.  m/N
double screwdown_softness(const FourHigh &stand, const double piston_stiffness)
{
  if (std::isfinite(piston_stiffness))
    return 1 / piston_stiffness;
  const Screwdown &s = stand.screwdown;
  const auto bar     = [&](const double length, const double diameter) {
    return std::isfinite(length) && std::isfinite(diameter)
                   ? length / (2 * stand.steel.youngs_modulus * round_area(diameter))
                   : 0;
  };
  return bar(s.screw_length, s.screw_diameter) + bar(0.5 * s.nut_height, s.screw_diameter) +
         bar(s.piston_length, s.piston_diameter);
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

  bool is_wanted(const std::string &key) const
  {
    return reading.usable({key}) && wishes.needless.count(key) == 0;
  }
  void list(const std::string &key, const char *unit_text, const Spread &s, const std::string &rule,
            const KeyList &from, const std::string &source = "")
  {
    stand.estimates.push_back({key, s.usual, s.low, s.high, unit_text, rule, from, source});
  }
  void add(const std::string &key, const char *unit_text, double &value, const Spread &s, const std::string &rule,
           const KeyList &from, const std::string &source = "")
  {
    if (!std::isnan(value) || !is_wanted(key) || std::isnan(s.usual))
      return;
    value = s.usual;
    list(key, unit_text, s, rule, from, source);
  }
  const RollerBearing *bearing_of(const Roll &roll) const
  {
    for (const RollerBearing &b : stand.bearings)
      if (b.name == roll.bearing)
        return &b;
    return nullptr;
  }
  const RollerBearing *drawn(const Roll &roll) const
  {
    const RollerBearing *b = bearing_of(roll);
    return b && std::isfinite(b->outside_diameter) && std::isfinite(b->width) && std::isfinite(b->bore) ? b
                                                                                                        : nullptr;
  }
  double bearing_width(const Roll &roll) const
  {
    const RollerBearing *b = drawn(roll);
    return b ? b->width : width_of_bore * roll.neck_diameter;
  }
  KeyList neck_keys(const std::string &section, const Roll &roll) const
  {
    const RollerBearing *b = drawn(roll);
    return b ? joined(KeyList{section + ".neck_diameter"}, KeyList{"bearing." + b->name + ".width"})
             : KeyList{section + ".neck_diameter"};
  }

  void neck_diameter(const std::string &section, Roll &roll);
  void backup_neck();
  void work_neck();
  void masses_on_neck(const std::string &section, Roll &roll);

  double design_force() const;
  double piston_diameter() const;
  double post_side() const;
  void posts_and_beams();
  void cylinder();
};

void Estimator::neck_diameter(const std::string &section, Roll &roll)
{
  if (const RollerBearing *b = drawn(roll))
    add(section + ".neck_diameter", "mm", roll.neck_diameter, b->bore * Spread{1, 0.95, 1.01},
        "the bore of its bearing (34.3)", {"bearing." + b->name + ".bore"});
  add(section + ".neck_diameter", "mm", roll.neck_diameter, roll.barrel_diameter * neck_of_barrel,
      "0.60 (0.50 .. 0.70) barrel diameters, rule of thumb (34.3)", {section + ".barrel_diameter"});
}

// The bearing lies close to the barrel; the neck ends behind it.
void Estimator::backup_neck()
{
  Roll &roll     = stand.backup_roll;
  const double d = roll.neck_diameter, B = bearing_width(roll), L = roll.barrel_length;
  const bool has_span = !std::isnan(roll.bearing_span);
  const KeyList from  = neck_keys("backup_roll", roll);
  if (has_span)
    add("backup_roll.neck_length", "mm", roll.neck_length, 0.5 * (roll.bearing_span - L) + d * backup_end,
        "from the bearing's centre 0.75 (0.42 .. 1.05) neck diameters to the end of the roll (34.4)",
        joined(from, keys_in("backup_roll", "barrel_length bearing_span")));
  add("backup_roll.neck_length", "mm", roll.neck_length, d * backup_neck_length,
      "1.2 (0.85 .. 1.6) neck diameters: bearing, seal and locking ring (34.4)", from);
  if (has_span || !is_wanted("backup_roll.bearing_span"))
    return;
  // A neck that is drawn bounds it: half the bearing stays on it.
  const double farthest = std::max(roll.neck_length - B / 2, B / 2);
  const auto lever      = [&](const double gap) { return std::min(B / 2 + gap * d, farthest); };
  const Spread a{lever(backup_seal.usual), lever(backup_seal.low), lever(backup_seal.high)};
  roll.bearing_span = L + 2 * a.usual;
  list("backup_roll.bearing_span", "mm", L + 2 * a,
       "the bearing 0.12 (0.03 .. 0.25) neck diameters from the barrel, for its seal (34.5)",
       joined(from, keys_in("backup_roll", "barrel_length neck_length")));
}

// Both rolls' bearings sit in one window; the end for the coupling sticks out.
void Estimator::work_neck()
{
  Roll &roll     = stand.work_roll;
  const double d = roll.neck_diameter, B = bearing_width(roll), L = roll.barrel_length;
  const KeyList from     = neck_keys("work_roll", roll);
  const bool estimated   = std::isnan(roll.bearing_span) && is_wanted("work_roll.bearing_span");
  const double of_backup = stand.backup_roll.bearing_span, least = L + B;
  const bool same_window = std::isfinite(of_backup) && spans.low * of_backup > least;
  if (estimated) {
    // Half the bearing stays on a neck that is drawn.
    const double farthest =
        std::isnan(roll.neck_length) ? INFINITY : L + 2 * std::max(roll.neck_length - B / 2, B / 2);
    const Spread s    = at_most(farthest, same_window ? of_backup * spans : L + B + 2 * d * work_seal);
    roll.bearing_span = s.usual;
    list("work_roll.bearing_span", "mm", s,
         same_window ? "0.97 (0.80 .. 1.06) of the backup roll's, in whose window it lies (34.5)"
                     : "the bearing 0.70 (0.30 .. 1.05) neck diameters from the barrel (34.5)",
         same_window ? KeyList{"backup_roll.bearing_span"} : joined(from, KeyList{"work_roll.barrel_length"}));
  }
  if (!std::isnan(roll.neck_length) || !is_wanted("work_roll.total_length"))
    return;
  const bool behind = std::isfinite(roll.bearing_span) && !estimated;
  const Spread neck = behind ? 0.5 * (roll.bearing_span - L) + d * work_end : d * work_neck_length;
  roll.neck_length  = neck.usual;
  list("work_roll.total_length", "mm", L + 2 * neck,
       behind ? "0.85 (0.5 .. 1.25) neck diameters behind the centre of each bearing, with the coupling end (34.4)"
              : "necks of 1.95 (1.4 .. 2.5) neck diameters, with the coupling end (34.4)",
       joined(from, keys_in("work_roll", behind ? "bearing_span" : "barrel_length")));
}

void Estimator::masses_on_neck(const std::string &section, Roll &roll)
{
  const bool work        = section == "work_roll";
  const RollerBearing *b = drawn(roll);
  const double d         = roll.neck_diameter;
  const double bore = b ? b->bore : d, D = b ? b->outside_diameter : outside_of_bore * d, B = bearing_width(roll);
  const KeyList of_ring =
      b ? keys_in("bearing." + b->name, "bore outside_diameter width") : keys_in(section, "neck_diameter");
  const double ring = round_area(D) - round_area(bore);
  add(section + ".bearing_mass", "kg", roll.bearing_mass,
      bearing_steel * ring * B * (b ? ring_filling : ring_undrawn),
      b ? "0.85 (0.70 .. 1.20) of the ring between bore and outside diameter (34.6)"
        : "0.80 (0.48 .. 1.40) of a ring of 1.33 neck diameters outside and 0.75 wide (34.6)",
      of_ring);

  const bool box = b && std::isfinite(b->chock_width) && !b->chock_assumed;
  // Narrower than the window; no higher than the axes of the rolls allow; as long as neck and bearing need.
  const double window =
      stand.housing.present() ? stand.housing.window_width - 0.02 : 1.07 * stand.backup_roll.barrel_diameter;
  const double room   = (work ? 0.97 : 0.95) * roll.barrel_diameter;
  const double w      = std::min(box ? b->chock_width : work ? 1.6 * D : window, window);
  const double h      = box ? b->chock_height : work ? std::min(1.25 * D, room) : room;
  const double lever  = 0.5 * (roll.bearing_span - roll.barrel_length);
  const double l      = std::max(std::min(lever + 0.8 * B, roll.neck_length), B);
  const double volume = w * h * l - round_area(D) * B - round_area(d) * (l - B);
  if (!(volume > 0))
    return;
  const std::string how = fmt::format("1.05 (0.62 .. 1.80) of the box of {:.2f} x {:.2f} x {:.2f} m less bearing "
                                      "and neck, times the density (34.7)",
                                      w, h, l);
  const KeyList of_box  = joined(
       of_ring, KeyList{"steel.density"}, keys_in(section, "barrel_length bearing_span neck_diameter"),
      box ? keys_in("bearing." + b->name, "chock_width chock_height") : keys_in(section, "barrel_diameter"));
  for (const auto &[key, mass] :
       {std::pair("chock_mass_upper", &roll.chock_mass_upper), {"chock_mass_lower", &roll.chock_mass_lower}})
    add(section + "." + key, "kg", *mass, stand.steel.density * volume * box_filling, how, of_box,
        "chock of the " + section);
}

void Estimator::rolls()
{
  const bool backup =
      wishes.backup_roll.estimate && reading.usable({"backup_roll.barrel_diameter", "backup_roll.barrel_length"});
  if (backup) {
    neck_diameter("backup_roll", stand.backup_roll);
    backup_neck();
    masses_on_neck("backup_roll", stand.backup_roll);
  }
  if (wishes.work_roll.estimate && reading.usable({"work_roll.barrel_diameter", "work_roll.barrel_length"})) {
    neck_diameter("work_roll", stand.work_roll);
    work_neck();
    masses_on_neck("work_roll", stand.work_roll);
  }
}

const KeyList force_keys_of_rolls = keys_in("backup_roll", "neck_diameter bearing_span barrel_length");

// Rolling force under which both necks of the backup roll reach their permissible bending stress.  N, (34.8)
double Estimator::design_force() const
{
  const Roll &b      = stand.backup_roll;
  const double lever = 0.5 * (b.bearing_span - b.barrel_length);
  return 2 * neck_stress * M_PI / 32 * std::pow(b.neck_diameter, 3) / lever;
}

double Estimator::piston_diameter() const
{
  const double given = stand.screwdown.piston_diameter;
  return std::isnan(given) ? std::sqrt(4 / M_PI * 0.5 * design_force() / oil_pressure) : given;
}

// Side of the square section of a post that carries a quarter of the force.
double Estimator::post_side() const
{
  return std::sqrt(0.25 * design_force() / post_stress);
}

// Stiffnesses of what lies between housing and bearings.
void Estimator::cylinder()
{
  Frame &f       = stand.frame;
  const double E = stand.steel.youngs_modulus, rho = stand.steel.density, d = piston_diameter(), A = round_area(d);
  const KeyList drawn        = keys_in("screwdown", "piston_diameter"),
                from         = std::isnan(stand.screwdown.piston_diameter) ? force_keys_of_rolls : drawn,
                with_E       = joined(from, KeyList{"steel.youngs_modulus"}),
                with_density = joined(from, KeyList{"steel.density"});
  const double neck          = stand.backup_roll.neck_diameter;
  const char *N              = "kN/mm";
  add("frame.piston_stiffness", N, f.piston_stiffness, 1.3 * E * d * Spread{1, 0.34, 3},
      "1.3 E times the piston's diameter, between a piston alone and one under a screw (34.10)", with_E);
  add("frame.oil_column_stiffness", N, f.oil_column_stiffness,
      2 * stand.screwdown.oil_modulus * A / 0.075 * Spread{1, 0.58, 1.70},
      "oil 75 (44 .. 130) mm high under both pistons (34.10)", from);
  add("frame.cylinder_body_stiffness", N, f.cylinder_body_stiffness, 0.92 * E * d * section_spread,
      "0.92 (0.54 .. 1.58) E times the piston's diameter (34.10)", with_E);
  add("frame.upper_packing_stiffness", N, f.upper_packing_stiffness, 2.7e11 * 2 * d * d * section_spread,
      "joints of 270 (160 .. 460) kN/mm per 1000 mm2 under both pistons' squares (34.10)", from);
  add("frame.lower_packing_stiffness", N, f.lower_packing_stiffness, 1.8e11 * 2 * d * d * section_spread,
      "the same with one joint more, 180 (106 .. 310) (34.10)", from);
  for (const auto &[key, value] : {std::pair("upper_chock_stiffness", &f.upper_chock_stiffness),
                                   std::pair("lower_chock_stiffness", &f.lower_chock_stiffness)})
    add(std::string("frame.") + key, N, *value, 0.36 * 2 * E * neck * section_spread,
        "0.36 (0.21 .. 0.62) E times the diameter of both necks (34.10)", keys_in("backup_roll", "neck_diameter"));
  const double piston = std::isnan(stand.screwdown.piston_length) ? 0.28 * d : stand.screwdown.piston_length;
  add("frame.piston_mass", "kg", f.piston_mass, 0.55 * 2 * rho * A * piston * section_spread,
      "0.55 (0.32 .. 0.95) of two solid pistons: they are hollow (34.10)", with_density);
  add("frame.cylinder_mass", "kg", f.cylinder_mass, 1.25 * rho * A * d * section_spread,
      "a wall of 0.2 piston diameters, 0.8 high, and its bottom (34.10)", with_density);
  for (const auto &[key, value] : {std::pair("upper_packing_mass", &f.upper_packing_mass),
                                   std::pair("lower_packing_mass", &f.lower_packing_mass)})
    add(std::string("frame.") + key, "kg", *value, 2 * rho * d * d * 0.046 * d * section_spread,
        "plates of 0.046 (0.027 .. 0.079) piston diameters under both pistons' squares (34.10)", with_density);
  const Screwdown &s = stand.screwdown;
  const bool cell    = std::isfinite(s.load_cell_diameter) && std::isfinite(s.load_cell_height);
  const double area  = cell ? round_area(s.load_cell_diameter) - round_area(s.load_cell_bore)
                            : 0.5 * design_force() / cell_stress,
               high  = cell ? s.load_cell_height : 0.23 * std::sqrt(4 / M_PI * area);
  add("frame.load_cell_mass", "kg", f.load_cell_mass, 0.55 * 2 * rho * area * high * section_spread,
      "0.55 (0.32 .. 0.95) of both load cells: the half that moves, with its cover (34.10)",
      joined(cell ? keys_in("screwdown", "load_cell_diameter load_cell_height") : force_keys_of_rolls,
             KeyList{"steel.density"}));
  const Roll &b = stand.backup_roll;
  const double roll =
      rho * (round_area(b.barrel_diameter) * b.barrel_length + 2 * round_area(neck) * b.neck_length);
  add("frame.balance_mass", "kg", f.balance_mass, 0.26 * roll * section_spread,
      "0.26 (0.15 .. 0.45) of the backup roll that it carries (34.10)",
      joined(keys_in("backup_roll", "barrel_diameter barrel_length neck_diameter neck_length"),
             KeyList{"steel.density"}));
}

// Both housings as square sections sized by stress, with their masses at screw and seat.
void Estimator::posts_and_beams()
{
  Frame &f       = stand.frame;
  const double E = stand.steel.youngs_modulus, G = E / (2 * (1 + stand.steel.poisson_ratio)),
               rho = stand.steel.density;
  const double a = post_side(), A = a * a,
               H       = 3.0 * (stand.work_roll.barrel_diameter + stand.backup_roll.barrel_diameter),
               l       = 1.1 * stand.backup_roll.barrel_diameter + a;  // window and the posts' middles
  const double bending = l * l * l / (E * a * std::pow(2 * a, 3) / 12), shear = 1.2 * l / (4 * G * 2 * A);
  const double above = 0.86 * H, below = 0.14 * H + a;  // of the feet; below with half the beam
  // Two housings; the lower corners turn with the feet, the upper ones are held by long posts.
  double C[4] = {above / (4 * E * A), (bending / 96 + shear) / 2, below / (4 * E * A), (bending / 48 + shear) / 2};
  double more = 1;
  if (const double known = stand.housing.stiffness; !std::isnan(known))
    more = 1 / (2 * known) / (C[0] + C[1] + C[2] + C[3]);
  const KeyList from =
      joined(force_keys_of_rolls, keys_in("work_roll", "barrel_diameter"),
             keys_in("backup_roll", "barrel_diameter"), keys_in("steel", "youngs_modulus poisson_ratio"),
             std::isnan(stand.housing.stiffness) ? KeyList{} : KeyList{"housing.stiffness"});
  const std::string how =
      std::isnan(stand.housing.stiffness)
          ? fmt::format("square posts of {} m2, under 14 MPa at the force that the necks bear (34.9)",
                        short_number(A, 3))
          : fmt::format("share of housing.stiffness in the proportion of square posts of {} m2 (34.9)",
                        short_number(A, 3));
  const std::pair<const char *, double Frame::*> springs[] = {
      {"upper_post_stiffness", &Frame::upper_post_stiffness},
      {"upper_beam_stiffness", &Frame::upper_beam_stiffness},
      {"lower_post_stiffness", &Frame::lower_post_stiffness},
      {"lower_beam_stiffness", &Frame::lower_beam_stiffness}};
  for (std::size_t i = 0; i < 4; ++i)
    add(std::string("frame.") + springs[i].first, "kN/mm", f.*springs[i].second,
        1 / (more * C[i]) * section_spread, how, from, "section of the posts");

  // Kinetic energy at the chain's point, behind piston and packing: that point moves more than screw and seat.
  const auto softness = [](const double K) { return std::isfinite(K) && K > 0 ? 1 / K : 0; };
  const double screw  = softness(f.upper_post_stiffness) + softness(f.upper_beam_stiffness),
               seat   = softness(f.lower_post_stiffness) + softness(f.lower_beam_stiffness);
  const double upper = screw + softness(f.upper_packing_stiffness) + screwdown_softness(stand, f.piston_stiffness),
               lower = seat + softness(f.lower_packing_stiffness);
  const double at_M1 = std::pow(screw / upper, 2), at_M6 = std::pow(seat / lower, 2);
  const double beams = 2 * rho * 2 * A * (l + a), share = 4 * rho * A;
  struct Part {
    const char *key;
    double &mass;
    double value;
    const char *rule;
  };
  const Part parts[] = {
      {"upper_post_mass", f.upper_post_mass, 0.49 * share * above * at_M1, "0.49 of the posts above their feet"},
      {"upper_beam_mass", f.upper_beam_mass, 0.48 * beams * at_M1, "0.48 of the upper beams"},
      {"lower_post_mass", f.lower_post_mass, 0.46 * share * (below - a) * at_M6,
       "0.46 of the posts below their feet"},
      {"lower_beam_mass", f.lower_beam_mass, 0.38 * beams * at_M6, "0.38 of the lower beams"}};
  for (const Part &part : parts)
    add(std::string("frame.") + part.key, "kg", part.mass, part.value * section_spread,
        std::string(part.rule) + ", at the point of M1 or M6 (34.9)", joined(from, KeyList{"steel.density"}),
        "section of the posts");
}

void Estimator::frame()
{
  if (!wishes.frame.estimate)
    return;
  Frame &f             = stand.frame;
  const double M       = wishes.frame.modulus;
  const auto is_usable = [&](const char *key) { return reading.usable({key}); };
  if (!is_usable("work_roll.barrel_diameter") || !is_usable("backup_roll.barrel_diameter") ||
      !is_usable("frame.modulus") || !is_usable("backup_roll.neck_diameter") ||
      !is_usable("backup_roll.bearing_span"))
    return;
  const std::size_t first = stand.estimates.size();
  cylinder();
  posts_and_beams();
  const bool housing_known = !std::isnan(stand.housing.stiffness);
  for (std::size_t i = first; i < stand.estimates.size(); ++i) {
    const Estimate &e     = stand.estimates[i];
    const std::string key = e.key.substr(std::string("frame.").size());
    f.tolerance[key]      = half_width(e);
    f.source[key]         = e.source.empty() ? e.key : e.source;
    const bool of_housing = key.find("_post_") != std::string::npos || key.find("_beam_") != std::string::npos;
    if (e.unit == "kN/mm" && !(housing_known && of_housing))
      f.closing.insert(key);
  }
  for (const Field<Frame> &row : frame_rows()) {
    const std::string key = std::string("frame.") + row.key;
    if (row.fallback.kind == Fallback::Kind::required && is_wanted(key) &&
        std::isnan(f.*std::get<double Frame::*>(row.member)))
      reading.add(reading.place("frame.estimate"),
                  fmt::format("frame.estimate = true finds no {}: what it is estimated from is not known; add for "
                              "example {} = {}",
                              row.key, row.key, example_toml(row_of(row))));
  }
  f.modulus = M;
  f.modulus_error =
      std::isnan(wishes.frame.modulus_tolerance) ? usual_calibration : wishes.frame.modulus_tolerance;
  f.modulus_place = reading.place("frame.modulus");
  if (!std::isnan(M) && f.closing.empty())
    contradict(
        reading, "frame.modulus",
        "has no effect: every stiffness of the frame is given or drawn; leave out those that are least known", {});
}
}  // namespace

void estimate_stand(FourHigh &stand, const EstimateWishes &wishes, Reading &reading)
{
  Estimator estimator(stand, wishes, reading);
  estimator.rolls();
  estimator.frame();
}
}  // namespace mill
