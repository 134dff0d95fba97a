#include "app/stages/response/detailed_model_stage.h"
#include "app/stages/response/dynamics_stage.h"
#include "app/stages/stand/mode_results.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/records/detailed_model.h"
#include "core/records/rows_of_stand.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
// Frequencies as the case has them are those of the matrices to the digits of an eigenvalue of a stiff stand.
constexpr double same_frequency = 1e-6;

void require_same_modes(const ModelFiles &files, const Eigen::VectorXd &frequency)
{
  for (const auto &[number, hertz] : files.modes) {
    const auto i = Eigen::Index(std::lround(number)) - 1;
    if (i < 0 || i >= frequency.size() || std::abs(frequency[i] / hertz - 1) > same_frequency)
      throw InputError(
          files.place,
          fmt::format("model.modes says that mode {:g} is at {:.6g} Hz; the matrices have {}: they are "
                      "not those of this model",
                      number, hertz,
                      i < 0 || i >= frequency.size() ? std::string("no such mode")
                                                     : fmt::format("{:.6g} Hz", frequency[i])));
  }
}
}  // namespace

reduce::StandWithModes model_from_files(const ModelFiles &files)
{
  reduce::StandWithModes s{detailed_model_of(files), {}};
  s.modes = reduce::stand_modes(s.model, 2 * files.frequency_limit);
  require_same_modes(files, s.modes.frequency);
  return s;
}

void drive_files(DrivenStand &driven, const ModelFiles &files)
{
  driven.detailed                 = std::make_shared<const reduce::StandWithModes>(model_from_files(files));
  driven.dynamics.frequency_limit = files.frequency_limit;
  driven.chain.C.value            = files.gap_damper;
  driven.modes                    = driven_modes(*driven.detailed, driven.chain, driven.dynamics);
}

void run_detailed_model(RunContext &run, const Lumped &lumped, const Goal goal, const std::string &force_file)
{
  const ModelFiles &files        = lumped.model;
  const reduce::StandWithModes s = model_from_files(files);
  write_mode_table(run, s);
  DynamicsSettings settings = lumped.dynamics;
  settings.frequency_limit  = files.frequency_limit;
  for (Eigen::Index i = 0; i < s.modes.frequency.size() && s.modes.frequency[i] <= files.frequency_limit; ++i) {
    Parameter f;
    f.value       = s.modes.frequency[i];
    f.unit        = "Hz";
    f.method      = "matrices of model " + files.name;
    f.error_lacks = keys_in("model", "mass stiffness");
    f.inputs      = f.error_lacks;
    run.results.add(row::modes::vertical.of("", std::to_string(i + 1)), f);
  }
  run.assume(fmt::format("modal damping of {:g} % in every mode", 100 * settings.modal_damping));
  if (goal < Goal::simulate)
    return;
  LumpedModel chain;
  chain.C.value   = files.gap_damper;
  PassModel model = pass_model(s, chain, settings);
  model.method    = "model " + files.name;
  for (std::size_t p = 0; p < lumped.passes.size(); ++p) {
    model.of_pass = response_keys(*run.keys, p);  // the files are among them
    Pass pass     = lumped.passes[p];
    if (!force_file.empty())
      pass.force_file = force_file;
    if (has_force(pass))
      simulate_pass(run, model, settings, pass, force_of(pass));
    run.progress.at("passes", double(p + 1) / double(lumped.passes.size()));
  }
}
}  // namespace mill
