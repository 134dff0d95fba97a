#include "app/stages/bearing/bearing_readings.h"
#include "app/run/kept_part.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/records/record_text.h"
#include <utility>

namespace mill {
namespace {
// Raised by hand when what is read off a bearing changes.
constexpr const char *readings_version = "bearing readings 1";
}  // namespace

BearingReadings::BearingReadings(RunContext &run, const std::string &inputs)
    : key(hash_of(record_text(readings_version, inputs))), file(run.cache + "/bearing-readings-" + key + ".bin")
{
  if (auto kept = taken_from_cache<std::map<std::string, Table>>(run, file, key))
    known = std::move(*kept);
}

Table BearingReadings::table(const std::string &name, const std::function<Table()> &make)
{
  {
    const std::lock_guard lock(access);
    if (const auto entry = known.find(name); entry != known.end())
      return entry->second;
  }
  Table made = make();
  const std::lock_guard lock(access);
  grown = true;
  return known.emplace(name, std::move(made)).first->second;
}

Eigen::VectorXd BearingReadings::numbers(const std::string &name, const std::function<Eigen::VectorXd()> &make)
{
  return table(name, [&] { return Table().add("value", "", make()); }).columns.front();
}

void BearingReadings::keep(RunContext &run)
{
  const std::lock_guard lock(access);
  if (grown && keep_in_cache(run, "readings of a bearing", file, key, known))
    grown = false;
}
}  // namespace mill
