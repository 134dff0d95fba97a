#include "twin/calibration/calibration_files.h"
#include "core/records/calibration_status.h"
#include "core/records/note_records.h"
#include "core/records/results.h"
#include "core/records/rows_of_response.h"
#include "twin/calibration/words.h"
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill::twin {
namespace {
using nlohmann::ordered_json;

const std::string all_sensors = "all sensors together";

ordered_json finite(const double value)
{
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

Results values_of(const Calibration &result, const bool written)
{
  Results values;
  const OperatingPoint operating_point("{} of the records", {{result.fit_seconds, "s", ".4g"}});
  for (const Calibrated &u : result.unknowns) {
    const bool delay            = moves(u) == Moves::delay;
    const ChangeInterval change = change_interval(u, written);
    Parameter p;
    p.value          = delay ? change.value : std::exp(change.value);
    p.unit           = delay ? "s" : "1";
    p.source         = u.taken ? Source::measured : Source::assumed;
    p.method         = u.identified ? "likelihood of the whole records" : u.why_not;
    p.at             = operating_point;
    p.error_estimate = delay ? std::nan("") : u.taken ? deviation_of(change) : u.prior_sd;
    if (delay)
      p.error_lacks = {"a delay has no relative error; its deviation is listed with the unknowns"};
    if (u.taken && !delay)
      p.checks = {{"95 % from", std::exp(change.low), ""},
                  {"95 % to", std::exp(change.high), ""},
                  {"with all freed", std::exp(u.estimate), "with what is not identified free as well"}};
    values.add(delay ? row::calibration::delay.of() : row::calibration::factor.of(u.name), p);
  }
  const auto misfit = [&](const RowOf<0> &row, const double value, const std::string &of, const double seconds) {
    Parameter p;
    p.value       = value;
    p.unit        = "1";
    p.source      = Source::measured;
    p.method      = of;
    p.at          = {"{} of the records", {{seconds, "s", ".4g"}}};
    p.error_lacks = {"one record has one misfit"};
    values.add(row.of(), p);
  };
  misfit(row::calibration::misfit_before, result.check.before,
         result.force_recorded() ? "mean of |r|^2 over the noise of the fit, case without changes"
                                 : "the same, of what one force does not explain, case without changes",
         result.check_seconds);
  misfit(row::calibration::misfit_after, result.check.after, "the same, calibrated case", result.check_seconds);
  misfit(row::calibration::worst_band_fit, result.fit.worst,
         "residual over noise and model error, over its limit, largest of all bands", result.fit_seconds);
  misfit(row::calibration::worst_band_check, result.check.worst, "the same of the check records",
         result.check_seconds);
  return values;
}

ordered_json unknowns_of(const CalibrationInput &input, const Calibration &result, const bool written)
{
  ordered_json all = ordered_json::array();
  for (std::size_t i = 0; i < result.unknowns.size(); ++i) {
    const Calibrated &u     = result.unknowns[i];
    const ShownChange shown = shown_change(u, written);
    all.push_back({{"name", u.name},
                   {"prior", finite(input.unknowns[i].prior)},
                   {"prior_sd", finite(u.prior_sd)},
                   {"estimate", finite(u.estimate)},
                   {"sd", finite(u.sd)},
                   {"interval", {finite(u.low), finite(u.high)}},

                   {"shrink", finite(u.shrink)},
                   {"moved", finite((u.estimate - input.unknowns[i].prior) / u.prior_sd)},
                   {"identified", u.identified},
                   {"taken", u.taken},
                   {"kept", finite(u.kept)},
                   {"shown", {{"value", shown.value}, {"low", shown.low}, {"high", shown.high}}},
                   {"why_not", u.why_not}});
  }
  return all;
}

ordered_json modes_of(const Calibration &result)
{
  ordered_json all = ordered_json::array();
  for (const PredictedMode &mode : result.modes)
    all.push_back({{"before", finite(mode.before)},
                   {"frequency", finite(mode.frequency)},
                   {"interval", {finite(mode.low), finite(mode.high)}},
                   {"determined", mode.determined()},
                   {"rests_on", mode.rests_on}});
  return all;
}

ordered_json bands_of(const CalibrationInput &input, const RecordFit &fit)
{
  ordered_json all = ordered_json::array();
  for (const BandResidual &band : fit.bands)
    all.push_back({{"centre", finite(band.centre)},
                   {"sensor", band.sensor < 0 ? all_sensors : input.sensors[std::size_t(band.sensor)]},
                   {"bins", band.bins},
                   {"energy", finite(band.energy)},
                   {"left", finite(band.left)},
                   {"floor", finite(band.floor)},
                   {"ratio", finite(band.ratio)},
                   {"limit", finite(band.limit)},
                   {"counts", band.decisive}});
  return all;
}

ordered_json levels_of(const RecordFit &fit)
{
  ordered_json all = ordered_json::array();
  for (const LevelBand &band : fit.levels)
    all.push_back({{"centre", finite(band.centre)},
                   {"bins", band.bins},
                   {"ratio", finite(band.ratio)},
                   {"limit", finite(band.limit)},
                   {"energy", finite(band.energy)},
                   {"counts", band.decisive}});
  return all;
}

ordered_json rows_of_matrix(const Eigen::MatrixXd &matrix)
{
  ordered_json rows = ordered_json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    ordered_json row = ordered_json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      row.push_back(finite(matrix(i, j)));
    rows.push_back(row);
  }
  return rows;
}
}  // namespace

std::string calibration_status(const Calibration &result, const bool accepted)
{
  if (!result.refusals.empty())
    return word_of(accepted ? CalibrationStatus::accepted : CalibrationStatus::refused);
  return word_of(result.agrees ? CalibrationStatus::agrees : CalibrationStatus::ok);
}

bool is_written(const Calibration &result, const bool accepted)
{
  return result.refusals.empty() ? !result.agrees : accepted;
}

std::string calibration_json(const CalibrationInput &input, const Calibration &result,
                             const CalibrationFacts &facts)
{
  const bool written    = is_written(result, facts.accepted);
  ordered_json document = ordered_json::parse(
      results_json(values_of(result, written), facts.case_name, calibration_status(result, facts.accepted)));
  document["stand"]       = facts.stand;
  document["records"]     = facts.files;
  document["sensors"]     = input.sensors;
  document["band"]        = {input.low, input.high};
  document["rate"]        = input.rate;
  document["seconds"]     = {result.fit_seconds, result.check_seconds};
  document["model_error"] = input.model_error;
  document["unknowns"]    = unknowns_of(input, result, written);
  document["modes"]       = modes_of(result);
  document["unseen"]      = result.unseen;
  ordered_json singular   = ordered_json::array();
  for (Eigen::Index i = 0; i < result.identification.singular.size(); ++i)
    singular.push_back(finite(result.identification.singular[i]));
  document["singular"]    = singular;
  document["correlation"] = rows_of_matrix(result.correlation);
  ordered_json basins     = ordered_json::array();
  for (const Basin &basin : result.scan.basins)
    basins.push_back({{"name", basin.name}, {"theta", finite(basin.theta)}, {"deviance", finite(basin.deviance)}});
  document["basins"]        = basins;
  document["kept_deviance"] = finite(result.kept_deviance);
  document["case_deviance"] = finite(result.case_deviance);
  if (result.delay)
    document["delay"] = {{"seconds", finite(result.delay->seconds)},
                         {"sd", finite(result.delay->deviation)},
                         {"limit", finite(result.delay->limit)}};
  document["bands"]          = {{"fit", bands_of(input, result.fit)}, {"check", bands_of(input, result.check)}};
  document["force_recorded"] = result.force_recorded();
  if (!result.force_recorded()) {
    document["without_force"] = without_force_words();
    document["levels"]        = {{"fit", levels_of(result.fit)}, {"check", levels_of(result.check)}};
  }
  document["refusals"] = result.refusals;
  write_notes(document, facts.notes);
  document["written"] = facts.written;
  return document.dump(2) + "\n";
}

std::map<std::string, Table> calibration_tables(const Calibration &result)
{
  std::map<std::string, Table> tables;
  if (!result.response.columns.empty())
    tables.emplace("response", result.response);
  if (!result.force_recorded()) {
    const EstimatedForce &f   = result.force;
    const Eigen::VectorXd mid = f.density.cwiseSqrt(), reach = (0.98 * f.sd).array().exp().matrix();
    Table force;  // amplitudes: half the logarithm, 1.96 sd
    force.add("frequency", "Hz", f.frequency);
    force.add("density", "N/sqrt(Hz)", mid);
    force.add("low", "N/sqrt(Hz)", mid.cwiseQuotient(reach));
    force.add("high", "N/sqrt(Hz)", mid.cwiseProduct(reach));
    tables.emplace("force", force);
  }
  Table profiles;
  for (const Profile &profile : result.scan.profiles) {
    profiles.add(profile.name + ".theta", "", profile.theta);
    profiles.add(profile.name + ".deviance", "", profile.deviance);
  }
  if (!profiles.columns.empty())
    tables.emplace("profiles", profiles);
  return tables;
}
}  // namespace mill::twin
