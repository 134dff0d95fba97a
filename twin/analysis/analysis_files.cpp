#include "twin/analysis/analysis_files.h"
#include "core/base/si_unit.h"
#include "core/records/compared_bands.h"
#include "core/records/csv_cell.h"
#include "core/records/note_records.h"
#include "core/records/results.h"
#include "core/records/rows_of_response.h"
#include "core/records/source_location.h"
#include "twin/analysis/channel_analysis.h"
#include "twin/spectra/level_error.h"
#include "twin/spectra/noise_floor.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill::twin {
namespace {
using nlohmann::ordered_json;

const char *const no_level_over_time    = "the record is too short for a level over time";
constexpr Eigen::Index most_rows_of_map = 250, most_columns_of_map = 150;  // frequencies, frames

Parameter measured(const double value, const std::string &unit, const std::string &operating_point,
                   const std::string &method)
{
  Parameter parameter;
  parameter.value  = value;
  parameter.unit   = unit;
  parameter.source = Source::measured;
  parameter.method = method;
  parameter.at     = operating_point;
  return parameter;
}

// Relative standard deviation of the rms of a stationary record: half that of its variance.
double scatter_of_rms(const WelchSpectrum &s, const double duration)
{
  const double area = s.density.sum(), squares = s.density.squaredNorm();
  return area > 0 ? 0.5 * std::sqrt(squares / (s.resolution() * duration)) / area : std::nan("");
}

// The change of the rms velocity against an earlier record, and the levels in the bands.
void add_levels(Results &results, const ChannelAnalysis &seen, const std::string &operating_point,
                const double rate, const double velocity_error, const AnalysisSettings &settings)
{
  for (std::size_t i = 0; i < seen.band_rms.size() && i < settings.bands.size(); ++i)
    if (const ChatterBand &band = settings.bands[i];
        std::isfinite(seen.band_rms[i]) && is_vibration(seen.quantity)) {
      Parameter level =
          measured(seen.band_rms[i], seen.unit, operating_point,
                   fmt::format("root of the area under the density, {:g} to {:g} Hz", band.low, band.high));
      level.error_estimate = level_error(seen.map, band.low, band.high);
      if (!std::isfinite(level.error_estimate))
        level.error_lacks = {no_level_over_time};
      results.add(row::record::band_rms.of(seen.name, band.name), level);
    }
  if (!settings.baseline || !std::isfinite(seen.velocity_rms))
    return;
  const double before = velocity_before(*settings.baseline, seen.name, rate);
  if (!std::isfinite(before))
    return;
  Parameter change      = measured(seen.velocity_rms / before, "1", operating_point,
                                   "rms velocity over that of the baseline " + settings.baseline->record);
  change.error_estimate = std::sqrt(2.0) * velocity_error;
  if (!std::isfinite(change.error_estimate))
    change.error_lacks = {no_level_over_time};
  results.add(row::record::velocity_rms_ratio.of(seen.name), change);
}

void add_values(Results &results, const ChannelAnalysis &seen, const CleanChannel &channel,
                const CleanRecord &record, const AnalysisSettings &settings)
{
  const double used                 = double(channel.n_used()) / record.rate;
  const std::string operating_point = fmt::format("{:.4g} s of the record", used);
  Parameter rms = measured(seen.rms, seen.unit, operating_point, "samples, offset and drift taken off");
  if (seen.spectrum.n > 0) {
    rms.error_estimate = scatter_of_rms(seen.spectrum, used);
    rms.checks.push_back({"root of the area under the density",
                          std::sqrt(seen.spectrum.density.sum() * seen.spectrum.resolution()),
                          "slow parts below the first bin are not in it"});
  }
  results.add(row::record::rms.of(seen.name), rms);
  Parameter peak =
      measured(seen.peak, seen.unit, operating_point,
               channel.clipped > 0 ? "largest sample: a lower bound, since it is clipped" : "largest sample");
  peak.error_lacks = {"one record has one largest sample"};
  results.add(row::record::peak.of(seen.name), peak);
  Parameter crest   = measured(seen.crest, "1", operating_point, "peak over rms");
  crest.error_lacks = peak.error_lacks;
  results.add(row::record::crest.of(seen.name), crest);
  Parameter drift =
      measured(channel.drift, seen.unit + "/s", operating_point, "slope of the line through the channel");
  drift.error_lacks = {"what moves the offset of a sensor"};
  results.add(row::record::drift.of(seen.name), drift);
  Parameter clipped =
      measured(channel.clipped_share, "1", operating_point, "share of the samples at a clip level");
  clipped.error_estimate = 0;
  results.add(row::record::clipped.of(seen.name), clipped);
  double velocity_error = std::nan("");
  if (std::isfinite(seen.velocity_rms)) {
    const VelocityBand band = velocity_band(record.rate);
    velocity_error          = level_error(seen.map, band.low, band.high, seen.quantity == Quantity::acceleration);
    Parameter velocity =
        measured(seen.velocity_rms, "m/s", operating_point,
                 fmt::format("density from {:g} to {:.4g} Hz{}, divided by (2 pi f)^2 for an acceleration",
                             band.low, band.high, band.complete ? "" : ", where the record ends"));
    velocity.error_estimate = velocity_error;
    if (!std::isfinite(velocity_error))
      velocity.error_lacks = {no_level_over_time};
    results.add(row::record::velocity_rms.of(seen.name), velocity);
  }
  add_levels(results, seen, operating_point, record.rate, velocity_error, settings);
}

ordered_json number(const double value)
{
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

/// Relative standard error of the amplitude of a finding; NaN without a level over time.
double amplitude_error(const Analysis &analysis, const Finding &finding)
{
  for (const ChannelAnalysis &seen : analysis.channels)
    if (seen.name == finding.channel && finding.frequency > 0)
      return level_error(seen.map, std::min(finding.low, finding.frequency),
                         std::max(finding.high, finding.frequency));
  return std::nan("");
}

ordered_json json_of(const Analysis &analysis, const Finding &finding)
{
  ordered_json json{{"kind", word_of(finding.kind)},
                    {"channel", finding.channel},
                    {"frequency", number(finding.frequency)},
                    {"interval", {number(finding.low), number(finding.high)}},
                    {"amplitude", number(finding.amplitude)},
                    {"amplitude_error", number(amplitude_error(analysis, finding))},
                    {"unit", finding.unit},
                    {"owner", finding.owner},
                    {"evidence", finding.evidence}};
  if (finding.members.empty())
    return json;
  json["orders"] = ordered_json::array();
  json["lines"]  = ordered_json::array();
  for (const FamilyMember &member : finding.members) {
    if (member.order > 0)
      json["orders"].push_back(member.order);
    json["lines"].push_back({{"frequency", member.frequency}, {"amplitude", member.amplitude}});
  }
  return json;
}

// Shares in per cent, their sum is 100.
ordered_json json_of(const ChannelAnalysis &seen)
{
  const Account &account = seen.account;
  return {{"channel", seen.name},
          {"variance", seen.variance},
          {"lines", 100 * account.lines},
          {"families", 100 * account.families},
          {"modes", 100 * account.modes},
          {"floor", 100 * account.floor},
          {"not_explained", 100 * account.unexplained},
          {"largest",
           {{"frequency", number(account.largest)},
            {"amplitude", number(account.amplitude)},
            {"unit", seen.unit},
            {"over_floor", number(account.over_floor)},
            {"source", account.source}}},
          {"only_noise", account.only_noise()},
          {"threshold", number(seen.detected.threshold)},
          {"false_alarm", false_alarm}};
}

/// Relative standard errors of the rms velocity in the bands that comparisons of analyses use.
ordered_json level_errors(const ChannelAnalysis &seen)
{
  ordered_json all = ordered_json::array();
  if (is_in(seen.unit, SiUnit::acceleration) || is_in(seen.unit, SiUnit::speed))
    for (const ComparedBand &band : compared_bands)
      all.push_back(
          {{"band", {band.low, band.high}},
           {"error", number(level_error(seen.map, band.low, band.high, is_in(seen.unit, SiUnit::acceleration)))}});
  return all;
}

ordered_json conventions_of(const ChannelAnalysis &seen)
{
  const auto band = seen.spectrum.n > 0 ? seen.spectrum.band() : std::array<double, 2>{0, 0};
  return {{"channel", seen.name},
          {"quantity", name_of(seen.quantity)},
          {"unit", seen.unit},
          {"window", "Hann, periodic"},
          {"L", seen.spectrum.L},
          {"segments", seen.spectrum.n},
          {"enbw", seen.spectrum.L > 0 ? number(seen.spectrum.enbw()) : ordered_json(nullptr)},
          {"dof", seen.spectrum.n > 0 ? number(seen.spectrum.dof()) : ordered_json(nullptr)},
          {"band", {band[0], band[1]}},
          {"density", "one-sided, unit^2/Hz"},
          {"level_errors", level_errors(seen)},
          {"bandwidth", number(seen.bandwidth)}};
}

// Largest of each group of bins, so that lines stay.
Eigen::MatrixXf coarser(const Eigen::MatrixXf &map, const Eigen::Index rows, const Eigen::Index columns)
{
  const Eigen::Index by = (map.rows() + rows - 1) / rows, bx = (map.cols() + columns - 1) / columns;
  Eigen::MatrixXf small((map.rows() + by - 1) / by, (map.cols() + bx - 1) / bx);
  for (Eigen::Index i = 0; i < small.rows(); ++i)
    for (Eigen::Index j = 0; j < small.cols(); ++j)
      small(i, j) = map.block(i * by, j * bx, std::min(by, map.rows() - i * by), std::min(bx, map.cols() - j * bx))
                        .maxCoeff();
  return small;
}

Table spectrum_table(const Analysis &analysis, const WelchSpectrum ChannelAnalysis::*which,
                     const std::string &axis, const std::string &unit)
{
  Table table;
  for (const ChannelAnalysis &seen : analysis.channels) {
    const WelchSpectrum &s = seen.*which;
    if (s.n == 0 || (!table.columns.empty() && s.density.size() != table.columns[0].size()))
      continue;
    if (table.columns.empty())
      table.add(axis, unit, Eigen::VectorXd::LinSpaced(s.density.size(), 0, s.rate / 2));
    table.add(seen.name, "(" + seen.unit + ")^2/" + (is_in(unit, SiUnit::hertz) ? "Hz" : "(1/m)"), s.density);
  }
  return table;
}

Table waterfall_table(const Analysis &analysis)
{
  Table table;
  for (const ChannelAnalysis &seen : analysis.channels) {
    if (!is_vibration(seen.quantity) || seen.map.density.cols() == 0)
      continue;
    const Eigen::MatrixXf small = coarser(seen.map.density, most_rows_of_map, most_columns_of_map);
    const Eigen::Index by       = (seen.map.density.rows() + most_rows_of_map - 1) / most_rows_of_map,
                       bx       = (seen.map.density.cols() + most_columns_of_map - 1) / most_columns_of_map;
    const Eigen::Index n        = small.size();
    if (table.columns.empty()) {
      Eigen::VectorXd time(n), frequency(n), speed(n);
      for (Eigen::Index j = 0; j < small.cols(); ++j)
        for (Eigen::Index i = 0; i < small.rows(); ++i) {
          const Eigen::Index index = j * small.rows() + i;
          time[index]              = seen.map.time[j * bx];
          frequency[index]         = double(i * by) * seen.map.rate / double(seen.map.L);
          speed[index]             = seen.map.speed.size() > 0 ? seen.map.speed[j * bx] : 0;
        }
      table.add("time", "s", time).add("frequency", "Hz", frequency);
      if (seen.map.speed.size() > 0)
        table.add("speed", "m/s", speed);
    }
    if (n == table.columns[0].size())
      table.add(seen.name, "(" + seen.unit + ")^2/Hz",
                Eigen::Map<const Eigen::VectorXf>(small.data(), n).cast<double>());
  }
  return table;
}

Table mode_table(const Analysis &analysis)
{
  const auto &modes = analysis.modes.modes;
  const auto n      = Eigen::Index(modes.size());
  const auto column = [&](const auto &value) {
    Eigen::VectorXd x(n);
    for (Eigen::Index i = 0; i < n; ++i)
      x[i] = value(modes[std::size_t(i)]);
    return x;
  };
  Table table;
  table.add("frequency", "Hz", column([](const auto &m) { return m.frequency; }))
      .add("frequency_law", "Hz", column([](const auto &m) { return m.law_frequency; }))
      .add("damping", "1", column([](const auto &m) { return m.damping; }))
      .add("damping_law", "1", column([](const auto &m) { return m.law_damping; }))
      .add("orders", "1", column([](const auto &m) { return double(m.orders); }))
      .add("confirmed", "1", column([](const auto &m) { return double(m.confirmed); }));
  for (std::size_t c = 0; c < analysis.mode_channels.size(); ++c) {
    table.add(analysis.mode_channels[c] + "_real", "1",
              column([&](const auto &m) { return m.shape[Eigen::Index(c)].real(); }));
    table.add(analysis.mode_channels[c] + "_imag", "1",
              column([&](const auto &m) { return m.shape[Eigen::Index(c)].imag(); }));
  }
  return table;
}

Table pole_table(const Analysis &analysis)
{
  const auto &poles = analysis.modes.poles;
  Eigen::VectorXd order(Eigen::Index(poles.size())), frequency(order.size()), damping(order.size()),
      stable(order.size()), confirmed(order.size());
  for (Eigen::Index i = 0; i < order.size(); ++i) {
    const SubspacePole &pole = poles[std::size_t(i)];
    order[i]                 = pole.order;
    frequency[i]             = pole.frequency;
    damping[i]               = pole.damping;
    stable[i]                = pole.stable;
    confirmed[i]             = pole.confirmed;
  }
  Table table;
  return table.add("order", "1", order)
      .add("frequency", "Hz", frequency)
      .add("damping", "1", damping)
      .add("stable", "1", stable)
      .add("confirmed", "1", confirmed);
}

Table singular_table(const Analysis &analysis)
{
  Table table;
  return table.add("frequency", "Hz", analysis.modes.singular.frequency)
      .add("first_singular_value", "1/Hz", analysis.modes.singular.value);
}

std::string unit_of_response(const Analysis &analysis)
{
  for (const ChannelAnalysis &seen : analysis.channels)
    if (!analysis.mode_channels.empty() && seen.name == analysis.mode_channels.front())
      return "(" + seen.unit + ")/N";
  return "1/N";
}

// H1 and coherence of every channel, up to where modes are looked for.
Table response_table(const Analysis &analysis)
{
  const ForceResponse &r = analysis.forced.response;
  const auto n           = std::min(r.H.rows(), Eigen::Index(1000 / r.resolution()) + 1) - 1;  // without the mean
  Table table;
  table.add("frequency", "Hz", Eigen::VectorXd::LinSpaced(n, 1, double(n)) * r.resolution())
      .add("force", "N^2/Hz", r.force.segment(1, n));
  for (std::size_t c = 0; c < analysis.mode_channels.size(); ++c) {
    const std::string &name = analysis.mode_channels[c];
    const auto H            = r.H.col(Eigen::Index(c)).segment(1, n);
    table.add(name + "_real", unit_of_response(analysis), H.real())
        .add(name + "_imag", unit_of_response(analysis), H.imag())
        .add(name + "_coherence", "1", r.coherence.col(Eigen::Index(c)).segment(1, n));
  }
  return table;
}

Table forced_mode_table(const Analysis &analysis)
{
  const auto &modes = analysis.forced.modes;
  const auto column = [&](const auto &value) {
    Eigen::VectorXd x(Eigen::Index(modes.size()));
    for (Eigen::Index i = 0; i < x.size(); ++i)
      x[i] = value(modes[std::size_t(i)]);
    return x;
  };
  Table table;
  table.add("frequency", "Hz", column([](const auto &m) { return m.frequency; }))
      .add("frequency_sd", "Hz", column([](const auto &m) { return m.sd_frequency; }))
      .add("damping", "1", column([](const auto &m) { return m.damping; }))
      .add("damping_sd", "1", column([](const auto &m) { return m.sd_damping; }))
      .add("coherence", "1", column([](const auto &m) { return m.coherence; }))
      .add("confirmed", "1", column([](const auto &m) { return double(m.confirmed); }));
  for (std::size_t c = 0; c < analysis.mode_channels.size(); ++c) {
    const auto k = Eigen::Index(c);
    table.add(analysis.mode_channels[c] + "_real", "1", column([&](const auto &m) { return m.shape[k].real(); }))
        .add(analysis.mode_channels[c] + "_imag", "1", column([&](const auto &m) { return m.shape[k].imag(); }))
        .add(analysis.mode_channels[c] + "_sd", "1", column([&](const auto &m) { return m.sd_shape[k]; }));
  }
  return table;
}
}  // namespace

std::string analysis_json(const CleanRecord &record, const Analysis &analysis, const CaseModel *stand,
                          const AnalysisSettings &settings)
{
  Results results;
  for (std::size_t i = 0; i < analysis.channels.size(); ++i)
    add_values(results, analysis.channels[i], record.channels[i], record, settings);
  const std::string name = std::filesystem::path(record.file).stem().string();
  ordered_json json      = ordered_json::parse(results_json(results, name, "ok"));
  json["findings"]       = ordered_json::array();
  for (const Finding &finding : analysis.findings)
    json["findings"].push_back(json_of(analysis, finding));
  json["account"] = ordered_json::array();
  for (const ChannelAnalysis &seen : analysis.channels)
    if (seen.spectrum.n > 0)
      json["account"].push_back(json_of(seen));
  json["bearings"] = ordered_json::array();
  for (const BearingScore &one : analysis.bearings)
    json["bearings"].push_back({{"channel", one.channel},
                                {"bearing", one.bearing},
                                {"roll", one.roll},
                                {"family", one.family},
                                {"frequency", one.frequency},
                                {"slip", one.slip},
                                {"score", one.score},
                                {"speed", one.speed},
                                {"band", {one.low, one.high}},
                                {"kurtosis", one.kurtosis}});
  json["response_to_force"] =
      analysis.forced.response.n == 0
          ? ordered_json(nullptr)
          : ordered_json{{"window", "Hann, periodic"},
                         {"L", analysis.forced.response.L},
                         {"rate", analysis.forced.response.rate},
                         {"segments", analysis.forced.response.n},
                         {"enbw", 1.5 * analysis.forced.response.resolution()},
                         {"delay", analysis.delay.identified ? ordered_json(analysis.delay.seconds)
                                                             : ordered_json(nullptr)},
                         {"delay_sd", analysis.delay.identified ? ordered_json(analysis.delay.deviation)
                                                                : ordered_json(nullptr)},
                         {"aligned", settings.align},
                         {"best_coherence", analysis.forced.best_coherence}};
  json["baseline"]      = settings.baseline ? ordered_json{{"folder", settings.baseline->folder},
                                                      {"record", settings.baseline->record}}
                                            : ordered_json(nullptr);
  json["record"]        = {{"file", record.file},
                           {"format", record.format},
                           {"rate", record.rate},
                           {"duration", record.duration()},
                           {"jitter", record.jitter},
                           {"interpolated", record.interpolated},
                           {"start", record.start ? ordered_json(*record.start) : ordered_json(nullptr)},
                           {"speed", {number(analysis.lowest_speed), number(analysis.highest_speed)}}};
  json[source_location] = location_of(record.file);
  json["stand"] = stand ? ordered_json{{"case", stand->name}, {"source", stand->source}} : ordered_json(nullptr);
  json["cleaning"] = ordered_json::array();
  for (const CleaningEvent &event : record.events)
    json["cleaning"].push_back({{"channel", event.channel},
                                {"fault", word_of(event.fault)},
                                {"from", event.from},
                                {"to", event.to},
                                {"count", event.count},
                                {"done", event.done}});
  json["described"] = ordered_json::array();
  for (const DescribedChannel &channel : record.described)
    json["described"].push_back({{"channel", channel.name}, {"kind", channel.kind}, {"what", channel.sentence}});
  json["labels"] = ordered_json::array();
  for (const Label &label : record.labels)
    json["labels"].push_back(
        {{"column", label.column}, {"text", label.text}, {"from", label.from}, {"to", label.to}});
  json["conventions"] = ordered_json::array();
  for (const ChannelAnalysis &seen : analysis.channels)
    json["conventions"].push_back(conventions_of(seen));
  std::vector<Note> notes;
  for (const std::string &note : record.notes)
    notes.push_back(Warning{WarningId::record_repaired, "", note});
  notes.insert(notes.end(), analysis.notes.begin(), analysis.notes.end());
  write_notes(json, notes);
  return json.dump(1) + "\n";
}

std::string candidates_csv(const Analysis &analysis)
{
  const auto cell = [](const double value, const char *form) {
    return std::isfinite(value) ? fmt::format(fmt::runtime(form), value) : std::string();
  };
  std::string text = "channel,frequency [Hz],amplitude,unit,over the floor [dB],fate,reason\n";
  for (const CandidateFate &one : analysis.candidates)
    text += csv_cell(one.channel) + "," + cell(one.frequency, "{:.9g}") + "," + cell(one.amplitude, "{:.5g}") +
            "," + csv_cell(one.unit) + "," + cell(one.over_floor, "{:.1f}") + "," + csv_cell(word_of(one.fate)) +
            "," + csv_cell(one.reason) + "\n";
  return text;
}

std::map<std::string, Table> analysis_tables(const Analysis &analysis)
{
  std::map<std::string, Table> tables{
      {"spectrum", spectrum_table(analysis, &ChannelAnalysis::spectrum, "frequency", "Hz")},
      {"waterfall", waterfall_table(analysis)},
      {"modes", mode_table(analysis)},
      {"poles", pole_table(analysis)}};
  if (Table length = spectrum_table(analysis, &ChannelAnalysis::length, "per_length", "1/m");
      !length.columns.empty())
    tables.emplace("distance", std::move(length));
  if (analysis.modes.singular.frequency.size() > 0)
    tables.emplace("singular", singular_table(analysis));
  if (analysis.forced.response.n > 0) {
    tables.emplace("h1", response_table(analysis));
    tables.emplace("modes_h1", forced_mode_table(analysis));
  }
  return tables;
}
}  // namespace mill::twin
