#include "twin/records/channel_names.h"
#include "twin/records/raw_record.h"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr Eigen::Index fewest_samples = 2048;

RawRecord read_any(const std::string &path, const ReadOptions &options)
{
  const std::string ending = lower(std::filesystem::path(path).extension().string());
  if (ending == ".npy")
    return read_npy_record(path, options);
  if (ending == ".uff" || ending == ".unv")
    return read_uff_record(path, options);
  if (ending == ".mat")
    return read_mat_record(path, options);
  if (ending == ".csv" || ending == ".txt" || ending == ".tsv" || ending == ".asc")
    return read_csv_record(path, options);
  throw InputError(
      fmt::format("{}: records are .csv, .txt, .tsv, .asc, .npy with .json, .uff, .unv or .mat; export "
                  "others (ibaPDA, TDMS, Parquet) as CSV",
                  path));
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

RawRecord read_record(const std::string &path, const ReadOptions &options)
{
  if (options.rate && !(*options.rate > 0 && std::isfinite(*options.rate)))
    throw InputError(fmt::format("--rate {} is not above zero", *options.rate));
  RawRecord record = read_any(path, options);
  require_increasing(record);
  if (record.n_samples() < fewest_samples)
    throw InputError(Place{path, 1, 1},
                     fmt::format("the record has {} samples; at least {} are needed for a spectrum",
                                 record.n_samples(), fewest_samples));
  return record;
}
}  // namespace mill::twin
