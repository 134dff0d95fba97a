#include "app/twin/analyse/analysed_stand.h"
#include "app/twin/stand/case_chain.h"
#include "app/twin/stand/mode_errors.h"
#include "core/model/case.h"
#include "core/model/lumped_model.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modes.h"
#include "reduce/bearing/pass_frequencies.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace mill {
namespace {
void add_chain(twin::CaseModel &stand, const LumpedModel &model, const DynamicsSettings &settings)
{
  const auto chain = dynamics::mill_model(model, settings);
  const auto modes = dynamics::modes(chain);
  for (std::string label : chain.labels) {
    std::replace(label.begin(), label.end(), ' ', '_');
    stand.places.push_back(label);
  }
  stand.spring_error.resize(Eigen::Index(chain.springs.size()));
  std::string unknown;
  for (std::size_t j = 0; j < chain.springs.size(); ++j) {
    stand.springs.push_back(chain.springs[j].name);
    double error = std::numeric_limits<double>::quiet_NaN();
    if (j < model.K.size() && std::isfinite(model.K[j].error_estimate))
      error = model.K[j].error_estimate;
    else if (chain.springs[j].stiffness > 0)
      unknown += (unknown.empty() ? "" : ", ") + chain.springs[j].name;
    stand.spring_error[Eigen::Index(j)] = error;
  }
  if (!unknown.empty())
    stand.notes.push_back(fmt::format("the case does not state the accuracy of {}: a mode that they support is "
                                      "named where it is the nearest within 5 %",
                                      unknown));
  stand.frequency     = modes.frequency;
  stand.shape         = modes.shape;
  stand.strain_share  = modes.strain_share;
  stand.kinetic_share = modes.kinetic_share;
}

void add_roll(twin::CaseModel &stand, const std::string &name, const double diameter)
{
  if (std::isfinite(diameter))
    stand.rolls.push_back({name, diameter});
}

void add_bearing(twin::CaseModel &stand, const std::vector<RollerBearing> &bearings, const std::string &name,
                 const std::string &roll, const double diameter)
{
  const auto bearing =
      std::find_if(bearings.begin(), bearings.end(), [&](const RollerBearing &b) { return b.name == name; });
  if (bearing == bearings.end())
    return;
  const auto orders = bearing::pass_frequencies(*bearing);
  stand.bearings.push_back({name, roll, diameter, orders.cage, orders.outer, orders.inner, orders.roller});
}
}  // namespace

void add_ball_bearings(twin::CaseModel &stand, const std::vector<BallBearing> &bearings)
{
  for (const BallBearing &b : bearings) {
    std::string roll = b.roll;
    std::replace(roll.begin(), roll.end(), ' ', '_');
    const auto turning =
        std::find_if(stand.rolls.begin(), stand.rolls.end(), [&](const auto &one) { return one.name == roll; });
    if (turning == stand.rolls.end()) {
      stand.notes.push_back(
          fmt::format("bearing {}: not computed, the case states no diameter of the {}", b.name, b.roll));
      continue;
    }
    const auto orders = bearing::pass_frequencies(b.balls, b.ball_diameter, b.pitch_diameter, b.contact_angle);
    stand.bearings.push_back(
        {b.name, roll, turning->diameter, orders.cage, orders.outer, orders.inner, orders.roller});
  }
}

twin::CaseModel analysed_stand(const Case &the_case)
{
  const CaseChain chain = case_chain(the_case, "analyse");
  twin::CaseModel stand;
  stand.name   = the_case.name;
  stand.source = chain.source;
  add_chain(stand, chain.model, chain.dynamics);
  stand.frequency_error = mode_errors_of_run(the_case, stand.frequency);
  if (const auto *four = std::get_if<FourHigh>(&the_case.spec)) {
    add_roll(stand, "work_roll", four->work_roll.barrel_diameter);
    add_roll(stand, "backup_roll", four->backup_roll.barrel_diameter);
    add_bearing(stand, four->bearings, four->work_roll.bearing, "work_roll", four->work_roll.barrel_diameter);
    add_bearing(stand, four->bearings, four->backup_roll.bearing, "backup_roll",
                four->backup_roll.barrel_diameter);
  } else if (const auto *lumped = std::get_if<Lumped>(&the_case.spec)) {
    add_roll(stand, "work_roll", lumped->campbell.work_roll_diameter);
    add_roll(stand, "backup_roll", lumped->campbell.backup_roll_diameter);
  }
  return stand;
}
}  // namespace mill
