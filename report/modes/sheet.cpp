#include "report/modes/animation.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace mill::report {
namespace {
constexpr int across        = 7;
constexpr double cell_width = 148, cell_height = 214, half_width = 54, swing = 9;  // px
constexpr double first_height = 62, axis_spacing = 30;                             // px
constexpr std::size_t most_shown = 28;
const std::array<const char *, 4> rolls{"upper backup roll", "upper work roll", "lower work roll",
                                        "lower backup roll"};

double or_rest(const double displacement)
{
  return std::isfinite(displacement) ? displacement : 0;
}

const Eigen::VectorXd *line_of(const ComparedModel &model, const ModelMode &mode, const std::string &name,
                               const Eigen::VectorXd **z)
{
  for (std::size_t i = 0; i < model.lines.size(); ++i)
    if (model.lines[i].name == name && model.lines[i].z.size() > 1) {
      *z = &model.lines[i].z;
      return &mode.lines[i];
    }
  return nullptr;
}

double displacement_of(const ComparedModel &model, const ModelMode &mode, const std::string &name)
{
  const auto match = std::find(model.points.begin(), model.points.end(), name);
  return match == model.points.end() ? std::nan("") : mode.points[match - model.points.begin()];
}

struct Sheet {
  Svg &svg;
  const ComparedModel &model;
  double scale;  // px/m

  void bar(const ModelMode &mode, const std::string &name, const double x, const double y, const double half) const
  {
    const double d = displacement_of(model, mode, name);
    if (!std::isfinite(d))
      return;
    svg.line(x - half, y, x + half, y, "rest");
    for (const double side : {-1.0, 1.0})
      svg.line(x - half, y - side * swing * d, x + half, y - side * swing * d, side < 0 ? "pen warm" : "pen dark");
  }

  void roll(const ModelMode &mode, const std::string &name, const double x, const double y) const
  {
    const Eigen::VectorXd *z    = nullptr;
    const Eigen::VectorXd *line = line_of(model, mode, name, &z);
    if (!line) {
      bar(mode, name, x, y, 40);
      return;
    }
    const double half = scale * (*z)[z->size() - 1];
    svg.line(x - half, y, x + half, y, "rest");
    for (const double side : {-1.0, 1.0}) {
      std::vector<Eigen::Vector2d> axis;
      for (Eigen::Index i = z->size() - 1; i > 0; --i)
        axis.emplace_back(x - scale * (*z)[i], y - side * swing * or_rest((*line)[i]));
      for (Eigen::Index i = 0; i < z->size(); ++i)
        axis.emplace_back(x + scale * (*z)[i], y - side * swing * or_rest((*line)[i]));
      svg.polyline(axis, side < 0 ? "pen warm" : "pen dark");
    }
  }

  void picture(const ModelMode &mode, const int number, const double x, const double top) const
  {
    svg.text(x, top + 16,
             std::to_string(number) + " \u00b7 " + frequency_text(mode.frequency, mode.error_estimate) + " Hz",
             "t strong", Anchor::middle);
    if (std::isfinite(mode.in_chain))
      svg.text(x, top + 31, fixed(100 * mode.in_chain, 0) + " % within reach", "t small", Anchor::middle);
    const double y = top + first_height;
    bar(mode, "upper frame", x, y - 16, 50);
    for (std::size_t i = 0; i < rolls.size(); ++i)
      roll(mode, rolls[i], x, y + (double(i) + 0.2) * axis_spacing);
    bar(mode, "lower frame", x, y + 3.4 * axis_spacing + 22, 50);
    for (const double side : {-1.0, 1.0}) {
      bar(mode, "upper backup chock", x + side * 61, y + 0.2 * axis_spacing, 6);
      bar(mode, "upper work-roll chock", x + side * 61, y + 1.2 * axis_spacing, 6);
      bar(mode, "lower work-roll chock", x + side * 61, y + 2.2 * axis_spacing, 6);
      bar(mode, "lower backup chock", x + side * 61, y + 3.2 * axis_spacing, 6);
    }
  }
};
}  // namespace

std::string mode_sheet(const ModelData &data)
{
  const ComparedModel *model = data.detailed();
  if (!model)
    return "";
  double longest = 0;
  for (const ModelLine &line : model->lines)
    if (line.z.size() > 1)
      longest = std::max(longest, line.z[line.z.size() - 1]);
  std::vector<int> shown;
  for (std::size_t i = 0; i < model->modes.size() && shown.size() < most_shown; ++i)
    if (!(model->modes[i].frequency > data.frequency_limit))
      shown.push_back(int(i));
  if (!(longest > 0) || shown.empty())
    return "";
  const int rows = (int(shown.size()) + across - 1) / across;
  Svg svg(across * cell_width, rows * cell_height + 24, "every mode of the model " + model->title + " in small");
  const Sheet sheet{svg, *model, half_width / longest};
  for (std::size_t i = 0; i < shown.size(); ++i)
    sheet.picture(model->modes[std::size_t(shown[i])], shown[i] + 1, (double(i % across) + 0.5) * cell_width,
                  double(i / across) * cell_height);
  svg.text(across * cell_width / 2, rows * cell_height + 16,
           "roll axes " + fixed(2e3 * longest, 0) +
               " mm across [mm]; displacement relative, largest of the mode = 1 [-]",
           "axis", Anchor::middle);
  return svg.str();
}
}  // namespace mill::report
