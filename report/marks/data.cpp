#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/records/json_archive.h"
#include "report/marks/figures.h"
#include <algorithm>
#include <filesystem>

namespace mill::report {
MarksData read_marks(const std::string &run_directory)
{
  const std::filesystem::path path = std::filesystem::path(run_directory) / "curves" / "marks.json";
  MarksData data;
  if (!std::filesystem::exists(path))
    return data;
  try {
    static_cast<MarksRecord &>(data) = record_of_json<MarksRecord>(read_text(path.string()));
    data.stored                      = true;
  } catch (const InputError &) {
    data.problem = "curves/marks.json is not what this program writes, so the marks are not shown; run millstand "
                   "marks again.";
  }
  const auto outside = [](const int i, const std::size_t n) { return i < 0 || std::size_t(i) >= n; };
  auto &all          = data.meetings;
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const MarkMeeting &m) {
                             return outside(m.mode, data.modes.size()) || outside(m.roll, data.rolls.size());
                           }),
            all.end());
  return data;
}
}  // namespace mill::report
