#include "dynamics/response/response.h"
#include "core/base/errors.h"
#include "core/base/short_number.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace mill::dynamics {
DrivenModel driven_model(const MillModel &model)
{
  return {state_space(model), model.labels, model.load_cell_share};
}

DrivenModel driven_model(const ModalModel &model)
{
  return {state_space(model), model.labels, model.load_cell_share};
}

Response mill_response(const MillModel &model, const ForceRecord &force, const double output_rate,
                       const HoldForm wanted)
{
  return mill_response(driven_model(model), force, output_rate, wanted);
}

Response mill_response(const DrivenModel &model, const ForceRecord &force, const double output_rate,
                       const HoldForm wanted)
{
  const double mean = force.force.mean();
  ForceRecord fluctuation{force.time, force.force.array() - mean, {}};
  HoldResult held = first_order_hold(model.system, fluctuation, output_rate, wanted);

  const auto n = Eigen::Index(model.labels.size());
  Response response;
  response.labels       = model.labels;
  response.time         = std::move(held.time);
  response.force        = held.force.array() + mean;
  response.acceleration = held.output.topRows(n).transpose();
  response.load_cell    = held.output.row(n).transpose().array() + model.load_cell_share * mean;  // (6.8)
  response.form         = held.form;
  response.note         = held.note;
  return response;
}

Level level(const Eigen::VectorXd &acceleration)
{
  return {acceleration.cwiseAbs().maxCoeff(), std::sqrt(acceleration.squaredNorm() / double(acceleration.size()))};
}

std::optional<Warning> output_rate_warning(const double output_rate, const double highest_mode)
{
  const double points = output_rate / highest_mode;
  if (points >= 20)
    return {};
  const double lost = 100 * (1 - std::cos(std::min(M_PI / 2, M_PI / points)));
  return Warning{WarningId::output_rate,
                 "",
                 "output_rate = " + short_number(output_rate / 1e3) + " kHz gives " + short_number(points, 3) +
                     " points per period of the highest mode (" + short_number(highest_mode) + " Hz)",
                 "its peaks may be seen up to " + short_number(lost, 2) + " % low",
                 short_number(std::ceil(20 * highest_mode / 1e3), 3) + " kHz would show them",
                 {},
                 "dynamics.output_rate"};
}

namespace {
Level level_between(const Eigen::VectorXd &time, const Eigen::VectorXd &signal, const double begin,
                    const double end)
{
  const auto first = std::lower_bound(time.begin(), time.end(), begin) - time.begin();
  const auto last  = std::upper_bound(time.begin(), time.end(), end) - time.begin();
  if (last - first < 2)
    throw InputError("the measured accelerations and the rolling force share no stretch of time of two samples: "
                     "check that both count seconds from the same instant");
  return level(signal.segment(first, last - first));
}
}  // namespace

Comparison compare(const Response &response, const MeasuredRecord &measured)
{
  Comparison result;
  result.begin        = std::max(response.time[0], measured.time[0]);
  result.end          = std::min(response.time[response.time.size() - 1], measured.time[measured.time.size() - 1]);
  const auto compared = [&](const Mass roll, const Eigen::VectorXd &record) {
    const Level computed = level_between(response.time, response.acceleration.col(roll), result.begin, result.end);
    const Level known    = level_between(measured.time, record, result.begin, result.end);
    return RollComparison{computed, known, computed.peak / known.peak, computed.rms / known.rms};
  };
  result.upper_work_roll = compared(upper_work_roll, measured.upper_work_roll);
  result.lower_work_roll = compared(lower_work_roll, measured.lower_work_roll);
  return result;
}

Table response_table(const Response &response)
{
  Table table;
  const auto add = [&](const std::string &name, const std::string &unit, const Eigen::VectorXd &column) {
    table.names.push_back(name);
    table.units.push_back(unit);
    table.columns.push_back(column);
  };
  add("time", "s", response.time);
  std::vector<Eigen::Index> order{upper_work_roll,   lower_work_roll,   upper_frame,
                                  upper_backup_roll, lower_backup_roll, lower_frame};
  for (Eigen::Index further = 6; further < response.acceleration.cols(); ++further)
    order.push_back(further);
  for (const Eigen::Index point : order) {
    std::string name = response.labels[std::size_t(point)];
    std::replace_if(
        name.begin(), name.end(), [](const char c) { return c == ' ' || c == '-'; }, '_');
    add(name, "g", response.acceleration.col(point) / standard_gravity);
  }
  add("force", "kN", response.force / 1e3);
  add("load_cell", "kN", response.load_cell / 1e3);
  return table;
}
}  // namespace mill::dynamics
