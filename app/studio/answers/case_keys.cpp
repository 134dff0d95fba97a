#include "app/studio/answers/case_keys.h"
#include "core/base/si_unit.h"
#include "core/base/units.h"
#include "core/case/case_template.h"
#include "core/case/kinds.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

namespace mill::studio {
namespace {
using nlohmann::ordered_json;
using Repeat = SectionRows::Repeat;

// What draws what: key of the case, length of the geometry record (run.json).
constexpr const char *pictures[][2] = {
    {"work_roll.barrel_diameter", "work_roll_diameter"},
    {"work_roll.barrel_length", "work_roll_length"},
    {"work_roll.neck_diameter", "work_neck_diameter"},
    {"work_roll.total_length", "work_total_length"},
    {"work_roll.bearing_span", "work_bearing_span"},
    {"backup_roll.barrel_diameter", "backup_diameter"},
    {"backup_roll.barrel_length", "backup_length"},
    {"backup_roll.neck_diameter", "backup_neck_diameter"},
    {"backup_roll.neck_length", "backup_neck_length"},
    {"backup_roll.bearing_span", "backup_bearing_span"},
    {"strip.width", "strip_width"},
    {"strip.entry_thickness", "entry_thickness"},
    {"strip.exit_thickness", "exit_thickness"},
    {"housing.thickness", "housing_thickness"},
    {"housing.post_width", "housing_post_width"},
    {"housing.window_width", "housing_window_width"},
    {"housing.window_height", "housing_window_height"},
    {"housing.upper_beam_height", "housing_upper_beam_height"},
    {"housing.lower_beam_height", "housing_lower_beam_height"},
    {"screwdown.screw_diameter", "screw_diameter"},
    {"screwdown.screw_length", "screw_length"},
    {"screwdown.nut_outside_diameter", "nut_outside_diameter"},
    {"screwdown.nut_height", "nut_height"},
    {"screwdown.piston_diameter", "piston_diameter"},
    {"screwdown.piston_length", "piston_length"},
    {"screwdown.stroke", "stroke"},
    {"screwdown.load_cell_diameter", "load_cell_diameter"},
    {"screwdown.load_cell_height", "load_cell_height"},
};

const char *name_of(const Kind kind)
{
  constexpr const char *names[] = {"quantity", "number", "count", "flag",  "choice", "text",   "path",
                                   "pair",     "table",  "six",   "words", "list",   "triples"};
  return names[int(kind)];
}

// Units in which a key may be given: those of the same quantity, by their names.
std::vector<std::string> units_like(const std::string &form)
{
  std::vector<std::string> symbols;
  const Unit *known = find_unit(form);
  if (!known || is_pure(form))
    return symbols;
  for (const Unit &unit : all_units())
    if (unit.dimension == known->dimension && std::strcmp(unit.quantity, known->quantity) == 0)
      symbols.push_back(unit.symbol);
  return symbols;
}

ordered_json row_json(const SectionRows &section, const Row &row)
{
  ordered_json out{{"key", row.key},
                   {"kind", name_of(row.kind)},
                   {"form", row.form},
                   {"meaning", row.meaning},
                   {"range", range_text(row)},
                   {"default", default_toml(row)},
                   {"example", example_toml(row)},
                   {"required", row.fallback.kind == Fallback::Kind::required}};
  if (row.kind == Kind::quantity || row.kind == Kind::pair || row.kind == Kind::list)
    out["units"] = units_like(row.form);
  if (const std::string where = where_to_find(section.id(), row.key); !where.empty())
    out["where"] = where;
  if (const std::string picture = section.repeat == Repeat::once ? picture_of(section.name + "." + row.key) : "";
      !picture.empty())
    out["picture"] = picture;
  return out;
}

// "bearing.trb" belongs to [bearing.NAME], "pass.0" to [[pass]].
bool is_section(const SectionRows &rows, const std::string &name)
{
  if (rows.repeat == Repeat::once)
    return name == rows.name;
  const std::string start = rows.name + ".";
  return name.size() > start.size() && name.compare(0, start.size(), start) == 0;
}
}  // namespace

const Row *row_of_key(const std::string &kind, const std::string &key)
{
  const auto dot            = key.rfind('.');
  const std::string section = dot == std::string::npos ? "" : key.substr(0, dot),
                    name    = dot == std::string::npos ? key : key.substr(dot + 1);
  for (const SectionRows &rows : sections_of(kind)) {
    if (!is_section(rows, section))
      continue;
    const auto row = std::find_if(rows.rows.begin(), rows.rows.end(), [&](const Row &r) { return r.key == name; });
    if (row != rows.rows.end())
      return &*row;
  }
  return nullptr;
}

std::string picture_of(const std::string &key)
{
  for (const auto &picture : pictures)
    if (key == picture[0])
      return picture[1];
  return "";
}

std::string schema_json(const std::string &kind)
{
  const CaseKind &of_kind = kind_named(kind);
  ordered_json out{{"kind", kind}, {"drawing", ordered_json::array()}, {"sections", ordered_json::array()}};
  for (const DrawingValue &value : of_kind.drawing)
    out["drawing"].push_back({{"section", value.section}, {"key", value.key}});
  for (const SectionRows &section : sections_of(kind)) {
    ordered_json one{{"id", section.id()},
                     {"name", section.name},
                     {"repeat", section.repeat == Repeat::once    ? "once"
                                : section.repeat == Repeat::named ? "named"
                                                                  : "list"},
                     {"needed", section.needed},
                     {"meaning", section.meaning},
                     {"rows", ordered_json::array()}};
    for (const Row &row : section.rows)
      one["rows"].push_back(row_json(section, row));
    out["sections"].push_back(std::move(one));
  }
  for (const Unit &unit : all_units())
    out["units"][unit.symbol] = {{"factor", unit.multiply / unit.divide}, {"offset", unit.offset}};
  return out.dump();
}
}  // namespace mill::studio
