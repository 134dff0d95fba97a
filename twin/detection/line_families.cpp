#include "twin/detection/line_families.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace mill::twin {
namespace {
constexpr double least_certain = 1e-3;  // chance of a family that is reported
constexpr double deviations    = 4;
constexpr int most_divisor = 4, most_order = 400;
constexpr std::size_t strong_lines = 12, most_carriers = 10;
constexpr int most_harmonic = 30, most_side = 4;

struct Multiple {
  int order;
  std::size_t line;
};

// Weighted mean of f/n and its deviation.
void refine(LineFamily &family, const std::vector<SeenLine> &lines, const std::vector<Multiple> &multiples)
{
  double nn = 0, nf = 0;
  for (const Multiple &one : multiples) {
    const double weight = 1 / (lines[one.line].deviation * lines[one.line].deviation);
    nn += weight * one.order * one.order;
    nf += weight * one.order * lines[one.line].frequency;
  }
  family.fundamental = nf / nn;
  family.deviation   = 1 / std::sqrt(nn);
}

double reach_of(const LineFamily &family, const SeenLine &line, const int order)
{
  return deviations * std::hypot(line.deviation, order * family.deviation);
}

// Grows a family from a first guess of its fundamental, lowest orders first, so that each multiple sharpens the
// next.
LineFamily family_from(const double guess, const double deviation, const std::vector<SeenLine> &lines,
                       const std::vector<std::size_t> &ascending)
{
  LineFamily family{guess, deviation, {}, {}, 1, {}};
  std::vector<Multiple> multiples, certain;
  double expected = 0, least_chance = 1;
  LineFamily refined = family;
  for (const std::size_t i : ascending) {
    const int order = int(std::lround(lines[i].frequency / family.fundamental));
    if (order < 1 || order > most_order)
      continue;
    const double reach = reach_of(family, lines[i], order);
    if (reach > 0.1 * family.fundamental)
      break;  // so far up every line is a multiple
    expected += std::min(1.0, 2 * reach / family.fundamental);
    if (std::abs(lines[i].frequency - order * family.fundamental) > reach)
      continue;
    const auto same =
        std::find_if(multiples.begin(), multiples.end(), [&](const Multiple &m) { return m.order == order; });
    if (same == multiples.end())
      multiples.push_back({order, i});
    else if (lines[i].power > lines[same->line].power)
      same->line = i;
    refine(family, lines, multiples);
    if (const double chance = chance_of(multiples.size() - 1, expected);
        multiples.size() == 1 || chance <= least_chance) {
      least_chance = chance;  // what comes later and makes the family less certain is not of it
      certain      = multiples;
      refined      = family;
    }
  }
  family = refined;
  for (const Multiple &one : certain) {
    family.orders.push_back(one.order);
    family.members.push_back(one.line);
  }
  family.chance = certain.empty() ? 1 : least_chance;
  return family;
}

// A family of which every order is a multiple of n has n times the fundamental.
void divide_out(LineFamily &family)
{
  int common = 0;
  for (const int order : family.orders)
    common = std::gcd(common, order);
  if (common < 2)
    return;
  for (int &order : family.orders)
    order /= common;
  family.fundamental *= common;
  family.deviation *= common;
}

std::optional<LineFamily> best_family(const std::vector<SeenLine> &lines, const std::vector<std::size_t> &free,
                                      const std::vector<KnownFundamental> &known)
{
  std::optional<LineFamily> best;
  const auto consider = [&](LineFamily &&family, const std::size_t least, const double tries) {
    family.chance = std::min(1.0, family.chance * tries);
    if (family.members.size() >= least && family.chance < least_certain &&
        (!best || family.members.size() > best->members.size() ||
         (family.members.size() == best->members.size() && family.chance < 0.999 * best->chance)))
      best = std::move(family);
  };
  for (const KnownFundamental &one : known) {
    // each line that is near a multiple gives a guess; the guess has the accuracy of that line
    for (const std::size_t i : free) {
      const int order = int(std::lround(lines[i].frequency / one.frequency));
      if (order < 1 || std::abs(lines[i].frequency / order / one.frequency - 1) > one.tolerance)
        continue;
      LineFamily family = family_from(lines[i].frequency / order, lines[i].deviation / order, lines, free);
      family.name       = one.name;
      consider(std::move(family), one.least, 1);
    }
  }
  for (const std::size_t i : free)
    for (int divisor = 1; divisor <= most_divisor; ++divisor) {
      LineFamily family = family_from(lines[i].frequency / divisor, lines[i].deviation / divisor, lines, free);
      divide_out(family);
      consider(std::move(family), 3, double(free.size() * most_divisor));
    }
  return best;
}
}  // namespace

double chance_of(const std::size_t k, const double expected)
{
  if (k == 0)
    return 1;
  double term =
      std::exp(-expected + double(k) * std::log(std::max(expected, 1e-300)) - std::lgamma(double(k) + 1));
  double sum = 0;
  for (std::size_t i = k; i < k + 1000 && term > 1e-17 * sum; ++i) {
    sum += term;
    term *= expected / double(i + 1);
  }
  return std::min(1.0, sum);
}

