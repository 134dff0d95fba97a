#include "twin/advice/advice_files.h"
#include "core/base/si_unit.h"
#include "core/records/note_records.h"
#include "core/records/stand_place.h"
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill::twin {
namespace {
using nlohmann::ordered_json;

ordered_json number_or_null(const double value)
{
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json effects_json(const std::vector<SideEffect> &effects)
{
  ordered_json list = ordered_json::array();
  for (const SideEffect &effect : effects)
    list.push_back({{"name", effect.name}, {"value", number_or_null(effect.value)}, {"unit", effect.unit}});
  return list;
}

ordered_json dampers_json(const RatedAction &action)
{
  const auto place  = [&](const int i) { return i < 0 ? ground_place : action.stand.places[std::size_t(i)]; };
  ordered_json list = ordered_json::array();
  for (const Attachment &a : action.joined) {
    ordered_json one;
    if (a.mass > 0) {
      one["at"]        = place(a.to);
      one["mass"]      = a.mass;
      one["frequency"] = a.frequency;
      one["damping"]   = a.ratio;
    } else {
      one["from"]   = place(a.from);
      one["to"]     = place(a.to);
      one["damper"] = a.damper;
    }
    list.push_back(one);
  }
  return list;
}

ordered_json action_json(const RatedAction &a, const ordered_json &rank)
{
  return ordered_json{{"rank", rank},
                      {"name", a.name},
                      {"means", a.means},
                      {"pair", a.pair},
                      {"change", number_or_null(a.change)},
                      {"change_sd", number_or_null(a.spread)},
                      {"verified_change", number_or_null(a.verified)},
                      {"first_order", number_or_null(a.first_order)},
                      {"one_by_one", number_or_null(a.apart)},
                      {"effects", effects_json(a.effects)},
                      {"modes", a.modes},
                      {"against", a.against},
                      {"remarks", a.remarks},
                      {"in_other_models", effects_json(a.repeated)},
                      {"dampers", dampers_json(a)}};
}

ordered_json action_json(const AdviceRecord &record, const std::size_t i)
{
  const RatedAction &a = record.actions[i];
  ordered_json json    = action_json(a, a.against.empty() ? ordered_json(i + 1) : ordered_json(nullptr));
  if (!record.reaches.empty())
    json["reaches_margin"] = bool(record.reaches[i]);
  return json;
}

ordered_json tuned_json(const TunedRecord &record)
{
  const TunedDamper &t = record.damper;
  const auto tuning    = [](const Attachment &a, const double change) {
    ordered_json one;
    one["frequency"] = a.frequency;
    one["damping"]   = a.ratio;
    one["change"]    = change;
    return one;
  };
  const double w = 2 * M_PI * t.best.frequency;
  ordered_json json;
  json["action"]            = record.action;
  json["place"]             = record.place;
  json["mode"]              = t.mode + 1;
  json["mode_frequency"]    = record.mode_frequency;
  json["effective_mass"]    = t.effective_mass;
  json["mass"]              = t.best.mass;
  json["mass_ratio"]        = t.best.mass / t.effective_mass;
  json["stiffness"]         = t.best.mass * w * w;
  json["damper"]            = 2 * t.best.ratio * t.best.mass * w;
  json["start"]             = tuning(t.start, t.start_change);
  json["best"]              = tuning(t.best, t.change);
  json["detuned_5_percent"] = {t.detuned_by(-0.05), t.detuned_by(0.05)};
  json["minimum_inside"]    = t.inside;
  return json;
}

std::string csv_number(const double value)
{
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : "";
}

std::string one_text(const std::vector<std::string> &sentences)
{
  std::string text;
  for (const std::string &sentence : sentences)
    text += (text.empty() ? "" : "; ") + sentence;
  return text;
}

std::string csv_line(const RatedAction &a, const std::string &rank)
{
  std::string text = rank + "," + quoted_cell(a.name);
  for (const double part : {a.verified, a.change, a.spread, a.first_order, a.apart})
    text += "," + csv_number(100 * part);
  for (const SideEffect &effect : a.effects)
    text += "," + csv_number(is_in(effect.unit, SiUnit::one) ? 100 * effect.value : effect.value);
  std::vector<std::string> repeated;
  for (const SideEffect &effect : a.repeated)
    repeated.push_back(fmt::format("{}: {:+.4g} %", effect.name, 100 * effect.value));
  for (const std::string &cell : {a.modes, one_text(a.against), one_text(a.remarks), one_text(repeated), a.means})
    text += "," + quoted_cell(cell);
  return text + "\n";
}
}  // namespace

std::string advice_json(const AdviceRecord &record)
{
  ordered_json json = ordered_json::parse(results_json(record.results, record.case_name, "ok"));
  json["goal"]      = {{"kind", word_of(record.goal)}, {"question", record.question}, {"answer", record.answer}};
  json["stand"]     = record.stand;
  json["actions"]   = ordered_json::array();
  for (std::size_t i = 0; i < record.actions.size(); ++i)
    json["actions"].push_back(action_json(record, i));
  json["what_ifs"] = ordered_json::array();
  for (const RatedAction &what_if : record.what_ifs)
    json["what_ifs"].push_back(action_json(what_if, nullptr));
  json["tuned_dampers"] = ordered_json::array();
  for (const TunedRecord &tuned : record.tuned)
    json["tuned_dampers"].push_back(tuned_json(tuned));
  json["slopes"] = ordered_json::array();
  for (const auto &[name, slope] : record.slopes)
    json["slopes"].push_back({{"name", name}, {"slope", number_or_null(slope)}});
  write_notes(json, record.notes);
  return json.dump(1) + "\n";
}

std::string advice_csv(const AdviceRecord &record)
{
  std::string text = "rank,action,verified change [%],change [%],sd [%],first order [%],one after the other [%]";
  const auto unit  = [](const std::string &si) { return is_in(si, SiUnit::one) ? std::string("%") : si; };
  std::vector<SideEffect> columns;
  if (!record.actions.empty())
    columns = record.actions.front().effects;
  for (const SideEffect &column : columns)
    text += "," + quoted_cell(column.name + " [" + unit(column.unit) + "]");
  text += ",modes,against,remarks,in other models,what could bring it about\n";
  for (std::size_t i = 0; i < record.actions.size(); ++i) {
    const RatedAction &a = record.actions[i];
    text += csv_line(a, a.against.empty() ? fmt::format("{}", i + 1) : "");
  }
  for (const RatedAction &what_if : record.what_ifs)
    text += csv_line(what_if, "what if");
  return text;
}
}  // namespace mill::twin
