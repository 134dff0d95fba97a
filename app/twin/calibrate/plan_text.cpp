#include "app/twin/calibrate/plan_text.h"
#include "app/twin/stand/record_options.h"
#include "core/case/fields.h"
#include "twin/calibration/words.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
double or_default(const std::string &option, const std::string &text, const std::string &fallback)
{
  return option_quantity(option, text.empty() ? fallback : text, fallback);
}

std::vector<Eigen::Index> places_of(const PriorChain &chain, const std::string &sensors)
{
  std::vector<Eigen::Index> places;
  for (const std::string &name : split(sensors.empty() ? "upper_work_roll,lower_work_roll" : sensors, ",")) {
    const auto at = std::find(chain.places.begin(), chain.places.end(), name);
    if (at == chain.places.end())
      throw InputError("--sensors " + sensors + ": " + name + " is no place of the stand" +
                       suggestion(name, chain.places));
    if (std::find(places.begin(), places.end(), at - chain.places.begin()) != places.end())
      throw InputError("--sensors " + sensors + ": " + name + " is there twice");
    places.push_back(at - chain.places.begin());
  }
  return places;
}

std::string told_columns(const twin::Told &told, const std::vector<twin::Unknown> &unknowns, const std::size_t i)
{
  const double shrink = told.shrink[Eigen::Index(i)], prior = unknowns[i].prior_sd;
  return fmt::format(" {:>9}  {:>9}  {:>8.2g}  {}\n", fmt::format("{:.3g} %", 100 * prior),
                     fmt::format("{:.2g} %", 100 * shrink * prior), shrink, shrink <= 0.5 ? "told" : "not told");
}

/// What the record would tell of the damping of each mode, where the common one is asked for.
std::string each_damping(const PriorChain &chain, const std::vector<twin::Unknown> &unknowns,
                         const twin::PlannedRecord &record)
{
  std::vector<twin::Unknown> each;
  for (const twin::Unknown &unknown : unknowns)
    if (unknown.name != "zeta")
      each.push_back(unknown);
  if (each.size() == unknowns.size())
    return "";
  const std::size_t first         = each.size();
  const Eigen::VectorXd frequency = twin::mode_frequencies(chain.stand);
  for (Eigen::Index i = 0; i < frequency.size() && frequency[i] < record.high; ++i)
    each.push_back({fmt::format("zeta{}", i + 1), std::log(2.0), 0});
  const twin::Told told = planned(chain.stand, each, record);
  std::string text      = "  each mode by itself, in place of zeta\n";
  for (std::size_t i = first; i < each.size(); ++i)
    text += fmt::format("  {:<6} {:>9.1f} Hz", each[i].name, frequency[Eigen::Index(i - first)]) +
            told_columns(told, each, i);
  return text;
}
}  // namespace

std::string plan_text(const PriorChain &chain, const std::vector<twin::Unknown> &unknowns,
                      const CalibrateOptions &options)
{
  twin::PlannedRecord record;
  record.places         = places_of(chain, options.sensors);
  record.duration       = or_default("--duration", options.duration, "20 s");
  record.noise          = or_default("--noise", options.noise, "0.005 m/s2");
  record.force_highest  = or_default("--force-up-to", options.highest, "1500 Hz");
  const double rms      = or_default("--force-rms", options.force, "1 kN");
  record.force_density  = rms / std::sqrt(record.force_highest);
  record.force_recorded = !options.without_force;
  const twin::Told told = planned(chain.stand, unknowns, record);
  std::string sensors;
  for (const Eigen::Index place : record.places)
    sensors += (sensors.empty() ? "" : ", ") + chain.places[std::size_t(place)];
  std::string text =
      fmt::format("Plan: {}; {}\n  {:.4g} s, force of {:.4g} kN rms up to {:.4g} Hz{}, noise of {:.3g} m/s2 per "
                  "root Hz, band {:.0f} "
                  "to {:.0f} Hz\n",
                  chain.source, sensors, record.duration, rms / 1e3, record.force_highest,
                  record.force_recorded ? "" : ", not recorded", record.noise, record.low, record.high);
  std::size_t width = 6;
  for (const twin::Unknown &unknown : unknowns)
    width = std::max(width, unknown.name.size());
  text += fmt::format("  {:<{}}    before      after     share\n", "unknown", width + 1);
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    text += fmt::format("  {:<{}}", unknowns[i].name, width) + told_columns(told, unknowns, i);
  text += each_damping(chain, unknowns, record);
  const auto unseen = unseen_directions(told, chain.stand);
  for (const std::string &direction : unseen)
    text += "not seen: " + direction + "\n";
  if (unseen.empty())
    text += "weakest, yet seen: " + weakest_direction(told, chain.stand) + "\n";
  const auto next = next_sensors(chain.stand, unknowns, record);
  for (std::size_t i = 0; i < next.size(); ++i) {
    const auto &name  = chain.places[std::size_t(next[i].place)];
    Eigen::Index best = 0;
    (next[i].told.shrink.cwiseQuotient(told.shrink)).minCoeff(&best);
    text += fmt::format("{} a sensor at {}: {} to {:.2g} of the prior, now {:.2g}\n",
                        i == 0 ? "would help most:" : "                ", name, told.names[std::size_t(best)],
                        next[i].told.shrink[best], told.shrink[best]);
  }
  for (const std::string &note : chain.notes)
    text += "note: " + note + "\n";
  return text;
}
}  // namespace mill
