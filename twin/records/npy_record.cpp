#include "core/base/files.h"
#include "twin/records/binary_numbers.h"
#include "twin/records/channel_names.h"
#include "twin/records/record_clock.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

// numpy's format: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
namespace mill::twin {
namespace {
using Json = nlohmann::ordered_json;  // names of columns in the order in which they are written

constexpr double most_samples = 4e9;

struct Field {
  std::string name;
  BinaryType type;
  std::size_t offset;  // byte, in a row
};

struct Layout {
  std::vector<Field> fields;
  std::size_t row    = 0;  // byte
  double n           = 0;  // rows
  std::size_t start  = 0;  // byte, of the first row
  bool plain         = false;
  bool columns_first = false;  // a plain array in Fortran's order
};

[[noreturn]] void refuse(const std::string &file, const std::string &what)
{
  throw InputError(file + " " + what);
}

// Value of 'key' in the header, a Python literal: from behind the colon to where brackets are closed again.
std::string literal_of(const std::string &header, const std::string &key)
{
  const auto at = header.find("'" + key + "'");
  if (at == std::string::npos)
    return "";
  auto i = header.find(':', at);
  std::string text;
  int depth = 0;
  for (++i; i < header.size(); ++i) {
    const char c = header[i];
    depth += (c == '[' || c == '(') - (c == ']' || c == ')');
    if (depth < 0 || (depth == 0 && (c == ',' || c == '}')))
      break;
    text += c;
  }
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first);
}

std::vector<std::string> quoted_in(const std::string &text)
{
  std::vector<std::string> found;
  for (std::size_t i = text.find('\''); i != std::string::npos; i = text.find('\'', i + 1)) {
    const auto end = text.find('\'', i + 1);
    if (end == std::string::npos)
      break;
    found.push_back(text.substr(i + 1, end - i - 1));
    i = end;
  }
  return found;
}

std::vector<double> numbers_in(const std::string &text)
{
  std::vector<double> found;
  for (std::size_t i = 0; i < text.size();)
    if (text[i] >= '0' && text[i] <= '9') {
      double value = 0;
      for (; i < text.size() && text[i] >= '0' && text[i] <= '9'; ++i)
        value = 10 * value + (text[i] - '0');
      found.push_back(value);
    } else
      ++i;
  return found;
}

std::string header_of(std::ifstream &file, const std::string &path, std::size_t &start)
{
  char head[12] = {};
  file.read(head, 12);
  const bool is     = file.gcount() >= 10 && std::memcmp(head, "\x93NUMPY", 6) == 0;
  const int version = head[6];
  if (!is || version < 1 || version > 3)
    refuse(path, "is no array that numpy saved (.npy, version 1 to 3)");
  const std::size_t length = std::size_t(number_at(head + 8, {'u', version == 1 ? 2 : 4, false}));
  start                    = (version == 1 ? 10u : 12u) + length;
  if (length > 1 << 20)
    refuse(path, "has a header of more than 1 MiB");
  std::string header(length, ' ');
  file.clear();
  file.seekg(std::streamoff(start - length));
  file.read(header.data(), std::streamsize(length));
  if (std::size_t(file.gcount()) != length)
    refuse(path, "ends inside its header");
  return header;
}

Layout layout_of_header(const std::string &header, const std::string &path)
{
  Layout layout;
  const std::string descr = literal_of(header, "descr");
  const auto shape        = numbers_in(literal_of(header, "shape"));
  const auto words        = quoted_in(descr);
  const bool fields       = !descr.empty() && descr.front() == '[';
  if (fields) {
    if (shape.size() != 1 || words.size() % 2 != 0)
      refuse(path, "holds a structured array that is not one-dimensional, or with fields inside fields");
    for (std::size_t i = 0; i < words.size(); i += 2) {
      BinaryType type;
      if (!type_of_descriptor(words[i + 1], type))
        refuse(path, fmt::format("holds numbers of type '{}' in field '{}'; save float32, float64 or integers",
                                 words[i + 1], words[i]));
      layout.fields.push_back({words[i], type, layout.row});
      layout.row += std::size_t(type.size);
    }
  } else {
    BinaryType type;
    if (words.size() != 1 || !type_of_descriptor(words.front(), type))
      refuse(path, fmt::format("holds numbers of type {}; save float32, float64 or integers", descr));
    if (shape.empty() || shape.size() > 2)
      refuse(path, "holds an array that is neither one column (n) nor columns side by side (n, m)");
    layout.plain           = true;
    layout.columns_first   = literal_of(header, "fortran_order").rfind("True", 0) == 0;
    const double n_columns = shape.size() == 2 ? shape[1] : 1;
    if (n_columns < 1 || n_columns > 4096)
      refuse(path, fmt::format("holds {} columns; one column per channel is needed, at most 4096", n_columns));
    for (std::size_t i = 0; i < std::size_t(n_columns); ++i)
      layout.fields.push_back({"", type, i * std::size_t(type.size)});
    layout.row = std::size_t(n_columns) * std::size_t(type.size);
  }
  layout.n = shape.front();
  if (layout.row == 0 || layout.n > most_samples)
    refuse(path, "holds no samples or more than 4e9");
  return layout;
}

struct Sidecar {
  double rate = std::numeric_limits<double>::quiet_NaN();
  std::string start;
  std::vector<std::pair<std::string, std::string>> units;  // channel, unit
};

Sidecar sidecar_of(const std::string &path, const std::string &array)
{
  const auto text = text_if_readable(path);
  if (!text)
    throw InputError(fmt::format("{} is needed beside {}: {{\"rate\": 20000, \"units\": {{\"force\": \"kN\", "
                                 "\"upper_work_roll\": \"g\"}}}}",
                                 path, array));
  const Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object())
    throw InputError(Place{path, 1, 1},
                     "this is no JSON object; write {\"rate\": 20000, \"units\": {\"force\": \"kN\"}}");
  Sidecar sidecar;
  if (json.contains("rate") && json["rate"].is_number())
    sidecar.rate = json["rate"].get<double>();
  if (json.contains("start") && json["start"].is_string())
    sidecar.start = json["start"].get<std::string>();
  if (!json.contains("units") || !json["units"].is_object())
    throw InputError(Place{path, 1, 1}, "\"units\" is missing; write \"units\": {\"force\": \"kN\", "
                                        "\"upper_work_roll\": \"g\"}, one entry for each channel");
  for (const auto &[name, unit] : json["units"].items())
    sidecar.units.emplace_back(name, unit.is_string() ? unit.get<std::string>() : "");
  return sidecar;
}

