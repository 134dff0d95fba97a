#include "app/cluster/cluster_bite.h"
#include "app/cluster/cluster_schedule.h"
#include "app/cluster/cluster_stage.h"
#include "app/stages/bite/bite_stage.h"
#include "app/stages/bite/bite_study.h"
#include "core/model/case.h"
#include "reduce/bite/schedule/schedule.h"
#include "reduce/bite/slab/slab_bite.h"
#include "reduce/bite/slab/slab_checks.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
void check_free_motions(const ClusterStand &stand, const cluster::Stack &stack, std::vector<Problem> &problems)
{
  for (const cluster::FreeMotion &motion : cluster::free_motions(stack)) {
    const std::string &name = stack.rolls[std::size_t(motion.roll)].name;
    Place place;
    for (const ClusterRoll &r : stand.rolls)
      if (r.name == name)
        place = r.place;
    problems.push_back(
        {place,
         fmt::format("nothing holds roll {} along {}; add a [[support]] of it, for example type = \"guide\", or a "
                     "[[contact]] that acts in this direction",
                     name, motion.along_y ? "y" : "x"),
         {}});
  }
}

void check_shapes(const ClusterStand &stand, const cluster::Stack &stack, std::vector<Problem> &problems)
{
  for (const ClusterMode &mode : stand.modes)
    try {
      cluster::parsed_shape(stack, mode.shape);
    } catch (const InputError &e) {
      problems.push_back(
          {mode.place, fmt::format("the shape of mode \"{}\": {}", mode.name, e.problems.front().message), {}});
    }
}

// Friction outside the range of its law, forces that no flattened roll carries.
void check_forces(const ClusterStand &stand, std::vector<Problem> &problems)
{
  for (const ClusterPass &pass : stand.schedule) {
    const auto refuse = [&](const std::string &why) {
      problems.push_back({pass.place, "pass \"" + pass.name + "\": " + why, {}});
    };
    try {
      if (const auto bite = bite_of_pass(stand, pass))
        bite::check_friction(*bite);
      cluster_force(stand, pass);
    } catch (const InputError &e) {
      refuse(e.problems.front().message);
    } catch (const SolverError &e) {
      refuse(e.report.what + ": " + e.report.where + "; " + e.report.remedy);
    }
  }
}
}  // namespace

void check_cluster(const Case &the_case)
{
  const ClusterStand &stand  = *std::get<ClusterCase>(the_case.spec).stand;
  const cluster::Stack stack = cluster::stack_of(stand, stand.schedule.front(), 1e6);
  std::vector<Problem> problems;
  check_free_motions(stand, stack, problems);
  check_shapes(stand, stack, problems);
  check_forces(stand, problems);
  if (!problems.empty())
    throw InputError(std::move(problems));
  check_strip_contact(the_case, stand);
}

ClusterForce cluster_force(const ClusterStand &stand, const ClusterPass &pass)
{
  if (!std::isnan(pass.load))
    return {pass.load, true, "", not_given, ""};
  const auto drawn = bite_of_pass(stand, pass);
  if (!drawn)
    throw InputError("the rolling force is not given; give load, or strip.width, thicknesses, strip.friction and "
                     "strip.flow_stress, "
                     "from which it is computed");
  // One mean stress, as in the fits: a law that begins at zero has no stress at the entry of the first
  // pass.
  const bite::RollBite bite = bite::with_exit_stress(*drawn);
  bite::SlabModel model     = fem::slab_model(stand.bite);
  model.curve_points        = 0;
  if (model.arc == bite::Arc::elastic)
    model.arc = bite::Arc::hitchcock;
  ClusterForce force{bite::solve_slab(bite, model).force, false,
                     bite::model_name(model) + " with the flow stress at the exit (39.4)", not_given, ""};
  const bite::SlabModel closed{slides(bite.strip.friction) ? bite::Theory::bland_ford : bite::Theory::hu_ehmann,
                               model.arc, 0};
  if (closed.theory != model.theory)
    try {
      force.closed        = bite::solve_slab(bite, closed).force;
      force.closed_method = bite::model_name(closed);
    } catch (const SolverError &) {  // no root by that theory: the force has no comparison
    } catch (const InputError &) {
    }
  return force;
}
}  // namespace mill
