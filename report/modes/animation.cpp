#include "report/modes/animation.h"
#include "report/modes/drawing.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace mill::report {
namespace {
using Json = nlohmann::ordered_json;

constexpr double usual_swing      = 18;  // px of the largest displacement
constexpr std::size_t most_shares = 6;

std::vector<const ComparedModel *> models_with_modes(const ModelData &data)
{
  std::vector<const ComparedModel *> models;
  for (const ComparedModel &model : data.models)
    if (!model.modes.empty())
      models.push_back(&model);
  return models;
}

// The corner as page.js reads it: place, and the displacements that it follows.
std::string corner_text(const Corner &c)
{
  std::string text = pixel(c.x) + ',' + pixel(c.y) + ',' + std::to_string(c.from);
  if (c.share != 0)
    text += ',' + std::to_string(c.to) + ',' + pixel(c.share);
  return text;
}

bool moves(const MovingShape &shape)
{
  return std::any_of(shape.corners.begin(), shape.corners.end(),
                     [](const Corner &c) { return c.from != 0 || (c.share != 0 && c.to != 0); });
}

std::string shape_element(const MovingShape &shape, const Eigen::VectorXd &displacement)
{
  std::string text = shape.closed ? "<polygon" : "<polyline";
  text += " class=\"" + shape.classes + "\" points=\"";
  const auto points = moved(shape, displacement, shape.ghost ? -usual_swing : usual_swing);
  for (std::size_t i = 0; i < points.size(); ++i)
    text += (i ? " " : "") + pixel(points[i][0]) + ',' + pixel(points[i][1]);
  text += '"';
  if (moves(shape)) {
    text += " data-at=\"";
    for (std::size_t i = 0; i < shape.corners.size(); ++i)
      text += (i ? " " : "") + corner_text(shape.corners[i]);
    text += '"';
  }
  return text + "/>\n";
}

std::string drawing_element(const ComparedModel &model, const StandDrawing &drawing)
{
  const Eigen::VectorXd displacement = drawing.of(model, model.modes.front());
  std::string svg = "<svg role=\"img\" aria-label=\"" + escaped("the stand in a mode of " + model.title) +
                    "\" width=\"" + pixel(drawing.width) + "\" height=\"" + pixel(drawing.height) +
                    "\" viewBox=\"0 0 " + pixel(drawing.width) + ' ' + pixel(drawing.height) + "\">\n";
  for (const MovingShape &shape : drawing.shapes)
    svg += shape_element(shape, displacement);
  for (const FixedText &text : drawing.texts)
    svg += "<text class=\"" + text.classes + "\" x=\"" + pixel(text.x) + "\" y=\"" + pixel(text.y) +
           (text.anchor == Anchor::middle ? "\" text-anchor=\"middle\">" : "\">") + escaped(text.text) +
           "</text>\n";
  return svg + "</svg>\n";
}

std::string name_of_mode(const int number, const ModelMode &mode)
{
  return std::to_string(number) + " \u00b7 " + frequency_text(mode.frequency, mode.error_estimate) + " Hz";
}

std::string sentence_of(const ComparedModel &model, const int number, const ModelMode &mode)
{
  std::string text = "Mode " + std::to_string(number) + " of the model \u201c" + model.title + "\u201d, " +
                     frequency_text(mode.frequency, mode.error_estimate) + " Hz" +
                     (mode.error_estimate > 0 ? " " + accuracy(mode.error_estimate) : "") + ".";
  if (std::isfinite(mode.in_chain))
    text += " " + fixed(100 * mode.in_chain, 0) + " % of the motion is within reach of six masses.";
  return text;
}

using Shares = std::vector<std::pair<std::string, double>>;  // name, %

// The largest shares first; shares below half a percent are left out.
Shares largest(const std::vector<std::string> &names, const Eigen::VectorXd &share)
{
  Shares all;
  for (Eigen::Index i = 0; i < share.size(); ++i)
    if (share[i] >= 0.005)
      all.emplace_back(names[std::size_t(i)], 100 * share[i]);
  std::stable_sort(all.begin(), all.end(), [](const auto &a, const auto &b) { return a.second > b.second; });
  if (all.size() > most_shares)
    all.resize(most_shares);
  return all;
}

std::string share_list(const std::string &kind, const std::string &title, const Shares &shares)
{
  std::string list = "<div class=\"shares\"><h4>" + title + "</h4><ul data-shares=\"" + kind + "\">";
  for (const auto &[name, percent] : shares)
    list += "<li><span>" + escaped(name) + "</span><i><b style=\"width:" + pixel(percent) + "%\"></b></i><em>" +
            fixed(percent, 0) + " %</em></li>";
  return list + "</ul></div>\n";
}

Json shares_json(const Shares &shares)
{
  Json list = Json::array();
  for (const auto &[name, percent] : shares)
    list.push_back({name, std::round(10 * percent) / 10});
  return list;
}

Json model_json(const ComparedModel &model, const StandDrawing &drawing)
{
  Json modes = Json::array();
  for (std::size_t i = 0; i < model.modes.size(); ++i) {
    const ModelMode &mode   = model.modes[i];
    const Eigen::VectorXd d = drawing.of(model, mode);
    Json displacement       = Json::array();
    for (const double value : d)
      displacement.push_back(std::round(1e4 * value) / 1e4);
    Json entry;
    entry["say"]     = sentence_of(model, int(i) + 1, mode);
    entry["kinetic"] = shares_json(largest(model.parts, mode.kinetic));
    entry["strain"]  = shares_json(largest(model.springs, mode.strain));
    entry["d"]       = displacement;
    modes.push_back(entry);
  }
  Json json;
  json["name"]  = model.name;
  json["modes"] = modes;
  return json;
}

// A script element ends at the first "</", also inside a string; "<" stands nowhere else in JSON.
std::string in_script(const Json &json)
{
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t position = text.find('<'); position != std::string::npos; position = text.find('<', position))
    text.replace(position, 1, "\\u003c");
  return text;
}

