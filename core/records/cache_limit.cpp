#include "core/records/cache_limit.h"
#include "core/base/errors.h"
#include "core/base/file_ending.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

namespace fs = std::filesystem;

namespace mill {
double bytes_of_size(const std::string &option, const std::string &text)
{
  const std::size_t end = std::min(text.size(), text.find_first_not_of("0123456789."));
  std::string unit      = text.substr(end);
  unit.erase(0, std::min(unit.size(), unit.find_first_not_of(' ')));
  double number = 0;
  if (parse_number(text.substr(0, end), number) && number > 0)
    for (const auto &[name, bytes] : {std::pair("MB", 1e6), std::pair("GB", 1e9), std::pair("TB", 1e12)})
      if (unit == name)
        return number * bytes;
  throw InputError(option + " \"" + text + "\": a size is needed, for example " + option + " 20GB (MB, GB, TB)");
}

double keep_cache_below(const std::string &folder, const double bytes)
{
  struct Entry {
    fs::file_time_type used;
    double bytes;
    fs::path path;
  };
  std::vector<Entry> entries;
  double all = 0;
  std::error_code error;
  for (const std::string &name : names_in(folder, error)) {
    const fs::path path = fs::path(folder) / name;
    std::error_code gone;  // removed meanwhile by another process
    if (!has_ending(path, FileEnding::cache_entry) || !fs::is_regular_file(path, gone))
      continue;
    const auto used   = fs::last_write_time(path, gone);
    const double size = gone ? 0 : double(fs::file_size(path, gone));
    if (gone)
      continue;
    entries.push_back({used, size, path});
    all += size;
  }
  std::sort(entries.begin(), entries.end(), [](const Entry &a, const Entry &b) { return a.used < b.used; });
  double removed = 0;
  for (const Entry &entry : entries) {
    if (all - removed <= bytes)
      break;
    fs::remove(entry.path, error);
    removed += entry.bytes;
  }
  return removed;
}
}  // namespace mill