namespace {
// Nearest place h c + j d of a frequency; the simplest of those within reach.
std::optional<SideBands::Place> place_of(const SideBands &bands, const SeenLine &line, const std::size_t i,
                                         const double carrier_deviation, const double spacing_deviation)
{
  std::optional<SideBands::Place> best;
  int simplest    = std::numeric_limits<int>::max();
  const int first = std::max(0, int((line.frequency - most_side * bands.spacing) / bands.carrier)),
            last  = std::min(most_harmonic, int((line.frequency + most_side * bands.spacing) / bands.carrier) + 1);
  for (int h = std::max(1, first); h <= last; ++h) {
    const int j = int(std::lround((line.frequency - h * bands.carrier) / bands.spacing));
    if (std::abs(j) > most_side || h + std::abs(j) >= simplest)
      continue;
    const double reach =
        deviations * std::sqrt(line.deviation * line.deviation + h * h * carrier_deviation * carrier_deviation +
                               j * j * spacing_deviation * spacing_deviation);
    if (std::abs(line.frequency - h * bands.carrier - j * bands.spacing) <= reach) {
      best     = SideBands::Place{h, j, i};
      simplest = h + std::abs(j);
    }
  }
  return best;
}

SideBands bands_from(const double carrier, const double carrier_deviation, const double spacing,
                     const double spacing_deviation, const std::vector<SeenLine> &lines,
                     const std::vector<std::size_t> &free)
{
  SideBands bands{carrier, spacing, {}, 1};
  double expected = 0;
  bool side       = false;
  for (const std::size_t i : free) {
    const double h = std::max(1.0, std::round(lines[i].frequency / carrier));
    const double reach =
        deviations * std::hypot(lines[i].deviation, std::hypot(h * carrier_deviation, 2 * spacing_deviation));
    expected += std::min(1.0, 2 * reach * (2 * most_side + 1) / carrier);
    if (const auto place = place_of(bands, lines[i], i, carrier_deviation, spacing_deviation)) {
      bands.places.push_back(*place);
      side = side || place->side != 0;
    }
  }
  bands.chance = side && bands.places.size() > 2 ? chance_of(bands.places.size() - 2, expected) : 1;
  return bands;
}
}  // namespace

namespace {
struct Guess {
  double value, deviation;  // Hz
};

// The carrier and spacing that place most of the free lines.
std::optional<SideBands> best_bands(const std::vector<SeenLine> &lines, std::vector<std::size_t> free,
                                    const std::vector<Guess> &carriers, std::vector<Guess> spacings,
                                    const std::size_t least)
{
  std::sort(free.begin(), free.end(), [&](const auto a, const auto b) { return lines[a].power > lines[b].power; });
  const std::size_t strong = std::min(free.size(), strong_lines);
  for (std::size_t a = 0; a < strong; ++a) {
    spacings.push_back({lines[free[a]].frequency, lines[free[a]].deviation});
    for (std::size_t b = a + 1; b < strong; ++b)
      spacings.push_back({std::abs(lines[free[a]].frequency - lines[free[b]].frequency),
                          std::hypot(lines[free[a]].deviation, lines[free[b]].deviation)});
  }
  std::optional<SideBands> best;
  for (const Guess &carrier : carriers)
    for (const Guess &spacing : spacings) {
      if (spacing.value < 8 * spacing.deviation || spacing.value > 0.45 * carrier.value)
        continue;
      SideBands bands =
          bands_from(carrier.value, carrier.deviation, spacing.value, spacing.deviation, lines, free);
      bands.chance = std::min(1.0, bands.chance * double(carriers.size() * spacings.size()));
      if (bands.places.size() >= least && bands.chance < least_certain &&
          (!best || bands.places.size() > best->places.size() ||
           (bands.places.size() == best->places.size() && bands.chance < 0.999 * best->chance)))
        best = std::move(bands);
    }
  return best;
}

template <class Members> void remove_from(std::vector<std::size_t> &free, const Members &is_member)
{
  free.erase(std::remove_if(free.begin(), free.end(), is_member), free.end());
}

void take_side_bands(LinesInFamilies &result, const SideBands &bands)
{
  remove_from(result.free, [&](const std::size_t i) {
    return std::any_of(bands.places.begin(), bands.places.end(),
                       [&](const auto &place) { return place.line == i; });
  });
  result.side_bands.push_back(bands);
}
}  // namespace

LinesInFamilies lines_in_families(const std::vector<SeenLine> &lines, const std::vector<KnownFundamental> &known)
{
  LinesInFamilies result;
  std::vector<std::size_t> &free = result.free;
  free.resize(lines.size());
  std::iota(free.begin(), free.end(), 0);
  std::sort(free.begin(), free.end(),
            [&](const auto a, const auto b) { return lines[a].frequency < lines[b].frequency; });
  std::vector<Guess> spacings;
  for (const KnownFundamental &one : known)
    if (one.least > 0 && one.name.rfind("turns", 0) == 0)
      spacings.push_back({one.frequency, one.tolerance * one.frequency / 4});
  while (const auto family = best_family(lines, free, known)) {
    remove_from(free, [&](const std::size_t i) {
      return std::find(family->members.begin(), family->members.end(), i) != family->members.end();
    });
    result.families.push_back(*family);
    spacings.push_back({family->fundamental, family->deviation});
    if (const auto bands = best_bands(lines, free, {{family->fundamental, family->deviation}}, spacings, 3))
      take_side_bands(result, *bands);
  }
  while (free.size() >= 3) {
    std::vector<std::size_t> strong = free;
    std::sort(strong.begin(), strong.end(),
              [&](const auto a, const auto b) { return lines[a].power > lines[b].power; });
    std::vector<Guess> carriers;
    for (std::size_t i = 0; i < std::min(strong.size(), most_carriers); ++i)
      carriers.push_back({lines[strong[i]].frequency, lines[strong[i]].deviation});
    const auto bands = best_bands(lines, free, carriers, spacings, 3);
    if (!bands)
      break;
    take_side_bands(result, *bands);
  }
  return result;
}
}  // namespace mill::twin
