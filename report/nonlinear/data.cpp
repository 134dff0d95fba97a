#include "report/nonlinear/data.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/records/json_archive.h"
#include <algorithm>
#include <filesystem>

namespace mill::report {
NonlinearData read_nonlinear(const std::string &run_directory, const std::string &item)
{
  const std::string name           = "nonlinear-" + item + ".json";
  const std::filesystem::path path = std::filesystem::path(run_directory) / "curves" / name;
  NonlinearData data;
  if (!std::filesystem::exists(path))
    return data;
  try {
    static_cast<NonlinearRecord &>(data) = record_of_json<NonlinearRecord>(read_text(path.string()));
    data.stored                          = true;
  } catch (const InputError &) {
    data.problem = "curves/" + name +
                   " is not what this program writes, so the response on curves is not shown; run the case again.";
  }
  for (NonlinearMode &mode : data.modes)  // columns of one length
    if (mode.followed.size() != mode.amplitude.size() || mode.least.size() != mode.amplitude.size())
      mode.amplitude.clear();
  return data;
}
}  // namespace mill::report
