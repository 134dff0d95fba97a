#include "core/base/file_ending.h"
#include "core/base/valid_text.h"
#include "twin/records/channel_names.h"
#include "twin/records/raw_record.h"
#include "twin/records/sampling_rate.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

namespace mill::twin {
namespace {
using Reader = RawRecord (*)(const std::string &, const ReadOptions &);

const std::vector<std::pair<std::string, Reader>> &readers()
{
  static const std::vector<std::pair<std::string, Reader>> all{
      {".csv", read_csv_record}, {".txt", read_csv_record}, {".tsv", read_csv_record}, {".asc", read_csv_record},
      {".npy", read_npy_record}, {".npz", read_npz_record}, {".uff", read_uff_record}, {".unv", read_uff_record},
      {".mat", read_mat_record}, {".wav", read_wav_record}, {".lvm", read_lvm_record}};
  return all;
}

std::string ending_of(const std::string &path)
{
  return lower(std::filesystem::path(path).extension().string());
}

// Several recorders call their texts .dat, and others their binary files.
bool begins_as_text(const std::string &path)
{
  std::ifstream file(path, std::ios::binary);
  char bytes[4096];
  file.read(bytes, sizeof bytes);
  const std::string begin(bytes, std::size_t(file.gcount()));
  return utf16_of_mark(begin) || std::none_of(begin.begin(), begin.end(), [](const unsigned char c) {
           return c < ' ' && c != '\t' && c != '\n' && c != '\r' && c != '\f';
         });
}

// An ending that texts and files of single programs have.
bool is_of_any_program(const std::string &path)
{
  return ending_of(path) == word_of(FileEnding::dat);
}

// By the ending of the name; nullptr: no format has this ending.
Reader reader_of(const std::string &path)
{
  const std::string ending = ending_of(path);
  if (is_of_any_program(path))
    return begins_as_text(path) ? read_csv_record : nullptr;
  for (const auto &[known, reader] : readers())
    if (ending == known)
      return reader;
  return nullptr;
}

RawRecord read_any(const std::string &path, const ReadOptions &options)
{
  if (const Reader reader = reader_of(path))
    return reader(path, options);
  if (is_of_any_program(path))
    throw InputError(path + ": this .dat file is not a text; export it as CSV in the program of its recorder "
                            "(ibaPDA: ibaAnalyzer)");
  throw InputError(fmt::format(
      "{}: records are .csv, .txt, .tsv, .asc, .dat in text, .npy with .json, .npz, .uff, .unv, .mat, .wav "
      "or .lvm; export others (ibaPDA, TDMS, Parquet) as CSV",
      path));
}

// Texts of the user and of the file enter every result: from here on they are valid UTF-8.
void make_texts_valid(RawRecord &record)
{
  record.file = valid_text(record.file);
  for (std::string &note : record.notes)
    note = valid_text(note);
  for (RawChannel &channel : record.channels) {
    channel.name   = valid_text(channel.name);
    channel.column = valid_text(channel.column);
    channel.unit   = valid_text(channel.unit);
  }
}

// A sampling rate that no recorder has would ask for endless time or memory.
void require_possible_times(const RawRecord &record)
{
  if (record.time.size() == 0)
    return require_possible_rate(record.rate, record.file);
  const Eigen::Index n = record.time.size();
  const double length  = record.time[n - 1] - record.time[0];
  if (length > 0)
    require_possible_rate(double(n - 1) / length, record.file);
}

// Its line is shown; binary files have none.
Place place_of_first_line(const RawRecord &record, const std::string &path)
{
  const bool is_text = !record.channels.empty() && record.channels.front().place.line > 0;
  return is_text ? Place{path, 1, 1} : Place{path, 0, 0};
}

void require_increasing(const RawRecord &record)
{
  for (Eigen::Index i = 1; i < record.time.size(); ++i)
    if (!(record.time[i] >= record.time[i - 1]))
      throw InputError(
          record.time_place,
          fmt::format("the time goes backwards at sample {}, by {:.4g} s; sort the samples by time, or "
                      "split the record where the recorder started again",
                      i + 1, record.time[i - 1] - record.time[i]));
}
}  // namespace

bool is_record_file(const std::string &path)
{
  return reader_of(path) != nullptr;
}

bool is_csv_record(const std::string &path)
{
  return reader_of(path) == read_csv_record;
}

RawRecord read_record(const std::string &path, const ReadOptions &options)
{
  if (options.rate && !(*options.rate > 0 && std::isfinite(*options.rate)))
    throw InputError(fmt::format("--rate {} is not above zero", *options.rate));
  if (options.rate)
    require_possible_rate(*options.rate, "--rate");
  RawRecord record = read_any(path, options);
  make_texts_valid(record);
  require_increasing(record);
  require_possible_times(record);
  if (record.n_samples() < options.fewest_samples)
    throw InputError(place_of_first_line(record, path),
                     fmt::format("the record has {} sample{}; at least {} are needed{}", record.n_samples(),
                                 record.n_samples() == 1 ? "" : "s", options.fewest_samples,
                                 options.from_case ? "" : " for a spectrum"));
  return record;
}
}  // namespace mill::twin