void name_plain_columns(Layout &layout, const Sidecar &sidecar, const std::string &path)
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
std::vector<Eigen::VectorXd> columns_of(std::ifstream &file, const Layout &layout, const std::string &path)
{
  const auto n = Eigen::Index(layout.n);
  std::vector<Eigen::VectorXd> columns(layout.fields.size(), Eigen::VectorXd(n));
  const std::size_t block = std::max<std::size_t>(1, (1 << 20) / layout.row);
  std::string bytes(block * layout.row, '\0');
  file.clear();
  file.seekg(std::streamoff(layout.start));
  const std::size_t size = std::size_t(layout.fields.front().type.size);
  for (std::size_t first = 0; first < std::size_t(n); first += block) {
    const std::size_t rows = std::min(block, std::size_t(n) - first);
    file.read(bytes.data(), std::streamsize(rows * layout.row));
    if (std::size_t(file.gcount()) != rows * layout.row)
      refuse(path, "is shorter than its header says; it was cut off while it was written or copied");
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const std::size_t at = layout.columns_first ? (first + r) * columns.size() + c : 0;
        if (layout.columns_first)  // the file runs down the columns
          columns[at / std::size_t(n)][Eigen::Index(at % std::size_t(n))] =
              number_at(&bytes[(r * columns.size() + c) * size], layout.fields[0].type);
        else
          columns[c][Eigen::Index(first + r)] =
              number_at(&bytes[r * layout.row + layout.fields[c].offset], layout.fields[c].type);
      }
  }
  return columns;
}
}  // namespace

bool type_of_descriptor(const std::string &text, BinaryType &type)
{
  if (text.size() != 3 || std::string("<>|=").find(text[0]) == std::string::npos)
    return false;
  type             = {text[1], text[2] - '0', text[0] == '>'};
  const bool whole = (type.kind == 'i' || type.kind == 'u') &&
                     (type.size == 1 || type.size == 2 || type.size == 4 || type.size == 8);
  return whole || (type.kind == 'f' && (type.size == 4 || type.size == 8));
}

RawRecord read_npy_record(const std::string &path, const ReadOptions &options)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw InputError("there is no file " + path);
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw SystemError(path + " cannot be read");
  RawRecord record;
  record.file              = path;
  record.format            = "numpy";
  std::size_t start        = 0;
  const std::string header = header_of(file, path, start);
  Layout layout            = layout_of_header(header, path);
  layout.start             = start;
  const double bytes       = double(std::filesystem::file_size(path, error));
  if (double(start) + layout.n * double(layout.row) > bytes)
    refuse(path, "is shorter than its header says; it was cut off while it was written or copied");
  const std::string sidecar_path = std::filesystem::path(path).replace_extension(".json").string();
  const Sidecar sidecar          = sidecar_of(sidecar_path, path);
  name_plain_columns(layout, sidecar, path);
  record.rate = options.rate ? *options.rate : sidecar.rate;
  if (!(record.rate > 0) || !std::isfinite(record.rate))
    throw InputError(Place{sidecar_path, 1, 1},
                     "\"rate\", the samples per second, is missing or not above zero; write \"rate\": 20000");
  if (!sidecar.start.empty()) {
    RecordClock clock(options);
    clock.seconds_of(sidecar.start, {sidecar_path, 1, 1});
    record.start = clock.start();
  }
  auto columns = columns_of(file, layout, path);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string &name = layout.fields[c].name;
    if (name == "s") {  // number of the sample: gaps are jumps of it
      const double first = columns[c].size() > 0 ? columns[c][0] : 0;
      record.time        = (columns[c].array() - first) / record.rate;
      record.time_place  = {path, 0, 0};
      continue;
    }
    std::string unit;
    for (const auto &[channel, its_unit] : sidecar.units)
      if (channel == name)
        unit = its_unit;
    record.channels.push_back(channel_of({name, unit}, {path, 0, 0}, options, std::move(columns[c])));
  }
  require_usable_channels(record, fmt::format("write it into \"units\" of {}", sidecar_path));
  return record;
}
}  // namespace mill::twin
