#include "app/stack/stack_bearings.h"
#include "app/stages/bearing/bearing_files.h"
#include "app/stages/bearing/bearing_model.h"
#include "app/stages/bearing/bearing_results.h"
#include "core/case/kinds.h"
#include "core/model/stack_supports.h"
#include "core/records/rows_of_stack.h"
#include "core/records/stack_names.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double usual_line_load = 1e6;  // N/m, of the strip, where a gap is given instead of a force
constexpr int loads_of_curve     = 24;
constexpr double least_share = 1. / 40, largest_share = 6;  // of the load, over the curve

// Radial load of the heavier bearing of a roll, N.
double heavier_load(const Stack &stack, const std::size_t roll, const std::vector<StackResultant> &resultants)
{
  return support_forces(stack, roll, resultants).colwise().norm().maxCoeff();
}

const std::string &bearing_of_roll(const StackRoll &roll)
{
  static const std::string none;
  return roll.supports.empty() ? none : roll.supports.front().bearing;
}

// Of each bearing that a roll names the largest load.
std::map<std::string, double> loads_of_bearings(Stack stack)
{
  if (!(stack.strip.force > 0))
    stack.strip.force = usual_line_load * stack.strip.width;
  const auto resultants = stack_resultants(stack, stack.strip.force);
  std::map<std::string, double> loads;
  for (std::size_t r = 0; r < stack.rolls.size(); ++r)
    if (const std::string &name = bearing_of_roll(stack.rolls[r]); !name.empty())
      loads[name] = std::max(loads[name], heavier_load(stack, r, resultants));
  return loads;
}

BearingQuestion stack_bearing_question(const StackInput &input, const std::string &name, const double load)
{
  BearingQuestion q;
  q.bearing = bearing_of(input.bearings, name);
  q.radial  = load;
  for (int i = 0; i < loads_of_curve; ++i)
    q.loads.push_back(load * least_share *
                      std::pow(largest_share / least_share, double(i) / (loads_of_curve - 1)));
  return q;
}

std::shared_ptr<const BearingCurve> curve_of(const BearingQuestion &question, const bearing::AssemblyCurve &states)
{
  BearingCurve curve;
  for (std::size_t i = 0; i < states.states.size(); ++i) {
    curve.load.push_back(question.loads[i]);
    curve.approach.push_back(states.states[i].motion[0]);
    curve.tangent.push_back(
        bearing::radial_tangent(states.states[i], bearing::drive_of(question, question.loads[i])));
  }
  return std::make_shared<const BearingCurve>(std::move(curve));
}

Stack with_curves(Stack stack, const std::map<std::string, std::shared_ptr<const BearingCurve>> &curves)
{
  for (StackRoll &roll : stack.rolls)
    for (StackSupport &support : roll.supports)
      if (!support.bearing.empty())
        support.curve = curves.at(support.bearing);
  return stack;
}
}  // namespace

StackBearings solve_stack_bearings(RunContext &run, const StackInput &input, const Stack &stack)
{
  StackBearings bearings;
  for (const auto &[name, load] : loads_of_bearings(stack)) {
    const BearingQuestion question = stack_bearing_question(input, name, load);
    const BearingParts parts =
        bearing_parts(run, question.bearing, bearing::largest_roller_load(question.bearing, question));
    bearings[name] = study_bearing(run, parts, question);
  }
  return bearings;
}

Stack with_bearing_curves(Stack stack, const StackBearings &bearings)
{
  std::map<std::string, std::shared_ptr<const BearingCurve>> curves;
  for (const auto &[name, study] : bearings)
    curves[name] = curve_of(study.question, study.curve);
  return with_curves(std::move(stack), curves);
}

Stack with_softer_bearing(Stack stack, const std::string &bearing, const double share)
{
  for (StackRoll &roll : stack.rolls)
    for (StackSupport &support : roll.supports)
      if (support.bearing == bearing) {
        BearingCurve softer = *support.curve;
        for (double &approach : softer.approach)
          approach *= 1 + share;
        for (double &tangent : softer.tangent)
          tangent /= 1 + share;
        support.curve = std::make_shared<const BearingCurve>(std::move(softer));
      }
  return stack;
}

Stack with_rigid_bearings(const StackInput &input, Stack stack)
{
  std::map<std::string, std::shared_ptr<const BearingCurve>> curves;
  for (const auto &[name, load] : loads_of_bearings(stack)) {
    BearingQuestion question = stack_bearing_question(input, name, load);
    question.bearing         = bearing::between_rigid_rings(question.bearing);
    std::vector<bearing::RingLoading> loadings;
    for (const double each : question.loads)
      loadings.push_back(bearing::drive_of(question, each));
    bearing::BearingAssembly assembly(bearing::rigid_model(question.bearing));
    curves[name] = curve_of(question, assembly.curve(loadings));
  }
  return with_curves(std::move(stack), curves);
}

StackNumbers bearing_numbers(const Stack &stack)
{
  StackNumbers numbers;
  if (!(stack.strip.force > 0))
    return numbers;
  const auto resultants = stack_resultants(stack, stack.strip.force);
  for (std::size_t r = 0; r < stack.rolls.size(); ++r)
    if (const StackRoll &roll = stack.rolls[r]; !bearing_of_roll(roll).empty())
      numbers.push_back({row::roll::bearing_stiffness.of(roll.name),
                         bearing_point(*roll.supports.front().curve, heavier_load(stack, r, resultants)).tangent,
                         "N/m",
                         "laminae between rigid rings, tangent under the load of the heavier bearing",
                         {}});
  return numbers;
}

void add_stack_bearings(RunContext &run, const StackInput &input, const Stack &solved,
                        const StackBearings &bearings)
{
  const auto resultants = stack_resultants(solved, solved.strip.force);
  for (std::size_t r = 0; r < solved.rolls.size(); ++r) {
    const StackRoll &roll   = solved.rolls[r];
    const std::string &name = bearing_of_roll(roll);
    if (name.empty())
      continue;
    const BearingStudy &study = bearings.at(name);
    const auto &loads         = study.question.loads;
    const double load         = heavier_load(solved, r, resultants);
    Parameter p               = tangent_of(study, keys_of_stack(run.the_case));
    if (std::abs(load / study.question.radial - 1) > 1e-9)
      p.checks.clear();  // they belong to the other load
    p.value = bearing_point(*roll.supports.front().curve, load).tangent;
    p.at    = {"{} on one bearing", {{load, "kN", ".5g"}}};
    run.results.add(row::roll::bearing_stiffness.of(roll.name), p);
    if (load < loads.front() || load > loads[study.curve.states.size() - 1])
      run.warn({WarningId::curve_left,
                "roll " + roll.name,
                fmt::format("the {:.4g} kN on its bearing {} are outside the {:.4g} kN .. {:.4g} kN for which it "
                            "was solved",
                            1e-3 * load, name, 1e-3 * loads.front(), 1e-3 * loads[study.curve.states.size() - 1]),
                "",
                "give strip.force in place of gap",
                {"roll." + roll.name},
                "strip.gap"});
  }
  for (const auto &[name, study] : bearings) {
    write_load_curve(run, study);
    note_bearing(run, "bearing." + name, study);
  }
  for (const StackRollInput &roll : input.rolls)
    if (!roll.bearing.empty() && roll.housing_stiffness.empty())
      run.assume(fmt::format("what carries bearing {} of roll {} is rigid, since housing_stiffness is not given",
                             roll.bearing, roll.name));
}
}  // namespace mill
