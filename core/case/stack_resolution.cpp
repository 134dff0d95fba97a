#include "core/case/stack_resolution.h"
#include "core/case/stack_half.h"
#include "core/case/stand_reader.h"
#include "core/model/stack_statics.h"
#include "core/records/stack_names.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace mill {
namespace {
constexpr double rigid           = 1e15;  // N/m, a bearing without stiffness
constexpr double least_overlap   = 0.1;   // of the shorter barrel
constexpr double overlap_allowed = 1e-6;  // m, rounding of drawings

// Where a roll comes from: its place in the input, and whether it is made of an upper one.
struct Origin {
  std::size_t roll;
  double sign;  // +1: upper half
  bool made;
};

std::vector<StackSection> shaft_of(const StackRollInput &roll)
{
  const double barrel = roll.barrel_length / 2;
  if (roll.saddles.given)
    return {{-barrel, barrel, roll.saddles.shaft_diameter}};
  std::vector<StackSection> sections;
  for (const auto &[from, to, diameter] : roll.shaft)
    sections.push_back({from, to, diameter});
  if (!sections.empty())
    return sections;
  if (!std::isnan(roll.neck_diameter)) {
    const double end = roll.total_length / 2;
    return {{-end, -barrel, roll.neck_diameter},
            {-barrel, barrel, roll.barrel_diameter},
            {barrel, end, roll.neck_diameter}};
  }
  return {{-barrel, barrel, roll.barrel_diameter}};
}

std::vector<StackSupport> supports_of(const StackRollInput &roll, const Origin &origin, const bool inclined)
{
  std::vector<StackSupport> supports;
  if (roll.saddles.given) {
    const StackSaddles &saddles = roll.saddles;
    for (std::size_t i = 0; i < saddles.positions.size(); ++i) {
      const double k      = saddles.stiffness[saddles.stiffness.size() == 1 ? 0 : i];
      const double motion = saddles.eccentric.empty() || origin.made ? 0 : -origin.sign * saddles.eccentric[i];
      supports.push_back({saddles.positions[i], {k, k}, {0, motion}});
    }
  } else if (roll.on.empty()) {
    const auto of_half = [&](const std::vector<double> &given, const double absent_one) {
      return given.empty() ? absent_one : given[origin.made && given.size() > 1 ? 1 : 0];
    };
    const double k = of_half(roll.bearing_stiffness, rigid);  // with a bearing of the case until that is solved
    for (const double side : {-0.5, 0.5})
      supports.push_back({side * roll.bearing_span,
                          {inclined ? k : 0, k},
                          {0, 0},
                          roll.bearing,
                          of_half(roll.housing_stiffness, not_given)});
  }
  return supports;
}

// Bending on the drive and the operator side of the mill, away from the strip; a force of zero too, so that its
// influence is known.
std::vector<StackLoad> loads_of(const StackRollInput &roll, const Origin &origin, const double shift,
                                const bool in_window)
{
  const bool bent = roll.bending_force[0] != 0 || roll.bending_force[1] != 0;
  if (std::isnan(roll.bearing_span) || (roll.on.empty() && !bent))
    return {};
  const double from_chock = in_window ? -shift : 0;
  return {{roll.bearing_span / 2 + from_chock, {0, origin.sign * roll.bending_force[0]}},
          {-roll.bearing_span / 2 + from_chock, {0, origin.sign * roll.bending_force[1]}}};
}

// End for end about its own middle; loads stay on their side of the mill.
void turn(StackRoll &roll)
{
  roll.turned = true;
  for (StackSection &section : roll.sections)
    section = {-section.to, -section.from, section.diameter};
  std::reverse(roll.sections.begin(), roll.sections.end());
  for (StackSupport &support : roll.supports)
    support.z *= -1;
}

Material material_of(const StackInput &input, const StackRollInput &roll)
{
  for (const StackMaterial &material : input.materials)
    if (material.name == roll.material)
      return material;
  return input.steel;
}

StackRoll resolved_roll(const StackInput &input, const Origin &origin, const std::array<double, 2> &axis,
                        const bool inclined)
{
  const StackRollInput &roll = input.rolls[origin.roll];
  const bool turned          = origin.made && input.settings.lower == LowerHalf::turned;
  StackRoll result;
  result.name     = origin.made ? made_roll_name(roll.name) : roll.name;
  result.made_of  = origin.made ? roll.name : "";
  result.diameter = roll.barrel_diameter;
  result.length   = roll.barrel_length;
  result.axis     = {axis[0], origin.made ? -axis[1] : axis[1]};
  result.shift    = turned ? -roll.axial_shift : roll.axial_shift;
  result.sections = shaft_of(roll);
  result.supports = supports_of(roll, origin, inclined);
  if (const auto &mass = roll.chock_mass; !mass.empty())
    for (const double side : {-0.5, 0.5})
      result.lumps.push_back({side * roll.bearing_span, mass[origin.made && mass.size() > 1 ? 1 : 0]});
  result.profile  = roll;
  result.material = material_of(input, roll);
  if (turned)
    turn(result);
  result.loads = loads_of(roll, origin, result.shift, input.settings.bending_at == BendingAt::window);
  return result;
}

StackStrip resolved_strip(const StackStripInput &written, const double roll_radius, const Material &roll)
{
  StackStrip strip      = written;
  const auto or_zero    = [](const double value) { return std::isnan(value) ? 0 : value; };
  strip.force           = or_zero(written.given_force);
  strip.modulus         = written.law == StackStripLaw::uniform ? 0 : or_zero(written.modulus);
  strip.entry_modulus   = written.law == StackStripLaw::uniform ? 0
                          : std::isnan(written.entry_modulus)   ? strip.modulus
                                                                : written.entry_modulus;
  strip.entry_thickness = or_zero(written.entry_thickness);
  strip.exit_thickness  = or_zero(written.exit_thickness);
  if (std::isnan(written.arc)) {  // Hitchcock's radius
    const double draft = written.entry_thickness - written.exit_thickness;
    const double c     = 16 * (1 - roll.poisson_ratio * roll.poisson_ratio) / (M_PI * roll.youngs_modulus);
    strip.arc          = std::sqrt(roll_radius * (draft + c * strip.force / strip.width));
  }
  return strip;
}

bool do_touch(const Stack &stack, const std::size_t a, const std::size_t b)
{
  return std::any_of(stack.contacts.begin(), stack.contacts.end(), [&](const StackContact &contact) {
    return (contact.a == a && contact.b == b) || (contact.a == b && contact.b == a);
  });
}

void check_overlap(const Stack &stack, const std::vector<Origin> &origins, Reading &reading)
{
  for (std::size_t a = 0; a < stack.rolls.size(); ++a)
    for (std::size_t b = a + 1; b < stack.rolls.size(); ++b) {
      const StackRoll &one = stack.rolls[a], &other = stack.rolls[b];
      const double distance = std::hypot(one.axis[0] - other.axis[0], one.axis[1] - other.axis[1]);
      const double touching = (one.diameter + other.diameter) / 2;
      // What is seen in the upper half is not said again of the one that is made of it.
      if (do_touch(stack, a, b) || distance >= touching - overlap_allowed || (origins[a].made && origins[b].made))
        continue;
      reading.add(
          reading.place(roll_key(origins[a].roll, "barrel_diameter")),
          fmt::format("rolls {} and {} overlap: their axes are {} apart and their radii sum to {}; move one "
                      "of them or change a diameter",
                      one.name, other.name, millimetres(distance), millimetres(touching)),
          {reading.place(roll_key(origins[b].roll, "barrel_diameter"))});
      return;  // others follow from it
    }
}

void check_barrels(const Stack &stack, const std::vector<Origin> &origins, Reading &reading)
{
  for (const StackContact &contact : stack.contacts) {
    const StackRoll &a = stack.rolls[contact.a], &b = stack.rolls[contact.b];
    const double from    = std::max(a.shift - a.length / 2, b.shift - b.length / 2),
                 to      = std::min(a.shift + a.length / 2, b.shift + b.length / 2);
    const double overlap = to - from;
    const double least   = least_overlap * std::min(a.length, b.length);
    if (overlap < least && !origins[contact.a].made)
      contradict(
          reading, roll_key(origins[contact.a].roll, "shift"),
          fmt::format("leaves {} of the barrels of {} and {} on each other; at least {} is needed, a tenth of "
                      "the shorter barrel",
                      millimetres(std::max(0., overlap)), a.name, b.name, millimetres(least)),
          {roll_key(origins[contact.b].roll, "shift")});
    const auto is_off = [&](const std::array<double, 2> &ring) {
      return std::min(ring[1] + b.shift, to) <= std::max(ring[0] + b.shift, from);
    };
    if (overlap >= least && !contact.zones.empty() && !origins[contact.b].made &&
        std::all_of(contact.zones.begin(), contact.zones.end(), is_off))
      contradict(reading, roll_key(origins[contact.b].roll, "saddles.rings"),
                 fmt::format("has no ring where roll {} touches, from {} to {} of the mill; put rings there",
                             a.name, millimetres(from), millimetres(to)),
                 {roll_key(origins[contact.a].roll, "barrel_length")});
  }
  for (const std::size_t r : {stack.upper, stack.lower}) {
    const StackRoll &roll = stack.rolls[r];
    for (const double side : {-1., 1.}) {
      const double beyond =
          side * (stack.strip.offset + side * stack.strip.width / 2 - roll.shift) - roll.length / 2;
      if (beyond > overlap_allowed) {
        contradict(
            reading, "strip.width",
            fmt::format("puts an edge of the strip {} beyond the barrel of roll {}; change width, offset or "
                        "the shift of the roll",
                        millimetres(beyond), roll.name),
            {roll_key(origins[r].roll, "barrel_length")});
        return;
      }
    }
  }
}

// Bending from the window stays where it is while its roll moves: it must still act on a neck.
void check_loads(const Stack &stack, const std::vector<Origin> &origins, Reading &reading)
{
  for (std::size_t r = 0; r < stack.rolls.size(); ++r) {
    const StackRoll &roll = stack.rolls[r];
    double from = 0, to = 0;
    for (const StackSection &section : roll.sections) {
      from = std::min(from, section.from);
      to   = std::max(to, section.to);
    }
    for (const StackLoad &load : roll.loads) {
      const bool beyond = load.z < from - overlap_allowed || load.z > to + overlap_allowed;
      if (origins[r].made || (!beyond && std::abs(load.z) >= roll.length / 2 - overlap_allowed))
        continue;  // what is seen in the upper half is not said again of the one that is made of it
      contradict(reading, roll_key(origins[r].roll, "shift"),
                 fmt::format("puts a bending force at the window {} from the middle of roll {}, {}; reduce the "
                             "shift, or write bending_at = \"chock\"",
                             millimetres(std::abs(load.z)), roll.name,
                             beyond ? "beyond the end of its neck at " + millimetres(load.z < 0 ? -from : to)
                                    : "on its barrel, which ends at " + millimetres(roll.length / 2)),
                 {"stack.bending_at"});
      break;
    }
  }
}

// A contact that would have to pull: not held whatever the elasticity.
void check_resultants(const Stack &stack, const std::vector<Origin> &origins, Reading &reading)
{
  const auto resultants = stack_resultants(stack, stack.strip.force);
  for (std::size_t c = 0; c < resultants.size(); ++c) {
    if (resultants[c].force > 0)
      continue;
    const std::size_t a = stack.contacts[c].a, b = stack.contacts[c].b;
    const std::string pair = stack.rolls[a].name + "-" + stack.rolls[b].name;
    Stack unbent           = stack;
    for (StackRoll &roll : unbent.rolls)
      roll.loads.clear();
    const double by_strip = stack_resultants(unbent, stack.strip.force)[c].force;
    if (by_strip > 0)
      contradict(reading, roll_key(origins[a].roll, "bending_force"),
                 fmt::format("parts the rolls {}: the contact would carry {:.4g} kN, where the strip alone puts "
                             "{:.4g} kN on it; keep the bending forces below {:.1f} % of these, or make them less "
                             "negative",
                             pair, 1e-3 * resultants[c].force, 1e-3 * by_strip,
                             100 * by_strip / (by_strip - resultants[c].force)),
                 {"strip.force"});
    else
      contradict(
          reading, roll_key(origins[a].roll, "on"),
          fmt::format("does not hold the roll: by the angles of the stack the contact {} would carry {:.4g} kN, "
                      "and contacts only push; move the rolls so that the force passes between both that a "
                      "roll leans on",
                      pair, 1e-3 * resultants[c].force),
          {});
    return;  // the contacts behind it follow
  }
}
}  // namespace

