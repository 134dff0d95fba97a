#include "core/case/stack_half.h"
#include "core/case/stand_reader.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace mill {
namespace {
using Parents = std::vector<std::vector<std::size_t>>;

bool is_placed(const std::array<double, 2> &axis)
{
  return !std::isnan(axis[0]);
}

Parents parents_of(const StackInput &input, Reading &reading)
{
  std::vector<std::string> names;
  for (const StackRollInput &roll : input.rolls)
    names.push_back(roll.name);
  Parents parents(input.rolls.size());
  for (std::size_t r = 0; r < input.rolls.size(); ++r)
    for (const std::string &name : input.rolls[r].on) {
      const auto match = std::find(names.begin(), names.end(), name);
      if (match == names.end())
        contradict(reading, roll_key(r, "on"),
                   fmt::format("names \"{}\", which is not a roll{}", name, suggestion(name, names)), {});
      else
        parents[r].push_back(std::size_t(match - names.begin()));
    }
  return parents;
}

// Each roll after all that lean on it; fewer than all where some lean on each other in a circle.
std::vector<std::size_t> from_strip_outwards(const Parents &parents, const std::vector<std::size_t> &among)
{
  std::vector<int> leaning(parents.size(), 0);
  for (const std::size_t r : among)
    for (const std::size_t p : parents[r])
      ++leaning[p];
  std::vector<std::size_t> order, free;
  for (const std::size_t r : among)
    if (leaning[r] == 0)
      order.push_back(r);
  for (std::size_t i = 0; i < order.size(); ++i)
    for (const std::size_t p : parents[order[i]])
      if (--leaning[p] == 0)
        order.push_back(p);
  return order;
}

void refuse_circle(const StackInput &input, const Parents &parents, const std::vector<std::size_t> &order,
                   Reading &reading)
{
  for (std::size_t r = 0; r < parents.size(); ++r)
    if (std::find(order.begin(), order.end(), r) == order.end() && !parents[r].empty()) {
      contradict(reading, roll_key(r, "on"),
                 fmt::format("makes a circle: roll {} leans on rolls that in the end lean on it; name only rolls "
                             "that lie farther from the strip",
                             input.rolls[r].name),
                 {});
      return;
    }
}

// All that hangs together with one roll.
std::vector<std::size_t> joined_with(const std::size_t first, const Parents &parents)
{
  std::vector<std::size_t> joined{first};
  const auto add = [&](const std::size_t r) {
    if (std::find(joined.begin(), joined.end(), r) == joined.end())
      joined.push_back(r);
  };
  for (std::size_t i = 0; i < joined.size(); ++i) {
    for (const std::size_t p : parents[joined[i]])
      add(p);
    for (std::size_t r = 0; r < parents.size(); ++r)
      if (std::find(parents[r].begin(), parents[r].end(), joined[i]) != parents[r].end())
        add(r);
  }
  std::sort(joined.begin(), joined.end());
  return joined;
}

double radius_of(const StackInput &input, const std::size_t roll)
{
  return input.rolls[roll].barrel_diameter / 2;
}

// The axis of a roll between two others, towards the strip.  theory.md (51.10)
std::array<double, 2> below_two(const StackInput &input, const std::size_t roll, std::size_t left,
                                std::size_t right, const std::vector<std::array<double, 2>> &axes,
                                const double sign, Reading &reading)
{
  if (axes[left][0] > axes[right][0])
    std::swap(left, right);
  const double r  = radius_of(input, roll);
  const double d1 = radius_of(input, left) + r, d2 = radius_of(input, right) + r;
  const double dx = axes[right][0] - axes[left][0], dy = axes[right][1] - axes[left][1], L = std::hypot(dx, dy);
  const double least = radius_of(input, left) + radius_of(input, right);
  if (L < least || L >= d1 + d2) {
    contradict(reading, roll_key(roll, "on"),
               fmt::format("has the axes of {} and {} at a distance of {}; roll {} touches both, and they do not "
                           "overlap, between {} and {}. Move them or change a diameter",
                           input.rolls[left].name, input.rolls[right].name, millimetres(L), input.rolls[roll].name,
                           millimetres(least), millimetres(d1 + d2)),
               {});
    return {not_given, not_given};
  }
  const double s = (L * L + d1 * d1 - d2 * d2) / (2 * L), height = std::sqrt(std::max(0., d1 * d1 - s * s));
  return {axes[left][0] + s * dx / L + sign * height * dy / L,
          axes[left][1] + s * dy / L - sign * height * dx / L};
}

// A column: from the pass line outwards, as long as each roll leans on one and nothing else is known.
void place_column(const StackInput &input, StackHalf &half, const double sign)
{
  half.axes[half.rolls.front()] = {0, sign * radius_of(input, half.rolls.front())};
  for (const std::size_t r : half.rolls)
    for (const std::size_t p : half.parents[r])
      half.axes[p] = {0, half.axes[r][1] + sign * (radius_of(input, r) + radius_of(input, p))};
}

// A cluster: from the rolls that lean on none towards the strip.
bool place_cluster(const StackInput &input, StackHalf &half, const double sign, Reading &reading)
{
  for (auto r = half.rolls.rbegin(); r != half.rolls.rend(); ++r) {
    const StackRollInput &roll = input.rolls[*r];
    const auto &on             = half.parents[*r];
    if (on.empty()) {
      if (std::isnan(roll.position[0])) {
        reading.add(roll.place, fmt::format("roll {} leans on none and has no 'position'; add for example "
                                            "position = [\"-411 mm\", \"185 mm\"], x and y of its axis",
                                            roll.name));
        return false;
      }
      half.axes[*r] = roll.position;
    } else if (on.size() == 1) {
      half.axes[*r] = {half.axes[on[0]][0],
                       half.axes[on[0]][1] - sign * (radius_of(input, *r) + radius_of(input, on[0]))};
    } else {
      half.axes[*r] = below_two(input, *r, on[0], on[1], half.axes, sign, reading);
      if (!is_placed(half.axes[*r]))
        return false;
    }
  }
  return true;
}

void refuse_needless_positions(const StackInput &input, const StackHalf &half, const bool column, Reading &reading)
{
  for (const std::size_t r : half.rolls)
    if (!std::isnan(input.rolls[r].position[0]) && (column || !half.parents[r].empty()))
      contradict(reading, roll_key(r, "position"),
                 column ? "is not needed: in a column every place follows from the pass line; remove it"
                        : "is not needed: the place of a roll that leans on others follows from 'on'; remove it",
                 {});
}

bool place(const StackInput &input, StackHalf &half, const double sign, Reading &reading)
{
  bool column = true;
  for (const std::size_t r : half.rolls)
    column = column && half.parents[r].size() < 2;
  half.axes.assign(input.rolls.size(), {not_given, not_given});
  refuse_needless_positions(input, half, column, reading);
  if (column)
    place_column(input, half, sign);
  return column || place_cluster(input, half, sign, reading);
}
}  // namespace

