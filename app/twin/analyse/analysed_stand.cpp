#include "app/twin/analyse/analysed_stand.h"
#include "app/twin/stand/case_chain.h"
#include "app/twin/stand/detail_parts.h"
#include "app/twin/stand/mode_errors.h"
#include "core/base/force_text.h"
#include "core/model/case.h"
#include "core/model/lumped_model.h"
#include "core/records/chain_number.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modes.h"
#include "reduce/bearing/pass_frequencies.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace mill {
namespace {
Note unknown_accuracy(const std::string &springs)
{
  return {NoteId::error_not_stated, "", "the case does not state the accuracy of " + springs,
          "a mode that they support is named where it is the nearest within 5 %"};
}

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
    stand.notes.push_back(unknown_accuracy(unknown));
  stand.frequency     = modes.frequency;
  stand.shape         = modes.shape;
  stand.strain_share  = modes.strain_share;
  stand.kinetic_share = modes.kinetic_share;
}

std::string place_of(std::string name)
{
  std::replace_if(
      name.begin(), name.end(), [](const char c) { return c == ' ' || c == '-'; }, '_');
  return name;
}

// The springs of a detailed stand, then its bodies, which are as their drawing says.
void add_beams(twin::CaseModel &stand, const reduce::StandWithModes &beams, const LumpedModel &chain)
{
  const auto &connections = beams.model.connections;
  const auto n = Eigen::Index(connections.size()), bodies = Eigen::Index(beams.model.parts.size());
  stand.spring_error = Eigen::VectorXd::Zero(n + bodies);
  std::string unknown;
  for (Eigen::Index j = 0; j < n; ++j) {
    const std::string &name = connections[std::size_t(j)].name;
    double error            = connections[std::size_t(j)].error_estimate;
    for (std::size_t k = 0; k < chain.K.size() && std::isnan(error); ++k)
      if (name == word_of(ChainNumber(std::size_t(ChainNumber::K1) + k)))
        error = chain.K[k].error_estimate;
    stand.springs.push_back(name);
    stand.spring_error[j] = error;
    if (std::isnan(error))
      unknown += (unknown.empty() ? "" : ", ") + name;
  }
  for (const std::string &part : beams.model.parts)
    stand.springs.push_back("bending of the " + part);
  if (!unknown.empty())
    stand.notes.push_back(unknown_accuracy(unknown));
  stand.shape.resize(Eigen::Index(beams.model.points.size()), beams.modes.shape.cols());
  for (std::size_t p = 0; p < beams.model.points.size(); ++p) {
    stand.places.push_back(place_of(beams.model.points[p].name));
    stand.shape.row(Eigen::Index(p)) = beams.model.points[p].row.transpose() * beams.modes.shape;
  }
  stand.frequency = beams.modes.frequency;
  stand.bodies    = beams.model.parts;
  stand.strain_share.resize(beams.modes.shape.cols(), n + bodies);
  stand.strain_share << beams.modes.strain.transpose(), beams.modes.strain_of_part.transpose();
  stand.kinetic_share = beams.modes.kinetic.transpose();
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
    std::string roll = word_of(b.roll);
    std::replace(roll.begin(), roll.end(), ' ', '_');
    const auto turning =
        std::find_if(stand.rolls.begin(), stand.rolls.end(), [&](const auto &one) { return one.name == roll; });
    if (turning == stand.rolls.end()) {
      stand.notes.emplace_back(
          NoteId::bearing_not_computed, "bearing " + b.name,
          fmt::format("not computed, the case states no diameter of the {}", word_of(b.roll)));
      continue;
    }
    const auto orders = bearing::pass_frequencies(b.balls, b.ball_diameter, b.pitch_diameter, b.contact_angle);
    stand.bearings.push_back(
        {b.name, roll, turning->diameter, orders.cage, orders.outer, orders.inner, orders.roller});
  }
}

twin::CaseModel analysed_stand(const Case &the_case, const bool six_masses)
{
  const CaseChain chain = case_chain(the_case, "analyse");
  twin::CaseModel stand;
  stand.name        = the_case.name;
  stand.source      = chain.source;
  const auto *drawn = std::get_if<FourHigh>(&the_case.spec);
  if (drawn && !six_masses) {
    add_beams(stand, closed_form_beams(*drawn, chain), chain.model);
    stand.source = "rolls as beams, springs by closed forms at " + force_text(chain.load);
  } else
    add_chain(stand, chain.model, chain.dynamics);
  if (const auto warning = six_masses ? warning_of_six_masses(the_case, "analyse") : std::nullopt)
    stand.notes.push_back(*warning);
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
