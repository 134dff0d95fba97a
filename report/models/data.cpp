#include "report/models/data.h"
#include "core/case/errors.h"
#include "core/records/files.h"
#include "report/page/json_entries.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace mill::report {
namespace {
constexpr double not_stored = std::numeric_limits<double>::quiet_NaN();

// As many numbers as they describe things; what is too short ends in gaps.
Eigen::VectorXd fitted(const Eigen::VectorXd &values, const std::size_t n)
{
  Eigen::VectorXd out     = Eigen::VectorXd::Constant(Eigen::Index(n), not_stored);
  const Eigen::Index kept = std::min(out.size(), values.size());
  out.head(kept)          = values.head(kept);
  return out;
}

// (n, m) from a list of rows.
Eigen::MatrixXd matrix(const Json &object, const char *key, const Eigen::Index n, const Eigen::Index m)
{
  Eigen::MatrixXd out = Eigen::MatrixXd::Constant(n, m, not_stored);
  const Json &rows    = list(object, key);
  for (Eigen::Index i = 0; i < std::min(n, Eigen::Index(rows.size())); ++i)
    out.row(i) = fitted(numbers_of(rows[std::size_t(i)]), std::size_t(m)).transpose();
  return out;
}

ModelMode mode_of(const Json &json, const Model &model)
{
  ModelMode mode{number(json, "frequency"),
                 number(json, "error_estimate"),
                 number(json, "in_chain"),
                 fitted(numbers(json, "points"), model.points.size()),
                 fitted(numbers(json, "kinetic"), model.parts.size()),
                 fitted(numbers(json, "strain"), model.springs.size()),
                 {}};
  const Json &lines = list(json, "lines");
  for (std::size_t i = 0; i < model.lines.size(); ++i)
    mode.lines.push_back(
        fitted(i < lines.size() ? numbers_of(lines[i]) : Eigen::VectorXd(), std::size_t(model.lines[i].z.size())));
  return mode;
}

Model model_of(const Json &json)
{
  Model model;
  model.name     = text(json, "name");
  model.title    = text(json, "title");
  model.unknowns = count(json, "unknowns");
  model.source   = text(json, "source");
  model.points   = texts(json, "points");
  model.parts    = texts(json, "parts");
  model.springs  = texts(json, "springs");
  for (const Json &line : list(json, "lines"))
    if (ModelLine read{text(line, "name"), numbers(line, "z")}; read.z.size() > 0 && read.z.allFinite())
      model.lines.push_back(read);
    else
      model.lines.push_back({"", Eigen::VectorXd()});  // keeps its place, is not drawn
  for (const Json &mode : list(json, "modes"))
    model.modes.push_back(mode_of(mode, model));
  if (model.title.empty())
    model.title = model.name;
  return model;
}

ModePair pair_of(const Json &json)
{
  ModePair pair{count(json, "mode"), number(json, "six_mass"), {}};
  if (json.is_object())
    for (const auto &[name, partner] : json.items())
      if (partner.is_object())
        pair.partner[name] = {count(partner, "mode"), number(partner, "frequency"), number(partner, "mac")};
  return pair;
}

MassCount mass_count_of(const Json &json)
{
  const Eigen::VectorXd missing = numbers(json, "missing");
  return {
      count(json, "masses"),
      text(json, "added"),
      number(json, "worst_error"),
      count(json, "right"),
      count(json, "modes_below_limit"),
      {missing.data(), missing.data() + missing.size()}
  };
}

MassBreakdown breakdown_of(const Json &json)
{
  MassBreakdown breakdown{text(json, "mass"), text(json, "route"), {}};
  for (const Json &part : list(json, "parts"))
    breakdown.parts.push_back({text(part, "name"), number(part, "mass"), number(part, "equivalent")});
  return breakdown;
}

ModelData data_of(const Json &json)
{
  ModelData data;
  data.stored          = true;
  data.frequency_limit = number(json, "frequency_limit");
  data.at              = text(json, "at");
  data.driven          = text(json, "driven");
  data.answer          = texts(json, "answer");
  data.warnings        = texts(json, "warnings");
  for (const Json &model : list(json, "models"))
    data.models.push_back(model_of(model));
  for (const Json &pair : list(json, "pairs"))
    data.pairs.push_back(pair_of(pair));
  if (const Json *mac = entry_of(json, "mac")) {
    data.mac.rows             = text(*mac, "rows");
    data.mac.columns          = text(*mac, "columns");
    data.mac.row_frequency    = numbers(*mac, "row_frequency");
    data.mac.column_frequency = numbers(*mac, "column_frequency");
    data.mac.values = matrix(*mac, "values", data.mac.row_frequency.size(), data.mac.column_frequency.size());
  }
  for (const Json &masses : list(json, "masses_needed"))
    data.masses_needed.push_back(mass_count_of(masses));
  if (const Json *kept = entry_of(json, "kept_modes")) {
    for (const double n : numbers(*kept, "kept"))
      data.kept_modes.kept.push_back(std::abs(n) < 1e9 ? int(n) : 0);
    data.kept_modes.frequency = numbers(*kept, "frequency");
    data.kept_modes.error =
        matrix(*kept, "error", Eigen::Index(data.kept_modes.kept.size()), data.kept_modes.frequency.size());
  }
  for (const Json &breakdown : list(json, "breakdown"))
    data.breakdown.push_back(breakdown_of(breakdown));
  for (const Json &route : list(json, "routes"))
    data.routes.push_back({text(route, "mass"), number(route, "chain"), number(route, "fe_integral"),
                           number(route, "fe_solid"), number(route, "published")});
  return data;
}
}  // namespace

const Model *ModelData::find(const std::string &name) const
{
  for (const Model &model : models)
    if (model.name == name)
      return &model;
  return nullptr;
}

std::string ModelData::title(const std::string &name) const
{
  const Model *model = find(name);
  return model ? model->title : name;
}

const Model *ModelData::detailed() const
{
  for (auto model = models.rbegin(); model != models.rend(); ++model)
    if (model->name != "six-mass" && !model->modes.empty())
      return &*model;
  return nullptr;
}

ModelData read_models(const std::string &run_directory)
{
  const std::filesystem::path path = std::filesystem::path(run_directory) / "curves" / "models.json";
  if (!std::filesystem::exists(path))
    return {};
  ModelData broken;
  broken.problem = "curves/models.json is not what this program writes, so the models of the stand are not shown; "
                   "run the case again.";
  try {
    const Json json = json_of(read_text(path.string()));
    return json.is_object() ? data_of(json) : broken;
  } catch (const nlohmann::json::exception &) {
    return broken;
  } catch (const InputError &) {
    return broken;
  }
}
}  // namespace mill::report
