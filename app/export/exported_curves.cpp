#include "app/export/exported_curves.h"
#include "app/export/exported_stand.h"
#include "app/stages/response/contact_curves.h"
#include "core/model/case.h"
#include "dynamics/fmu/model_text.h"
#include "dynamics/nonlinear/curve_response.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
fmu::CurveData curve_data(const dynamics::CurveStand &stand, const double longest_step)
{
  fmu::CurveData data;
  data.longest_step = longest_step;
  for (const dynamics::SpringLaw &law : stand.laws)
    data.laws.push_back({law.sample_loads(), law.sample_compressions(), law.series_compliance()});
  for (const dynamics::CurveSpring &s : stand.springs)
    data.springs.push_back({s.name, int(s.law), s.share, s.rest, s.force, s.stiffness, s.row});
  return data;
}

int steps_between_outputs(const dynamics::CurveStand &stand, const double output_rate)
{
  const double highest = *std::max_element(stand.rate.begin(), stand.rate.end()) / (2 * M_PI);
  return std::max(1, int(std::ceil(40 * highest / output_rate)));
}

namespace {
// Twenty steps about the mean force, as much above as below, so that their mean is the mean.
fmu::CheckRun curve_check(const CurveDrive &drive, const double mean, const double rate, const int parts)
{
  constexpr Eigen::Index n = 21;
  fmu::CheckRun check;
  check.step  = 1 / rate;
  check.force = Eigen::VectorXd::Constant(n, mean);
  for (Eigen::Index i = 0; i < n / 2; ++i) {
    const double swing = drive.load * (0.01 + 0.2 * std::sin(0.9 * double(i)));
    check.force[i] += swing;
    check.force[n - 1 - i] -= swing;
  }
  const ForceRecord record{Eigen::VectorXd::LinSpaced(n, 0, double(n - 1) * check.step), check.force, {}};
  const auto run     = dynamics::fixed_step_response(drive.stand, drive.modal, record, rate, parts);
  check.acceleration = run.response.acceleration;
  check.load_cell    = run.response.load_cell;
  return check;
}

std::string springs_of(const CurveDrive &drive)
{
  std::string names;
  for (const NonlinearSpring &spring : drive.springs)
    names += (names.empty() ? "" : ", ") + spring.name;
  return names;
}
}  // namespace

fmu::ExportedModel exported_curves(const DrivenStand &stand, const Case &of)
{
  const CurveDrive &drive        = *stand.curves;
  fmu::ExportedModel model       = exported_model(stand, of);
  const fmu::ModelData unit_data = model.data;
  const double rate              = stand.dynamics.output_rate;
  const int parts                = steps_between_outputs(drive.stand, rate);
  fmu::ModelData &data           = model.data;
  data                           = modal_data(drive.modal);
  data.kind                      = fmu::StandKind::curves;
  data.runtime                   = unit_data.runtime;
  data.has_series                = unit_data.has_series;
  data.mean_force                = unit_data.mean_force;
  data.curves                    = curve_data(drive.stand, 1 / (rate * parts));
  model.method = fmt::format("{}; {} follow their curves from {:.6g} kN at rest, in steps of {:.4g} us",
                             model.method, springs_of(drive), drive.load / 1e3, 1e6 * data.curves.longest_step);
  // Forty inner steps are the shortest period: a client takes one or two of them.
  model.step  = data.curves.longest_step * (parts % 2 == 0 ? 2 : 1);
  model.check = curve_check(drive, data.mean_force, rate, parts);
  data.guid   = fmu::identity_of(model);
  return model;
}
}  // namespace mill
