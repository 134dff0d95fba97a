#include "report/chatter/data.h"
#include "core/case/errors.h"
#include "core/records/files.h"
#include "report/page/json_entries.h"
#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>

namespace mill::report {
namespace {
namespace fs                = std::filesystem;
constexpr double not_stored = std::numeric_limits<double>::quiet_NaN();

const Json &object(const Json &json, const char *key)
{
  static const Json none = Json::object();
  const Json *value      = entry_of(json, key);
  return value && value->is_object() ? *value : none;
}

ChatterCritical critical_of(const Json &json)
{
  const Eigen::VectorXd searched = numbers(json, "searched");
  return {text(json, "verdict"),
          number(json, "speed"),
          number(json, "frequency"),
          number(json, "growth_at_working_speed"),
          number(json, "margin"),
          number(json, "margin_speed"),
          searched.size() == 2 ? searched[0] : not_stored,
          searched.size() == 2 ? searched[1] : not_stored,
          text(json, "sentence")};
}

LimitCycleInfo limit_cycle_of(const Json &json)
{
  LimitCycleInfo cycle{!json.empty(),
                       number(json, "speed"),
                       flag(json, "settled"),
                       number(json, "amplitude_um"),
                       number(json, "frequency"),
                       text(json, "stopped"),
                       text(json, "limited_by"),
                       {}};
  for (const Json &event : list(json, "events"))
    cycle.events.push_back({number(event, "time"), text(event, "what")});
  return cycle;
}

std::vector<ChatterPoint> shape_of(const Json &json)
{
  std::vector<ChatterPoint> shape;
  for (const Json &point : list(json, "shape"))
    shape.push_back({text(point, "label"), number(point, "amplitude"), number(point, "phase")});
  return shape;
}

ChatterPhases phases_of(const Json &json)
{
  return {!json.empty(),
          number(json, "frequency"),
          number(json, "ratio"),
          number(json, "force"),
          number(json, "entry_tension"),
          number(json, "exit_tension"),
          number(json, "friction"),
          shape_of(json)};
}

std::vector<ChatterVariantInfo> variants_of(const Json &json, const char *key)
{
  std::vector<ChatterVariantInfo> all;
  for (const Json &entry : list(json, key))
    all.push_back({text(entry, "name"), text(entry, "verdict"), number(entry, "critical_speed"),
                   number(entry, "frequency"), number(entry, "growth_rate"), number(entry, "ratio"),
                   number(entry, "force_phase"), number(entry, "entry_tension_phase"),
                   flag(entry, "upper_moves_more")});
  return all;
}

ChatterCondition condition_of(const std::string &slug, const Json &json)
{
  ChatterCondition c;
  c.slug      = slug;
  c.name      = text(json, "condition").empty() ? slug : text(json, "condition");
  c.scheme    = text(json, "scheme");
  c.speed     = number(json, "speed");
  c.reduction = number(json, "reduction");
  c.viscosity = number(json, "viscosity");
  c.critical  = critical_of(object(json, "critical"));
  for (const Json &history : list(json, "histories"))
    c.histories.push_back({text(history, "file"), number(history, "speed"), number(history, "growth_rate"),
                           number(history, "measured_growth")});
  c.limit_cycle = limit_cycle_of(object(json, "limit_cycle"));
  c.phases      = phases_of(object(json, "phases"));
  for (const Json &entry : list(json, "sensitivities"))
    c.sensitivities.push_back({text(entry, "key"), text(entry, "name"), number(entry, "friction_slope"),
                               number(entry, "friction_minus"), number(entry, "friction_plus"),
                               number(entry, "speed_slope"), number(entry, "speed_minus"),
                               number(entry, "speed_plus"), flag(entry, "curved")});
  c.schemes    = variants_of(json, "schemes");
  c.variants   = variants_of(json, "variants");
  c.structures = variants_of(json, "structures");
  for (const Json &entry : list(json, "conclusions"))
    c.conclusions.push_back({text(entry, "text"), text(entry, "detail"), flag(entry, "holds")});
  for (const Json &entry : list(json, "published"))
    c.published.push_back({text(entry, "quantity"), text(entry, "unit"), text(entry, "note"),
                           number(entry, "here"), number(entry, "published"), number(entry, "measured")});
  return c;
}

ChatterTandem tandem_of(const Json &json)
{
  return {true,
          texts(json, "stands"),
          text(json, "verdict"),
          text(json, "sentence"),
          texts(json, "sentences"),
          number(json, "critical_speed"),
          number(json, "frequency"),
          number(json, "without_delay"),
          variants_of(json, "single"),
          shape_of(json)};
}

// The object in a file; without one `problems` says so.
std::optional<Json> object_in(const fs::path &path, std::vector<std::string> &problems)
{
  try {
    Json json = json_of(read_text(path.string()));
    if (json.is_object())
      return json;
  } catch (const nlohmann::json::exception &) {
  } catch (const InputError &) {
  }
  problems.push_back("curves/" + path.filename().string() +
                     " is not what this program writes, so what it holds is not shown; run the case again.");
  return std::nullopt;
}

// "2" of "curves/chatter-2-map-tension"; empty when the path is none of the tables of a condition.
std::string slug_of_table(const std::string &path)
{
  static const char *const endings[] = {"-speed",
                                        "-locus",
                                        "-map-reduction",
                                        "-map-tension",
                                        "-map-viscosity",
                                        "-boundary-reduction",
                                        "-boundary-tension",
                                        "-boundary-viscosity"};
  const std::string start            = "curves/chatter-";
  if (path.rfind(start, 0) != 0)
    return "";
  for (const std::string ending : endings)
    if (path.size() > start.size() + ending.size() &&
        path.compare(path.size() - ending.size(), ending.size(), ending) == 0)
      return path.substr(start.size(), path.size() - start.size() - ending.size());
  return "";
}

// Place of a condition among the results; those without any come last.
std::size_t place_of(const Run &run, const std::string &name)
{
  const std::string start = "chatter." + name + ".";
  for (std::size_t i = 0; i < run.results.size(); ++i)
    if (run.results[i].name.rfind(start, 0) == 0)
      return i;
  return run.results.size();
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
  return conditions.empty() && !tandem.stored && problems.empty();
}

ChatterData read_chatter(const Run &run)
{
  ChatterData data;
  std::map<std::string, Json> found;  // by slug
  for (const auto &[path, table] : run.tables)
    if (const std::string slug = slug_of_table(path); !slug.empty() && slug != "tandem")
      found[slug] = Json::object();
  const fs::path curves = fs::path(run.directory) / "curves";
  std::error_code none;
  const std::string start = "chatter-";
  for (const fs::directory_entry &file : fs::directory_iterator(curves, none)) {
    const std::string stem = file.path().stem().string();
    if (file.path().extension() != ".json" || stem.rfind(start, 0) != 0)
      continue;
    const std::optional<Json> json = object_in(file.path(), data.problems);
    if (!json)
      continue;
    if (stem == "chatter-tandem")
      data.tandem = tandem_of(*json);
    else
      found[stem.substr(start.size())] = *json;
  }
  std::sort(data.problems.begin(), data.problems.end());
  for (const auto &[slug, json] : found)
    data.conditions.push_back(condition_of(slug, json));
  std::stable_sort(data.conditions.begin(), data.conditions.end(),
                   [&](const ChatterCondition &a, const ChatterCondition &b) {
                     const std::size_t i = place_of(run, a.name), j = place_of(run, b.name);
                     return i != j ? i < j : earlier(a.name, b.name);
                   });
  return data;
}

const Table *chatter_table(const Run &run, const ChatterCondition &condition, const std::string &what)
{
  return run.table("curves/chatter-" + condition.slug + "-" + what);
}
}  // namespace mill::report
