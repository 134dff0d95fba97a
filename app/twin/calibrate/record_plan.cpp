#include "app/twin/calibrate/record_plan.h"
#include "app/twin/stand/record_options.h"
#include "core/case/fields.h"
#include "core/records/note_records.h"
#include "twin/calibration/words.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill {
namespace {
constexpr double identified_up_to = 0.5;  // -, shrink

double or_default(const std::string &option, const std::string &text, const std::string &fallback)
{
  return option_quantity(option, text.empty() ? fallback : text, fallback);
}

std::vector<Eigen::Index> places_of(const PriorChain &chain, const std::string &sensors)
{
  std::vector<Eigen::Index> places;
  for (const std::string &name : split(sensors.empty() ? "upper_work_roll,lower_work_roll" : sensors, ",")) {
    const auto place = std::find(chain.places.begin(), chain.places.end(), name);
    if (place == chain.places.end())
      throw InputError("--sensors " + sensors + ": the stand has no place " + name +
                       suggestion(name, chain.places));
    if (std::find(places.begin(), places.end(), place - chain.places.begin()) != places.end())
      throw InputError("--sensors " + sensors + ": " + name + " appears twice");
    places.push_back(place - chain.places.begin());
  }
  return places;
}

std::string columns(const double prior, const double shrink)
{
  return fmt::format(" {:>9}  {:>9}  {:>8.2g}  {}\n", fmt::format("{:.3g} %", 100 * prior),
                     fmt::format("{:.2g} %", 100 * shrink * prior), shrink,
                     shrink <= identified_up_to ? "identified" : "not identified");
}

/// The damping of each mode, where the common one is free.
void add_ratios(RecordPlan &plan, const PriorChain &prior)
{
  std::vector<twin::Unknown> each;
  for (const twin::Unknown &unknown : plan.unknowns)
    if (twin::moves(unknown) != twin::Moves::ratios)
      each.push_back(unknown);
  if (each.size() == plan.unknowns.size())
    return;
  const std::size_t first         = each.size();
  const Eigen::VectorXd frequency = twin::mode_frequencies(prior.stand);
  for (Eigen::Index i = 0; i < frequency.size() && frequency[i] < plan.record.high; ++i)
    each.push_back({twin::ratio_name(i), std::log(2.0), 0});
  const twin::Identification identified = planned(prior.stand, each, plan.record);
  plan.ratios.assign(each.begin() + long(first), each.end());
  plan.ratio_frequency = frequency.head(Eigen::Index(plan.ratios.size()));
  plan.ratio_shrink    = identified.shrink.segment(Eigen::Index(first), Eigen::Index(plan.ratios.size()));
}
}  // namespace

RecordPlan record_plan(const PriorChain &prior, const std::string &case_name,
                       const std::vector<twin::Unknown> &unknowns, const CalibrateOptions &options)
{
  RecordPlan plan;
  plan.case_name = case_name;
  plan.stand     = prior.source;
  plan.unknowns  = unknowns;
  plan.places    = prior.places;
  plan.notes     = prior.notes;
  twin::PlannedRecord record;
  record.places         = places_of(prior, options.sensors);
  record.duration       = or_default("--duration", options.duration, "20 s");
  record.noise          = or_default("--noise", options.noise, "0.005 m/s2");
  record.force_highest  = or_default("--force-up-to", options.highest, "1500 Hz");
  plan.force_rms        = or_default("--force-rms", options.force, "1 kN");
  record.force_density  = plan.force_rms / std::sqrt(record.force_highest);
  record.force_recorded = !options.without_force;
  plan.record           = record;
  for (const Eigen::Index place : record.places)
    plan.sensors.push_back(prior.places[std::size_t(place)]);
  plan.identification = planned(prior.stand, unknowns, record);
  if (!plan.identification.shrink.allFinite())
    throw InputError("--plan: what records would show cannot be computed with this --duration, --noise, "
                     "--force-up-to and --force-rms, which lie too far apart; the noise of a usual sensor is "
                     "--noise \"0.005 m/s2\"");
  add_ratios(plan, prior);
  plan.unseen  = unseen_directions(plan.identification, prior.stand);
  plan.weakest = weakest_direction(plan.identification, prior.stand);
  plan.next    = next_sensors(prior.stand, unknowns, record);
  return plan;
}

namespace {
/// The unknown that a further sensor improves most.
std::size_t most_improved(const RecordPlan &plan, const twin::NextSensor &next)
{
  Eigen::Index best = 0;
  (next.identification.shrink.cwiseQuotient(plan.identification.shrink)).minCoeff(&best);
  return std::size_t(best);
}
}  // namespace

