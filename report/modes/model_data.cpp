#include "report/modes/model_data.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/model/dynamics_settings.h"
#include "core/records/json_archive.h"
#include <algorithm>
#include <filesystem>

namespace mill::report {
namespace {
// As many numbers as they describe things; what is too short ends in gaps.
void fit(Eigen::VectorXd &values, const std::size_t n)
{
  const Eigen::Index had = values.size(), wanted = Eigen::Index(n);
  values.conservativeResize(wanted);
  values.tail(std::max<Eigen::Index>(0, wanted - had)).setConstant(not_given);
}

void fit(Eigen::MatrixXd &values, const Eigen::Index n, const Eigen::Index m)
{
  Eigen::MatrixXd out = Eigen::MatrixXd::Constant(n, m, not_given);
  const auto rows = std::min(n, values.rows()), columns = std::min(m, values.cols());
  out.topLeftCorner(rows, columns) = values.topLeftCorner(rows, columns);
  values.swap(out);
}

void fit(ComparedModel &model)
{
  for (ModelLine &line : model.lines)
    if (line.z.size() == 0 || !line.z.allFinite())
      line = {};  // keeps its place, is not drawn
  for (ModelMode &mode : model.modes) {
    fit(mode.points, model.points.size());
    fit(mode.kinetic, model.parts.size());
    fit(mode.strain, model.springs.size());
    mode.lines.resize(model.lines.size());
    for (std::size_t i = 0; i < mode.lines.size(); ++i)
      fit(mode.lines[i], std::size_t(model.lines[i].z.size()));
  }
  if (model.title.empty())
    model.title = model.name;
}
}  // namespace

const ComparedModel *ModelData::find(const std::string &name) const
{
  for (const ComparedModel &model : models)
    if (model.name == name)
      return &model;
  return nullptr;
}

std::string ModelData::title(const std::string &name) const
{
  const ComparedModel *model = find(name);
  return model ? model->title : name;
}

const ComparedModel *ModelData::detailed() const
{
  for (auto model = models.rbegin(); model != models.rend(); ++model)
    if (model->name != word_of(StandModelKind::six_mass) && !model->modes.empty())
      return &*model;
  return nullptr;
}

ModelData read_models(const std::string &run_directory)
{
  const std::filesystem::path path = std::filesystem::path(run_directory) / "curves" / "models.json";
  ModelData data;
  if (!std::filesystem::exists(path))
    return data;
  try {
    static_cast<ModelsRecord &>(data) = record_of_json<ModelsRecord>(read_text(path.string()));
    data.stored                       = true;
  } catch (const InputError &) {
    data.problem = "curves/models.json is not what this program writes, so the models of the stand are not shown; "
                   "run the case again.";
  }
  for (ComparedModel &model : data.models)
    fit(model);
  fit(data.mac.values, data.mac.row_frequency.size(), data.mac.column_frequency.size());
  fit(data.kept_modes.error, Eigen::Index(data.kept_modes.kept.size()), data.kept_modes.frequency.size());
  return data;
}
}  // namespace mill::report