std::string controls(const std::vector<const ComparedModel *> &models, const ComparedModel &first)
{
  std::string model_options, mode_lists;
  for (const ComparedModel *model : models) {
    const bool chosen = model == &first;
    model_options += "<option value=\"" + escaped(model->name) + "\"" + (chosen ? " selected=\"\"" : "") + ">" +
                     escaped(model->title) + "</option>";
    mode_lists += "<label data-model=\"" + escaped(model->name) + "\"" + (chosen ? "" : " hidden=\"\"") +
                  ">mode <select class=\"pick-mode\">";
    for (std::size_t i = 0; i < model->modes.size(); ++i)
      mode_lists += "<option value=\"" + std::to_string(i) + "\">" +
                    escaped(name_of_mode(int(i) + 1, model->modes[i])) + "</option>";
    mode_lists += "</select></label>\n";
  }
  return "<div class=\"controls\" hidden=\"\">\n<label>model <select class=\"pick-model\">" + model_options +
         "</select></label>\n" + mode_lists +
         "<button type=\"button\" class=\"play\">Play</button>\n"
         "<label>speed <input type=\"range\" class=\"speed\" min=\"0.1\" max=\"2\" step=\"0.1\" "
         "value=\"0.6\"/></label>\n"
         "<label>size of the motion <input type=\"range\" class=\"swing\" min=\"0\" max=\"45\" step=\"1\" "
         "value=\"" +
         pixel(usual_swing) + "\"/></label>\n</div>\n";
}
}  // namespace

std::string mode_player(const ModelData &data, const std::map<std::string, double> &geometry)
{
  const std::vector<const ComparedModel *> models = models_with_modes(data);
  if (models.empty())
    return "";
  const ComparedModel &first = data.detailed() ? *data.detailed() : *models.front();
  std::string drawings;
  Json json = Json::array();
  for (const ComparedModel *model : models) {
    const StandDrawing drawing = stand_drawing(*model, geometry);
    drawings += "<div class=\"mode-drawing\" data-model=\"" + escaped(model->name) + "\"" +
                (model == &first ? "" : " hidden=\"\"") + ">\n" + drawing_element(*model, drawing) + "</div>\n";
    json.push_back(model_json(*model, drawing));
  }
  const ModelMode &mode = first.modes.front();
  return "<div class=\"mode-player\">\n" + controls(models, first) + "<div class=\"mode-stage\">\n" + drawings +
         "<div class=\"mode-side\">\n<p class=\"mode-say\" aria-live=\"polite\">" +
         escaped(sentence_of(first, 1, mode)) + "</p>\n" +
         share_list("kinetic", "Kinetic energy by part [%]", largest(first.parts, mode.kinetic)) +
         share_list("strain", "Strain energy by spring [%]", largest(first.springs, mode.strain)) +
         "</div>\n</div>\n<script type=\"application/json\">" + in_script(json) + "</script>\n</div>\n";
}
}  // namespace mill::report
