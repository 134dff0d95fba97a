#include "core/base/files.h"
#include "core/base/input_file.h"
#include "twin/records/channel_names.h"
#include "twin/records/npy_array.h"
#include "twin/records/npy_sidecar.h"
#include "twin/records/record_clock.h"
#include "twin/records/sampling_rate.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace mill::twin {
namespace {
[[noreturn]] void refuse(const std::string &file, const std::string &what)
{
  throw InputError(file + " " + what);
}

void name_plain_columns(NpyLayout &layout, const NpySidecar &sidecar, const std::string &path)
{
  if (!layout.plain)
    return;
  if (sidecar.units.size() != layout.fields.size())
    refuse(path,
           fmt::format("holds {} column{}, its sidecar names {} units; one for each column, in their order, is "
                       "needed",
                       layout.fields.size(), layout.fields.size() == 1 ? "" : "s", sidecar.units.size()));
  for (std::size_t i = 0; i < layout.fields.size(); ++i)
    layout.fields[i].name = sidecar.units[i].first;
}

// All columns, block by block; numbers of rows that are not there are not made up.
std::vector<Eigen::VectorXd> columns_of(InputFile &file, const NpyLayout &layout, const std::string &path)
{
  const auto n = Eigen::Index(layout.n);
  std::vector<Eigen::VectorXd> columns(layout.fields.size(), Eigen::VectorXd(n));
  const std::size_t block = std::max<std::size_t>(1, (1 << 20) / layout.row);
  std::string bytes(block * layout.row, '\0');
  file.go_to(layout.start);
  const std::size_t size = std::size_t(layout.fields.front().type.size);
  for (std::size_t first = 0; first < std::size_t(n); first += block) {
    const std::size_t rows = std::min(block, std::size_t(n) - first);
    if (file.read(bytes.data(), rows * layout.row) != rows * layout.row)
      refuse(path, "is shorter than its header says; it was cut off while it was written or copied");
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const std::size_t index = layout.columns_first ? (first + r) * columns.size() + c : 0;
        if (layout.columns_first)  // the file runs down the columns
          columns[index / std::size_t(n)][Eigen::Index(index % std::size_t(n))] =
              number_at(&bytes[(r * columns.size() + c) * size], layout.fields[0].type);
        else
          columns[c][Eigen::Index(first + r)] =
              number_at(&bytes[r * layout.row + layout.fields[c].offset], layout.fields[c].type);
      }
  }
  return columns;
}
}  // namespace

RawRecord read_npy_record(const std::string &path, const ReadOptions &options)
{
  InputFile file(path);
  RawRecord record;
  record.file   = path;
  record.format = "numpy";
  std::string head(npy_prefix, '\0');
  head.resize(file.read(head.data(), npy_prefix));
  head.resize(npy_start(head, path));
  file.go_to(0);
  head.resize(file.read(head.data(), head.size()));
  NpyLayout layout    = npy_layout(head, path);
  const double behind = file.size() - double(layout.start) - layout.n * double(layout.row);
  if (behind < 0)
    refuse(path, "is shorter than its header says; it was cut off while it was written or copied");
  if (behind > 0)
    record.notes.push_back(
        fmt::format("{:.0f} byte behind the array were not used; a file holds one array", behind));
  require_memory(path, file.size(), 8.0 * layout.n * double(layout.fields.size()));
  const std::string sidecar_path = std::filesystem::path(path).replace_extension(".json").string();
  const NpySidecar sidecar       = npy_sidecar(sidecar_path, path);
  name_plain_columns(layout, sidecar, path);
  record.rate = options.rate ? *options.rate : sidecar.rate;
  if (!(record.rate > 0))
    throw InputError(Place{sidecar_path, 1, 1},
                     "\"rate\", the samples per second, is missing or not above zero; write \"rate\": 20000");
  if (!options.rate)
    require_possible_rate(record.rate, "\"rate\" of " + sidecar_path);
  if (!sidecar.start.empty()) {
    RecordClock clock(options);
    clock.seconds_of(sidecar.start, {sidecar_path, 1, 1});
    record.start = clock.start();
  }
  auto columns = columns_of(file, layout, path);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string &name = layout.fields[c].name;
    if (name == sample_field) {  // number of the sample: gaps are jumps of it
      const double first = columns[c].size() > 0 ? columns[c][0] : 0;
      record.time        = (columns[c].array() - first) / record.rate;
      record.first_time  = first / record.rate;
      record.time_place  = {path, 0, 0};
      record.other_columns.push_back(name);
      continue;
    }
    const auto unit = sidecar.unit_of(name);
    add_channel(record, {name, unit}, {path, 0, 0}, options, std::move(columns[c]));
  }
  require_usable_channels(record, options, fmt::format("write them into \"units\" of {}, or", sidecar_path));
  return record;
}
}  // namespace mill::twin