std::string roll_key(const std::size_t roll, const char *key)
{
  return fmt::format("roll.{}.{}", roll, key);
}

std::vector<StackHalf> placed_halves(const StackInput &input, Reading &reading)
{
  const std::size_t problems_before = reading.problems.size();
  const Parents parents             = parents_of(input, reading);
  if (reading.problems.size() > problems_before)
    return {};
  std::vector<std::size_t> all(input.rolls.size());
  for (std::size_t r = 0; r < all.size(); ++r)
    all[r] = r;
  const auto order = from_strip_outwards(parents, all);
  if (order.size() < all.size()) {
    refuse_circle(input, parents, order, reading);
    return {};
  }
  std::vector<bool> carries(all.size(), false);
  for (const auto &on : parents)
    for (const std::size_t p : on)
      carries[p] = true;
  std::vector<std::size_t> at_strip;
  std::string names;
  for (const std::size_t r : all)
    if (!carries[r]) {
      at_strip.push_back(r);
      names += (names.empty() ? "" : ", ") + input.rolls[r].name;
    }
  const bool listed        = input.settings.lower == LowerHalf::listed;
  const std::size_t wanted = listed ? 2 : 1;
  if (at_strip.size() != wanted) {
    const char *or_listed =
        at_strip.size() == 2 ? ", or give lower = \"listed\" where both halves are listed" : "";
    reading.add(input.rolls[at_strip[std::min(wanted, at_strip.size() - 1)]].place,
                fmt::format("{} rolls carry no other roll and lie at the strip ({}); {} is needed with lower = "
                            "\"{}\": name the others in 'on' of the roll that leans on them{}",
                            at_strip.size(), names, listed ? "one of each half" : "one",
                            word_of(input.settings.lower), or_listed));
    return {};
  }
  std::vector<StackHalf> halves;
  for (std::size_t h = 0; h < wanted; ++h) {
    StackHalf half;
    half.rolls   = from_strip_outwards(parents, joined_with(at_strip[h], parents));
    half.parents = parents;
    if (!place(input, half, h == 0 ? 1 : -1, reading))
      return {};
    halves.push_back(std::move(half));
  }
  if (listed && std::find(halves[1].rolls.begin(), halves[1].rolls.end(), at_strip[0]) != halves[1].rolls.end()) {
    reading.add(
        input.rolls[at_strip[1]].place,
        "both rolls at the strip lean on the same rolls; a roll belongs to the upper or to the lower half");
    return {};
  }
  return reading.problems.size() > problems_before ? std::vector<StackHalf>() : halves;
}
}  // namespace mill