std::string plan_text(const RecordPlan &plan)
{
  const twin::PlannedRecord &record = plan.record;
  std::string sensors;
  for (const std::string &sensor : plan.sensors)
    sensors += (sensors.empty() ? "" : ", ") + sensor;
  std::string text =
      fmt::format("Plan: {}; {}\n  {:.4g} s, force of {:.4g} kN rms up to {:.4g} Hz{}, noise of {:.3g} m/s2 per "
                  "root Hz, band {:.0f} to {:.0f} Hz\n",
                  plan.stand, sensors, record.duration, plan.force_rms / 1e3, record.force_highest,
                  record.force_recorded ? "" : ", not recorded", record.noise, record.low, record.high);
  std::size_t width = 6;
  for (const twin::Unknown &unknown : plan.unknowns)
    width = std::max(width, unknown.name.size());
  text += fmt::format("  {:<{}}    before      after     share\n", "unknown", width + 1);
  for (std::size_t i = 0; i < plan.unknowns.size(); ++i)
    text += fmt::format("  {:<{}}", plan.unknowns[i].name, width) +
            columns(plan.unknowns[i].prior_sd, plan.identification.shrink[Eigen::Index(i)]);
  if (!plan.ratios.empty())
    text += "  a ratio for each mode, in place of zeta\n";
  for (std::size_t i = 0; i < plan.ratios.size(); ++i)
    text += fmt::format("  {:<6} {:>9.1f} Hz", plan.ratios[i].name, plan.ratio_frequency[Eigen::Index(i)]) +
            columns(plan.ratios[i].prior_sd, plan.ratio_shrink[Eigen::Index(i)]);
  for (const std::string &direction : plan.unseen)
    text += "not seen: " + direction + "\n";
  if (plan.unseen.empty())
    text += "weakest direction that is seen: " + plan.weakest + "\n";
  for (std::size_t i = 0; i < plan.next.size(); ++i) {
    const std::size_t best = most_improved(plan, plan.next[i]);
    text +=
        fmt::format("{} a sensor at {}: {} to {:.2g} of the prior, now {:.2g}\n",
                    i == 0 ? "would help most:" : "                ", plan.places[std::size_t(plan.next[i].place)],
                    plan.identification.names[best], plan.next[i].identification.shrink[Eigen::Index(best)],
                    plan.identification.shrink[Eigen::Index(best)]);
  }
  for (const std::string &note : texts_of(plan.notes))
    text += "note: " + note + "\n";
  return text;
}

namespace {
nlohmann::ordered_json row_of(const twin::Unknown &unknown, const double shrink)
{
  return {{"name", unknown.name},
          {"prior_sd", unknown.prior_sd},
          {"sd", shrink * unknown.prior_sd},
          {"shrink", shrink},
          {"identified", shrink <= identified_up_to}};
}
}  // namespace

std::string plan_json(const RecordPlan &plan)
{
  const twin::PlannedRecord &record = plan.record;
  nlohmann::ordered_json document;
  document["schema"]  = 1;
  document["case"]    = plan.case_name;
  document["stand"]   = plan.stand;
  document["sensors"] = plan.sensors;
  document["record"]  = {{"duration_s", record.duration},          {"noise_m_s2_per_root_Hz", record.noise},
                         {"force_rms_N", plan.force_rms},          {"force_N_per_root_Hz", record.force_density},
                         {"force_up_to_Hz", record.force_highest}, {"force_recorded", record.force_recorded},
                         {"band_Hz", {record.low, record.high}}};
  auto &unknowns = document["unknowns"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < plan.unknowns.size(); ++i)
    unknowns.push_back(row_of(plan.unknowns[i], plan.identification.shrink[Eigen::Index(i)]));
  auto &ratios = document["ratios"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < plan.ratios.size(); ++i) {
    ratios.push_back(row_of(plan.ratios[i], plan.ratio_shrink[Eigen::Index(i)]));
    ratios.back()["frequency_Hz"] = plan.ratio_frequency[Eigen::Index(i)];
  }
  document["singular"] =
      std::vector<double>(plan.identification.singular.data(),
                          plan.identification.singular.data() + plan.identification.singular.size());
  document["unseen"]  = plan.unseen;
  document["weakest"] = plan.weakest;
  auto &next = document["next_sensors"] = nlohmann::ordered_json::array();
  for (const twin::NextSensor &sensor : plan.next) {
    const std::size_t best = most_improved(plan, sensor);
    next.push_back({{"place", plan.places[std::size_t(sensor.place)]},
                    {"gain_nats", sensor.gain},
                    {"improves", plan.identification.names[best]},
                    {"shrink", sensor.identification.shrink[Eigen::Index(best)]},
                    {"shrink_now", plan.identification.shrink[Eigen::Index(best)]}});
  }
  write_notes(document, plan.notes);
  return document.dump(2) + "\n";
}
}  // namespace mill
