#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "twin/live/recording/npy_header.h"
#include "twin/live/recording/recorder.h"
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

// Files of a folder of recordings: those of killed programs, the old ones, and how long they are kept.
namespace mill::live {
namespace {
bool is_record_name(const std::string &name, const char *ending)
{
  static const std::regex stem("\\d{8}T\\d{6}Z_-?\\d+(-\\d+)?");
  const std::size_t n = std::strlen(ending);
  return name.size() > n && name.compare(name.size() - n, n, ending) == 0 &&
         std::regex_match(name.substr(0, name.size() - n), stem);
}

std::string stem_of(const std::string &path, const char *ending)
{
  return path.substr(0, path.size() - std::strlen(ending));
}

// Number of the last sample, stored at the end of its row.
std::int64_t last_number(const int file, const NpyHeader &header)
{
  unsigned char bytes[8] = {};
  const auto end         = off_t(header.bytes + std::size_t(header.rows) * header.row_bytes());
  if (::pread(file, bytes, 8, end - 8) != 8)
    return -1;
  std::uint64_t value = 0;
  for (int i = 0; i < 8; ++i)
    value |= std::uint64_t(bytes[i]) << 8 * i;
  return std::int64_t(value);
}

// Counts complete rows and cuts off the rest.  False: the file is not a recording.
bool mend_part(const int file, NpyHeader &header)
{
  struct stat info;
  std::string bytes(1 << 17, '\0');
  const ssize_t n = ::pread(file, bytes.data(), bytes.size(), 0);
  if (n <= 0 || ::fstat(file, &info) != 0)
    return false;
  bytes.resize(std::size_t(n));
  if (!read_npy_header(bytes, header))
    return false;
  header.rows = (std::int64_t(info.st_size) - std::int64_t(header.bytes)) / std::int64_t(header.row_bytes());
  const std::string mended = npy_header(header.fields, header.rows);
  return ::ftruncate(file, off_t(header.bytes + std::size_t(header.rows) * header.row_bytes())) == 0 &&
         ::pwrite(file, mended.data(), mended.size(), 0) == ssize_t(mended.size()) && ::fsync(file) == 0;
}

// The name of its source.  What cannot be written does not keep the program from its start.
std::string mark_finished(const std::string &sidecar, const std::int64_t rows,
                          const std::function<void(const std::string &)> &note)
{
  const auto text = text_if_readable(sidecar);
  auto json       = nlohmann::ordered_json::parse(text ? *text : "", nullptr, false);
  if (!json.is_object())
    return "";
  json["samples"]  = rows;
  json["complete"] = true;
  json["note"]     = "the program was interrupted; the file was finished at the next start";
  try {
    write_atomically(sidecar, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  } catch (const std::exception &problem) {
    note(fmt::format("{} stays as it was: {}", sidecar, problem.what()));
  }
  return json.contains("source") && json["source"].is_string() ? json["source"].get<std::string>() : "";
}
}  // namespace

std::vector<FinishedPart> finish_parts(const std::string &folder,
                                       const std::function<void(const std::string &)> &note)
{
  constexpr const char *ending = ".npy.part";
  std::vector<FinishedPart> finished;
  std::error_code error;
  std::vector<std::string> paths;
  for (const std::string &name : names_in(folder, error))
    if (is_record_name(name, ending))
      paths.push_back((fs::path(folder) / name).string());
  std::sort(paths.begin(), paths.end());
  for (const std::string &path : paths) {
    const std::string stem = stem_of(path, ending);
    const int file         = open_file(path, O_RDWR | O_NOFOLLOW);
    if (file < 0) {
      note(fmt::format("{} cannot be finished: {}", path, std::strerror(errno)));
      continue;
    }
    NpyHeader header;
    if (!lock_file(file, LOCK_EX | LOCK_NB)) {
      note(path + " is being written by another program");
    } else if (!mend_part(file, header)) {
      note(path + " cannot be finished, since it is not a recording; it stays as it is");
    } else if (header.rows == 0) {
      fs::remove(path, error);
      fs::remove(stem + ".json", error);
    } else if (fs::exists(stem + ".npy", error)) {
      note(path + " stays: " + stem + ".npy exists");
    } else if (fs::rename(path, stem + ".npy", error); error) {
      note(fmt::format("{} cannot be finished: {}", path, error.message()));
    } else {
      const std::string source = mark_finished(stem + ".json", header.rows, note);
      finished.push_back({stem + ".npy", header.rows, last_number(file, header) + 1, source});
      note(fmt::format("{}.npy was finished: {} samples up to s = {}", stem, header.rows,
                       finished.back().next - 1));
    }
    ::close(file);
  }
  return finished;
}

std::vector<std::string> remove_old_records(const std::string &folder, const KeptRecords &kept, const double now)
{
  // A file from the future is of a time at which the clock was wrong: its age is not known, and it is older than
  // all that were written since.  A day is for clocks of other machines and hours of daylight saving.
  constexpr double future = 86400, unknown = std::numeric_limits<double>::infinity();
  struct Record {
    std::string stem;
    double age, bytes;
  };
  std::vector<Record> records;
  std::error_code error;
  for (const std::string &name : names_in(folder, error)) {
    const std::string path = (fs::path(folder) / name).string();
    struct stat info;
    if (is_record_name(name, ".npy") && ::lstat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode) &&
        fs::exists(stem_of(path, ".npy") + ".json", error))
      records.push_back({stem_of(path, ".npy"),
                         double(info.st_mtime) - now > future ? unknown : now - double(info.st_mtime),
                         double(info.st_size)});
  }
  std::sort(records.begin(), records.end(),
            [](const Record &a, const Record &b) { return a.age != b.age ? a.age < b.age : a.stem > b.stem; });
  std::vector<std::string> removed;
  double bytes = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    bytes += records[i].bytes;
    const bool old = kept.age && records[i].age < unknown && records[i].age > *kept.age;
    if (i == 0 || !(old || (kept.bytes && bytes > *kept.bytes)))
      continue;  // the latest one stays, for any size
    fs::remove(records[i].stem + ".npy", error);
    fs::remove(records[i].stem + ".json", error);
    removed.push_back(records[i].stem + ".npy");
  }
  return removed;
}