Stack resolved_stack(const StackInput &input, Reading &reading)
{
  Stack stack;
  const std::vector<StackHalf> halves = placed_halves(input, reading);
  if (halves.empty())
    return stack;
  const bool listed = input.settings.lower == LowerHalf::listed;
  bool inclined     = false;
  for (const auto &parents : halves.front().parents)
    inclined = inclined || parents.size() > 1;
  std::vector<Origin> origins;
  const auto add_half = [&](const StackHalf &half, const double sign, const bool made) {
    std::vector<std::size_t> place(input.rolls.size(), 0);
    (sign > 0 ? stack.upper : stack.lower) = stack.rolls.size();
    for (const std::size_t r : half.rolls) {
      place[r] = stack.rolls.size();
      origins.push_back({r, sign, made});
      stack.rolls.push_back(resolved_roll(input, origins.back(), half.axes[r], inclined));
    }
    for (const std::size_t r : half.rolls)
      for (const std::size_t p : half.parents[r]) {
        StackContact contact{place[r], place[p], {}, not_given};
        if (const StackSaddles &saddles = input.rolls[p].saddles; saddles.given) {
          contact.ring_stiffness = saddles.ring_stiffness;
          contact.zones          = saddles.rings;
          if (stack.rolls[place[p]].turned) {
            for (auto &[from, to] : contact.zones)
              std::tie(from, to) = std::pair(-to, -from);
            std::reverse(contact.zones.begin(), contact.zones.end());
          }
        }
        stack.contacts.push_back(std::move(contact));
      }
  };
  add_half(halves.front(), 1, false);
  add_half(listed ? halves.back() : halves.front(), -1, !listed);
  const StackRoll &work_roll = stack.rolls[stack.upper];
  stack.strip                = resolved_strip(input.strip, work_roll.diameter / 2, work_roll.material);
  const std::size_t before   = reading.problems.size();
  check_overlap(stack, origins, reading);
  check_barrels(stack, origins, reading);
  check_loads(stack, origins, reading);
  if (reading.problems.size() == before && stack.strip.force > 0)
    check_resultants(stack, origins, reading);
  return stack;
}
}  // namespace mill
