#include "core/case/lumped_model_toml.h"
#include "core/case/given.h"
#include "core/case/row_lines.h"
#include "core/model/case.h"
#include "core/model/four_high.h"
#include "core/model/lumped.h"
#include "core/model/stack_input.h"
#include "core/records/detailed_model.h"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace mill {
namespace {
std::string relative_to(const std::string &directory, const std::string &path)
{
  namespace fs        = std::filesystem;
  const auto absolute = [](const std::string &p) { return fs::absolute(p.empty() ? "." : p).lexically_normal(); };
  return path.empty() ? "" : absolute(path).lexically_proximate(absolute(directory)).string();
}

PassInput input_of(const Pass &pass, const std::string &directory)
{
  constexpr double g = 9.80665;  // m/s2
  PassInput input;
  static_cast<Pass &>(input) = pass;
  for (std::size_t i = 0; i < 2; ++i) {
    input.published_peak[i] = pass.published_peak_g[i] * g;
    input.measured_peak[i]  = pass.measured_peak_g[i] * g;
  }
  input.force_file    = relative_to(directory, pass.force_file);
  input.measured_file = relative_to(directory, pass.measured_file);
  return input;
}

const std::vector<Pass> &passes_of(const Case &c)
{
  if (const auto *stack = std::get_if<StackCase>(&c.spec))
    return stack->input->passes;
  const auto *stand = std::get_if<FourHigh>(&c.spec);
  return stand ? stand->passes : std::get<Lumped>(c.spec).passes;
}

const DynamicsSettings &dynamics_of(const Case &c)
{
  if (const auto *stack = std::get_if<StackCase>(&c.spec))
    return stack->input->dynamics;
  const auto *stand = std::get_if<FourHigh>(&c.spec);
  return stand ? stand->dynamics : std::get<Lumped>(c.spec).dynamics;
}

// Campbell diagram with the rolls that a chain does not draw.
CampbellSettings campbell_of(const Case &c)
{
  const auto *stand = std::get_if<FourHigh>(&c.spec);
  if (!stand)
    return std::get<Lumped>(c.spec).campbell;
  CampbellSettings settings     = stand->campbell;
  settings.work_roll_diameter   = stand->work_roll.barrel_diameter;
  settings.backup_roll_diameter = stand->backup_roll.barrel_diameter;
  return settings;
}

// What a chain keeps of the frequency response, the Campbell diagram and the drive.
std::string turning_sections(const Case &c)
{
  const auto *stand = std::get_if<FourHigh>(&c.spec);
  std::string text;
  const auto add = [&](const char *header, const std::string &lines) {
    if (!lines.empty())
      text += std::string("\n") + header + "\n" + lines;
  };
  add("[frequency_response]",
      lines(frequency_response_rows(),
            stand ? stand->frequency_response : std::get<Lumped>(c.spec).frequency_response));
  add("[campbell]", lines(chain_campbell_rows(), campbell_of(c)));
  for (const DriveOrder &order : stand ? stand->drive : std::get<Lumped>(c.spec).drive)
    add("[[drive.order]]", lines(drive_order_rows(), order));
  return text;
}

std::string passes_and_dynamics(const Case &origin, const std::string &directory)
{
  std::string text;
  for (const Pass &pass : passes_of(origin))
    text += pass_toml(pass, directory);
  text += "\n[dynamics]\n" + lines(chain_dynamics_rows(), dynamics_of(origin));
  return std::holds_alternative<StackCase>(origin.spec) ? text : text + turning_sections(origin);
}

// Parameter by the name it has in [given].
const Parameter &entry(const LumpedModel &model, const std::string &name)
{
  if (name == "C")
    return model.C;
  if (name.compare(0, 3, "Kzc") == 0) {
    const auto index = std::size_t(name[3] - '1');
    return name.size() > 4 ? model.Kzc_across[index] : model.Kzc[index];
  }
  const auto index = std::size_t(name.back() - '1');
  return name[0] == 'M' ? model.M[index] : model.K[index];
}
}  // namespace

LumpedModel lumped_model_of(const Case &lumped_case)
{
  const GivenValues &given = std::get<Lumped>(lumped_case.spec).given;
  LumpedModel model;
  const auto take = [&](const std::string &name, Parameter &into) {
    if (const auto entry = given.find(name); entry != given.end())
      into = entry->second.parameter;
  };
  for (std::size_t i = 0; i < model.M.size(); ++i)
    take("M" + std::to_string(i + 1), model.M[i]);
  for (std::size_t i = 0; i < model.K.size(); ++i)
    take("K" + std::to_string(i + 1), model.K[i]);
  for (std::size_t i = 0; i < model.Kzc.size(); ++i) {
    take("Kzc" + std::to_string(i + 1), model.Kzc[i]);
    take("Kzc" + std::to_string(i + 1) + "_across", model.Kzc_across[i]);
  }
  model.C.value  = 0;
  model.C.unit   = "N s/m";
  model.C.source = Source::assumed;
  model.C.method = "no damper given";
  take("C", model.C);
  return model;
}

std::string pass_toml(const Pass &pass, const std::string &directory)
{
  return "\n[[pass]]\n" + lines(pass_rows(), input_of(pass, directory));
}

std::string lumped_model_toml(const LumpedModel &model, const Case &origin, const std::string &directory)
{
  CaseHead head{1, "lumped", origin.title};
  std::string text = lines(head_rows(), head);
  text += "\n[given]\n";
  for (const Row &row : given_rows("lumped")) {
    const Parameter &parameter = entry(model, row.key);
    if (!std::isnan(parameter.value))
      text += row.key + " = " + given_toml(row, parameter) + "\n";
  }
  return text + passes_and_dynamics(origin, directory);
}

std::string detailed_model_toml(const ModelFiles &files, const Case &origin, const std::string &directory)
{
  return lines(head_rows(), CaseHead{1, "lumped", origin.title + ", " + files.name}) + "\n[model]\n" +
         lines(model_file_rows(), files) + passes_and_dynamics(origin, directory);
}
}  // namespace mill
