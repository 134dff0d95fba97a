#include "report/frequency/data.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/records/json_archive.h"
#include <algorithm>
#include <filesystem>

namespace mill::report {
CampbellData read_campbell(const std::string &run_directory)
{
  const std::filesystem::path path = std::filesystem::path(run_directory) / "curves" / "campbell.json";
  CampbellData data;
  if (!std::filesystem::exists(path))
    return data;
  try {
    static_cast<CampbellRecord &>(data) = record_of_json<CampbellRecord>(read_text(path.string()));
    data.stored                         = true;
  } catch (const InputError &) {
    data.problem =
        "curves/campbell.json is not what this program writes, so the Campbell diagram is not shown; run "
        "the case again.";
  }
  const auto outside = [](const int i, const std::size_t n) { return i < 0 || std::size_t(i) >= n; };
  auto &all          = data.crossings;
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const CampbellCrossing &c) {
                             return outside(c.mode, data.modes.size()) || outside(c.line, data.lines.size());
                           }),
            all.end());
  return data;
}
}  // namespace mill::report
