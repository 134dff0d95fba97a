#include "app/twin/advice/measured_levels.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/base/valid_text.h"
#include "twin/cleaning/clean_record.h"
#include "twin/spectra/fourier.h"
#include "twin/spectra/welch.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <optional>

namespace fs = std::filesystem;

namespace mill {
namespace {
std::vector<std::string> records_in(const std::string &path)
{
  std::error_code error;
  if (fs::is_regular_file(path, error))
    return {path};
  if (!fs::is_directory(path, error))
    throw InputError("--measured " + path +
                     ": this folder does not exist; give the folder of the records, or one of them");
  std::vector<std::string> files;
  for (const std::string &name : names_in(path))
    if (const std::string file = (fs::path(path) / name).string();
        fs::is_regular_file(file, error) && twin::is_record_file(file))
      files.push_back(file);
  if (files.empty())
    throw InputError("--measured " + path +
                     ": the folder holds no record; one ends with .csv, .npy, .npz, .uff, .mat, .wav or .lvm "
                     "(.txt, .tsv, .asc, .dat, .unv)");
  std::sort(files.begin(), files.end());
  return files;
}

// One record that has a force.
struct SeenRecord {
  twin::WelchSpectrum force;
  double end      = 0;  // Hz, of the band of its force
  double duration = 0;  // s
  std::map<std::string, twin::WelchSpectrum> places;
};

std::optional<SeenRecord> seen(const std::string &file, const twin::ReadOptions &options, std::vector<Note> &notes)
{
  const twin::CleanRecord record = twin::clean_record(twin::read_record(file, options));
  const auto *force              = record.find("force");
  if (!force || force->quantity != twin::Quantity::force) {
    notes.emplace_back(NoteId::record_left_out, "", valid_text(file) + " has no channel force and was left out");
    return std::nullopt;
  }
  SeenRecord s;
  twin::Fourier fourier;
  s.force = twin::welch(force->value, force->pieces, record.rate, 0, fourier);
  if (s.force.n == 0) {
    notes.emplace_back(NoteId::record_left_out, "",
                       "the force of " + valid_text(file) +
                           " is too short in one piece for a spectrum, and was left out");
    return std::nullopt;
  }
  if (force->clipped > 0)
    notes.emplace_back(NoteId::clipped, "",
                       fmt::format("the force of {} is clipped ({} samples)", valid_text(file), force->clipped),
                       "levels are lower bounds");
  s.end      = twin::bandwidth(s.force);
  s.duration = double(force->n_used()) / record.rate;
  for (const twin::CleanChannel &channel : record.channels)
    if (channel.quantity == twin::Quantity::acceleration)
      if (auto spectrum = twin::welch(channel.value, channel.pieces, record.rate, 0, fourier); spectrum.n > 0)
        s.places.emplace(channel.name, std::move(spectrum));
  return s;
}

double mean_square(const twin::WelchSpectrum &spectrum, const double low, const double high)
{
  double square = 0;
  for (Eigen::Index k = 0; k < spectrum.density.size(); ++k)
    if (spectrum.at(k) >= low && spectrum.at(k) <= high)
      square += spectrum.density[k] * spectrum.resolution();
  return square;
}
}  // namespace

MeasuredLevels measured_levels(const std::string &path, const twin::ReadOptions &options, const double low,
                               const double high, const double step)
{
  MeasuredLevels m;
  std::vector<SeenRecord> all;
  double end = high;
  for (const std::string &file : records_in(path))
    if (auto one = seen(file, options, m.notes)) {
      end = std::min(end, one->end);
      m.duration += one->duration;
      m.resolution = std::max(m.resolution, one->force.resolution());
      m.files.push_back(valid_text(file));
      all.push_back(std::move(*one));
    }
  if (all.empty())
    throw InputError("--measured " + path +
                     ": no record there has a channel force; name the column of the rolling force with --channel "
                     "COLUMN=force" +
                     (m.notes.empty() ? "" : " (" + text_of(m.notes.front()) + ")"));
  if (!(end > low))
    throw InputError(
        fmt::format("--measured {}: the force was recorded up to {:.4g} Hz, and advice.band begins at "
                    "{:.4g} Hz; choose a lower band or records of a higher rate",
                    path, end, low));
  if (end < high)
    m.notes.emplace_back(NoteId::band_limited, "", fmt::format("the force was recorded up to {:.4g} Hz", end),
                         fmt::format("the band ends there, not at {:.4g} Hz", high));
  std::map<std::string, std::array<double, 2>> squares;  // mean square times length, length
  for (const SeenRecord &one : all) {
    const twin::ForceBand band = twin::measured_force(one.force, low, end, step);
    if (m.force.square.size() == 0) {
      m.force = band;
      m.force.square.setZero();
    }
    m.force.square += one.duration / m.duration * band.square;
    for (const auto &[place, spectrum] : one.places) {
      squares[place][0] += one.duration * mean_square(spectrum, low, end);
      squares[place][1] += one.duration;
    }
  }
  for (const auto &[place, sums] : squares)
    m.level[place] = std::sqrt(sums[0] / sums[1]);
  return m;
}
}  // namespace mill
