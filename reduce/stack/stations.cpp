#include "reduce/stack/stations.h"
#include "reduce/chain/roll_profile.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mill::reduce {
namespace {
constexpr double same_place = 1e-6;  // m
constexpr double finest     = 0.15;  // smallest element at the edge of the strip over the largest
constexpr double grading    = 0.2;   // element length over the distance from the edge
// As many elements on half a diameter of the thinnest roll as on the width of the strip, or fewer: 60 of them
// leave elements of a thirtieth of the diameter.
constexpr double away_over_diameter = 2;

void add_breaks(std::vector<double> &z, const StackRoll &roll)
{
  for (const StackSection &section : roll.sections) {
    z.push_back(section.from + roll.shift);
    z.push_back(section.to + roll.shift);
  }
  for (const StackSupport &support : roll.supports)
    z.push_back(support.z + roll.shift);
  for (const StackLoad &load : roll.loads)
    z.push_back(load.z + roll.shift);
  for (const StackLump &lump : roll.lumps)
    z.push_back(lump.z + roll.shift);
  z.push_back(roll.shift - roll.length / 2);
  z.push_back(roll.shift + roll.length / 2);
}

// Along the strip, and away from it, where a bent roll changes over its diameter however narrow the strip is.
struct Longest {
  double at_strip, away;  // m
};

// The line load and the flattening change fast near the edges of the strip.
double longest_at(const StackStrip &strip, const double z, const Longest &longest)
{
  const double beyond = std::abs(z - strip.offset) - strip.width / 2;
  return std::min(beyond > 0 ? longest.away : longest.at_strip,
                  std::max(longest.at_strip * finest, grading * std::abs(beyond)));
}

// Places between two breaks, in steps that follow longest_at().
std::vector<double> pieces_between(const StackStrip &strip, const double from, const double to,
                                   const Longest &longest)
{
  // Number of elements up to a place; its whole values are the places, after a stretch that makes the last one
  // whole.
  constexpr int fewest = 64;
  const int samples    = std::max(fewest, int(std::ceil((to - from) / longest.at_strip)));
  std::vector<double> count{0};
  const double step = (to - from) / samples;
  for (int i = 0; i < samples; ++i)
    count.push_back(count.back() + step / longest_at(strip, from + (i + 0.5) * step, longest));
  const int pieces = std::max(1, int(std::ceil(count.back() - 1e-9)));
  std::vector<double> places;
  std::size_t i = 0;
  for (int k = 1; k < pieces; ++k) {
    const double wanted = count.back() * k / pieces;
    while (count[i + 1] < wanted)
      ++i;
    places.push_back(from + step * (double(i) + (wanted - count[i]) / (count[i + 1] - count[i])));
  }
  return places;
}
}  // namespace

int Stations::place(const double position) const
{
  return int(std::lower_bound(z.begin(), z.end(), position - same_place) - z.begin());
}

Stations stations_of(const Stack &stack, const double longest)
{
  std::vector<double> breaks;
  double thinnest = std::numeric_limits<double>::infinity();
  for (const StackRoll &roll : stack.rolls) {
    add_breaks(breaks, roll);
    thinnest = std::min(thinnest, roll.diameter);
  }
  const Longest lengths{longest, std::max(longest, away_over_diameter * thinnest * longest / stack.strip.width)};
  for (const StackContact &contact : stack.contacts)
    for (const auto &zone : contact_zones(stack, contact))
      breaks.insert(breaks.end(), zone.begin(), zone.end());
  for (const double side : {-1., 0., 1.})
    breaks.push_back(stack.strip.offset + side * stack.strip.width / 2);
  std::sort(breaks.begin(), breaks.end());
  Stations stations;
  for (const double b : breaks) {
    if (!stations.z.empty()) {
      const double from = stations.z.back();
      if (b - from < same_place)
        continue;
      for (const double z : pieces_between(stack.strip, from, b, lengths))
        stations.z.push_back(z);
    }
    stations.z.push_back(b);
  }
  return stations;
}

std::vector<std::array<double, 2>> contact_zones(const Stack &stack, const StackContact &contact)
{
  const StackRoll &a = stack.rolls[contact.a], &b = stack.rolls[contact.b];
  const double from = std::max(a.shift - a.length / 2, b.shift - b.length / 2);
  const double to   = std::min(a.shift + a.length / 2, b.shift + b.length / 2);
  if (contact.zones.empty())
    return {{from, to}};
  std::vector<std::array<double, 2>> zones;
  for (const auto &[ring_from, ring_to] : contact.zones)
    if (const double z1 = std::max(ring_from + b.shift, from), z2 = std::min(ring_to + b.shift, to); z2 > z1)
      zones.push_back({z1, z2});
  return zones;
}

std::array<double, 2> direction_of(const Stack &stack, const StackContact &contact)
{
  const auto &a = stack.rolls[contact.a].axis, &b = stack.rolls[contact.b].axis;
  const double x = b[0] - a[0], y = b[1] - a[1], distance = std::hypot(x, y);
  return {x / distance, y / distance};
}

bool has_inclined_contact(const Stack &stack)
{
  return std::any_of(stack.contacts.begin(), stack.contacts.end(),
                     [&](const StackContact &c) { return std::abs(direction_of(stack, c)[0]) > 1e-9; });
}

std::vector<std::vector<std::size_t>> touching_groups(const Stack &stack)
{
  std::vector<std::size_t> group(stack.rolls.size());
  std::iota(group.begin(), group.end(), std::size_t(0));
  for (std::size_t round = 0; round < stack.rolls.size(); ++round)
    for (const StackContact &c : stack.contacts)
      group[c.a] = group[c.b] = std::min(group[c.a], group[c.b]);
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t g = 0; g < group.size(); ++g) {
    std::vector<std::size_t> rolls;
    for (std::size_t r = 0; r < group.size(); ++r)
      if (group[r] == g)
        rolls.push_back(r);
    if (!rolls.empty())
      groups.push_back(rolls);
  }
  return groups;
}

double entry_departure(const StackStrip &strip, const double z)
{
  const auto &table = strip.entry_profile;
  if (table.empty())
    return 0;
  if (z <= table.front()[0])
    return table.front()[1];
  for (std::size_t i = 1; i < table.size(); ++i)
    if (z <= table[i][0]) {
      const double t = (z - table[i - 1][0]) / (table[i][0] - table[i - 1][0]);
      return table[i - 1][1] + t * (table[i][1] - table[i - 1][1]);
    }
  return table.back()[1];
}

double opening_factor(const StackStrip &strip)
{
  return strip.modulus + strip.tension_modulus;
}

double entry_factor(const StackStrip &strip)
{
  return strip.entry_modulus +
         (strip.tension_modulus > 0 ? strip.tension_modulus * strip.exit_thickness / strip.entry_thickness : 0);
}

double radius_departure(const StackRoll &roll, const double z)
{
  const double in_roll = z - roll.shift;
  return -radius_drop(roll.profile, roll.turned ? -in_roll : in_roll);
}
}  // namespace mill::reduce
