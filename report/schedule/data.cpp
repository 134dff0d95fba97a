#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/records/json_archive.h"
#include "report/schedule/figures.h"
#include <filesystem>

namespace mill::report {
ScheduleData read_schedule(const std::string &run_directory)
{
  const std::filesystem::path path = std::filesystem::path(run_directory) / schedule_file;
  ScheduleData data;
  if (!std::filesystem::exists(path))
    return data;
  try {
    static_cast<ScheduleRecord &>(data) = record_of_json<ScheduleRecord>(read_text(path.string()));
    data.stored                         = true;
  } catch (const InputError &) {
    data.problem =
        std::string(schedule_file) +
        " is not what this program writes, so the forces of the passes are not shown; run the case again.";
  }
  return data;
}
}  // namespace mill::report
