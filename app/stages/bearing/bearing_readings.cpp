#include "app/stages/bearing/bearing_readings.h"
#include "app/run/error_warnings.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/records/cache_entry.h"
#include "core/records/record_text.h"
#include "fem/cache/archive.h"
#include <utility>

namespace mill {
namespace {
// Raised by hand when what is read off a bearing changes.
constexpr const char *readings_version = "bearing readings 1", *readings_kind = "millstand bearing readings 1";

template <class Archive> void reading_members(Archive &a, Table &t)
{
  a.texts(t.names);
  a.texts(t.units);
  if (t.units.size() != t.names.size())
    return a.fail();
  t.columns.resize(t.names.size());
  for (Eigen::VectorXd &column : t.columns)
    a.array(column);
}

template <class Archive> void reading_members(Archive &a, std::map<std::string, Table> &all)
{
  std::vector<std::string> names;
  for (const auto &[name, table] : all)
    names.push_back(name);
  a.texts(names);
  for (const std::string &name : names)
    reading_members(a, all[name]);
}
}  // namespace

BearingReadings::BearingReadings(RunContext &run, const std::string &inputs)
    : key(hash_of(record_text(readings_version, inputs))), file(run.cache + "/bearing-readings-" + key + ".bin")
{
  std::string note;
  const auto bytes = run.fresh ? std::nullopt : read_cache_entry(file, readings_kind, key, &note);
  if (!note.empty())
    run.progress.note(note);
  if (!bytes)
    return;
  fem::Reader reader{*bytes};
  reading_members(reader, known);
  if (reader.good && reader.at == bytes->size())
    return;
  run.progress.note(file + " is not used: it is incomplete");
  known.clear();
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
  if (!grown)
    return;
  fem::Writer writer;
  reading_members(writer, known);
  try {
    write_cache_entry(file, readings_kind, key, writer.bytes);
    grown = false;
  } catch (const InputError &e) {
    run.warn(not_kept("readings of a bearing", e));
  }
}
}  // namespace mill
