#include "core/process/parallel.h"
#include "twin/modes/subspace.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
bool mode_is_shown(const std::vector<IdentifiedMode> &half, const IdentifiedMode &mode)
{
  constexpr double deviations = 6, shape = 0.9;
  const double reach = deviations * mode.law_frequency * std::sqrt(2.0);  // of half the time
  return std::any_of(half.begin(), half.end(), [&](const IdentifiedMode &other) {
    return std::abs(other.frequency - mode.frequency) <= reach &&
           std::abs(other.damping - mode.damping) <= deviations * mode.law_damping * std::sqrt(2.0) &&
           modal_assurance(other.shape, mode.shape) >= shape;
  });
}

// One of two bands has it already; the confirmed one stays, else that of more orders.
void add_once(std::vector<IdentifiedMode> &modes, const IdentifiedMode &mode)
{
  for (IdentifiedMode &known : modes)
    if (std::abs(known.frequency / mode.frequency - 1) < 0.01 && modal_assurance(known.shape, mode.shape) > 0.9) {
      if (std::pair(mode.confirmed, mode.orders) > std::pair(known.confirmed, known.orders))
        known = mode;
      return;
    }
  modes.push_back(mode);
}
// Three sensors and more distinguish neighbouring modes by their shapes: of two of one shape within a tenth the
// one that fewer orders show belongs to the other.
void drop_doubles(std::vector<IdentifiedMode> &modes)
{
  const auto all = modes;
  modes.erase(std::remove_if(modes.begin(), modes.end(),
                             [&](const IdentifiedMode &mode) {
                               return mode.shape.size() >= 3 &&
                                      std::any_of(all.begin(), all.end(), [&](const IdentifiedMode &other) {
                                        return other.orders > mode.orders &&
                                               std::abs(other.frequency / mode.frequency - 1) < 0.1 &&
                                               modal_assurance(other.shape, mode.shape) > 0.9;
                                      });
                             }),
              modes.end());
}

void mark_confirmed(ModeSearch &search)
{
  for (SubspacePole &pole : search.poles)
    pole.confirmed =
        pole.stable && std::any_of(search.modes.begin(), search.modes.end(), [&](const IdentifiedMode &mode) {
          return mode.confirmed && std::abs(pole.frequency / mode.frequency - 1) < 0.01 &&
                 modal_assurance(pole.shape, mode.shape) > 0.9;
        });
}
}  // namespace

ModeSearch find_modes(const std::vector<const CleanChannel *> &channels, const double rate, const double highest,
                      const int threads)
{
  ModeSearch search;
  if (channels.empty())
    return search;
  for (const ModeBand &band : mode_bands(highest)) {
    std::vector<DecimatedRecord> records(1, decimated(channels, rate, band.high));
    if (records[0].piece.empty())
      continue;
    for (DecimatedRecord &half : halves(records[0]))
      records.push_back(std::move(half));
    std::vector<std::vector<SubspacePole>> poles(3);
    share_tasks(3, threads,
                [&](const long i) { poles[std::size_t(i)] = subspace_poles(records[std::size_t(i)], band); });
    const double T   = records[0].duration();
    const auto first = modes_of_poles(poles[1], T / 2), second = modes_of_poles(poles[2], T / 2);
    for (IdentifiedMode &mode : modes_of_poles(poles[0], T)) {
      mode.confirmed = mode_is_shown(first, mode) && mode_is_shown(second, mode);
      add_once(search.modes, mode);
    }
    if (band.high >= highest || band.high >= 1000) {  // the last band holds the frequencies of all
      Fourier fourier;
      search.singular = first_singular_value(records[0], band.high, fourier);
    }
    std::move(poles[0].begin(), poles[0].end(), std::back_inserter(search.poles));
  }
  drop_doubles(search.modes);
  std::sort(search.modes.begin(), search.modes.end(),
            [](const auto &a, const auto &b) { return a.frequency < b.frequency; });
  mark_confirmed(search);
  return search;
}
}  // namespace mill::twin