KeptRecords kept_records(const std::string &text)
{
  const std::size_t end  = text.find_first_not_of("0123456789.");
  double number          = 0;
  const std::string unit = end == std::string::npos ? "" : text.substr(text.find_first_not_of(' ', end));
  if (parse_number(text.substr(0, end), number) && number > 0) {
    for (const auto &[name, seconds] : {std::pair("min", 60.0), std::pair("h", 3600.0), std::pair("d", 86400.0)})
      if (unit == name)
        return {number * seconds, {}};
    for (const auto &[name, bytes] : {std::pair("MB", 1e6), std::pair("GB", 1e9), std::pair("TB", 1e12)})
      if (unit == name)
        return {{}, number * bytes};
  }
  throw InputError(fmt::format("--keep \"{}\": a time or a size is needed, for example --keep 24h or --keep 50GB "
                               "(min, h, d, MB, GB, TB)",
                               text));
}

std::string utc_text(const double seconds)
{
  const double whole       = std::floor(seconds);
  const long long micro    = std::llround((seconds - whole) * 1e6);
  const std::time_t second = std::time_t(whole) + micro / 1000000;
  std::tm parts{};
  ::gmtime_r(&second, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:06}Z", parts.tm_year + 1900, parts.tm_mon + 1,
                     parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec, micro % 1000000);
}

std::string utc_name(const double seconds)
{
  const std::time_t second = std::time_t(std::floor(seconds));
  std::tm parts{};
  ::gmtime_r(&second, &parts);
  return fmt::format("{:04}{:02}{:02}T{:02}{:02}{:02}Z", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday,
                     parts.tm_hour, parts.tm_min, parts.tm_sec);
}
}  // namespace mill::live
