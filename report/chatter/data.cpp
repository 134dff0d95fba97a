#include "report/chatter/data.h"
#include "core/base/errors.h"
#include "core/base/file_ending.h"
#include "core/base/files.h"
#include "core/records/json_archive.h"
#include "core/records/open_rows.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_chatter.h"
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

namespace mill::report {
namespace {
namespace fs = std::filesystem;

// Reads the record in a file; a file that is not one is reported in `problems`.
template <class Record> std::optional<Record> stored(const fs::path &path, std::vector<std::string> &problems)
{
  try {
    return record_of_json<Record>(read_text(path.string()));
  } catch (const InputError &) {
  }
  problems.push_back("curves/" + path.filename().string() +
                     " is not what this program writes, so what it holds is not shown; run the case again.");
  return std::nullopt;
}

// Places of the conditions among the results.
std::map<std::string, std::size_t> places_of(const Run &run)
{
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < run.results.size(); ++i)
    if (const auto id = result_id_or_open(run.results[i].name);
        id && (id->is_of(row::chatter::all) || id->is_of(row::open::chatter)))
      places.emplace(id->place("pass"), i);
  return places;
}

// "10" behind "9", letters behind numbers.
bool earlier(const std::string &a, const std::string &b)
{
  const auto is_number = [](const std::string &text) {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](const char c) { return c >= '0' && c <= '9'; });
  };
  if (is_number(a) != is_number(b))
    return is_number(a);
  return is_number(a) && a.size() != b.size() ? a.size() < b.size() : a < b;
}
}  // namespace

bool ChatterData::empty() const
{
  return conditions.empty() && !tandem && problems.empty();
}

ChatterData read_chatter(const Run &run)
{
  ChatterData data;
  std::map<std::string, ChatterCondition> collected;  // by slug
  for (const auto &[path, table] : run.tables)
    if (const auto name = curve_name(path);
        name && std::string(name->kind->family) == family::chatter && name->item != tandem_item)
      collected[name->item] = {};
  std::error_code none;
  const std::string start = "chatter-";
  const fs::path curves   = fs::path(run.directory) / "curves";
  for (const std::string &entry : names_in(curves.string(), none)) {
    const fs::path file    = curves / entry;
    const std::string stem = file.stem().string();
    if (!has_ending(file, FileEnding::json) || stem.rfind(start, 0) != 0)
      continue;
    if (stem == start + tandem_item)
      data.tandem = stored<ChatterTandem>(file, data.problems);
    else if (const auto condition = stored<ChatterCondition>(file, data.problems))
      collected[stem.substr(start.size())] = *condition;
  }
  std::sort(data.problems.begin(), data.problems.end());
  for (auto &[slug, condition] : collected) {
    condition.slug = slug;
    if (condition.name.empty())
      condition.name = slug;
    data.conditions.push_back(condition);
  }
  const auto places   = places_of(run);
  const auto place_of = [&](const ChatterCondition &condition) {  // those without results come last
    const auto place = places.find(condition.name);
    return place == places.end() ? run.results.size() : place->second;
  };
  std::stable_sort(data.conditions.begin(), data.conditions.end(),
                   [&](const ChatterCondition &a, const ChatterCondition &b) {
                     const std::size_t i = place_of(a), j = place_of(b);
                     return i != j ? i < j : earlier(a.name, b.name);
                   });
  return data;
}
}  // namespace mill::report
