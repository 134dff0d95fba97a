#include "app/stages/bite/strip_flow_stage.h"
#include "app/run/kept_part.h"
#include "core/base/errors.h"
#include "core/process/parallel.h"
#include "core/records/record_text.h"
#include "fem/body/elastic_body.h"
#include "fem/strip/elastic_plastic/strip_elastic.h"
#include "meshes/strip/strip_flow.h"
#include "reduce/bite/members.h"
#include <algorithm>
#include <fmt/format.h>

namespace mill {
namespace {
// Raised by hand when the finite-element bite changes what it computes.
constexpr const char *flow_version = "strip flow 8";

// Unknowns times factorisations of both meshes of a pass: twice what the usual mesh takes, some 8 and 14 s on one
// core.  A finer mesh may take more.
double allowed_work(const BiteSetup &setup)
{
  const double elements = double(setup.elements_along) * setup.elements_through;
  return setup.strip == BiteStrip::elastic_plastic ? 1.3e6 * std::max(1., elements / (36 * 8))
                                                   : 6e5 * std::max(1., elements / (48 * 12));
}

std::string key_of(const FlowQuestion &q, const bite::ArcFlexibility *flexibility)
{
  return hash_of(flow_inputs(q, flexibility));
}

std::string timer_name(const FlowQuestion &q)
{
  return "bite, finite elements, " + q.pass;
}

double slope_of(const fem::StripFlow &flow)
{
  return -bite::by(flow.state.force_by, bite::Input::exit_thickness);
}

StripLines lines_of(const FlowQuestion &q, const int along, const int through)
{
  return meshes::strip_lines(meshes::strip_block(q.bite.strip, q.bite.roll_radius, along, through));
}

fem::StripFlowModel rigid_model(const FlowQuestion &q)
{
  fem::StripFlowModel model;
  model.arc = fem::slab_model(q.setup).arc;
  // A rigid-plastic strip ends with a step of pressure, under which a free arc has no limit (theory.md 17).
  if (model.arc == bite::Arc::elastic)
    model.arc = bite::Arc::hitchcock;
  return model;
}

// Rigid-plastic strip on a mesh of so many elements.
fem::StripFlow rigid_flow(const FlowQuestion &q, const int along, const int through, const fem::StripFlow *start,
                          const double work)
{
  fem::StripFlowModel model = rigid_model(q);
  model.work_limit          = work;
  return fem::solve_strip_flow(lines_of(q, along, through), q.bite, model, nullptr, start);
}

fem::StripElastic elastic_flow(const FlowQuestion &q, const int along, const int through,
                               const bite::ArcFlexibility *flexibility, const double work)
{
  fem::StripElasticModel model;
  model.arc              = q.setup.arc == BiteArc::rigid ? bite::Arc::rigid : bite::Arc::elastic;
  model.elements_along   = along;
  model.elements_through = through;
  model.work_limit       = work;
  try {
    return fem::solve_elastic_strip(q.bite, model, flexibility);
  } catch (const InputError &) {
    if (!flexibility)
      throw;
    // The contact is longer than the section of the roll was made for.  On a half plane, which has no end, only
    // what is wrong with the pass itself is thrown again.
    return fem::solve_elastic_strip(q.bite, model);
  }
}

int half(const int elements)
{
  return (elements + 1) / 2;
}

int multiple_of_four(const int elements)
{
  return 4 * ((elements + 3) / 4);
}

// Elements of a bite on its two meshes: half as many on the coarser one, as far as the mesh can have them.
struct FlowMeshes {
  int along, through, coarse_along, coarse_through;
  double coarsening() const
  {
    return std::min(double(along) / coarse_along, double(through) / coarse_through);
  }
};

FlowMeshes rigid_meshes(const BiteSetup &setup)
{
  const int along = multiple_of_four(setup.elements_along);
  return {along, setup.elements_through, multiple_of_four(along / 2), half(setup.elements_through)};
}

// Ten times dearer than the rigid-plastic strip, and made for thin strip: fewer elements, half the rows.
FlowMeshes elastic_meshes(const BiteSetup &setup)
{
  const int along   = std::max(16, 2 * setup.elements_along / 3),
            through = std::max(3, half(setup.elements_through));
  return {along, through, std::max(10, half(along)), half(through)};
}

FlowAnswer rigid_answer(RunContext &run, const FlowQuestion &q)
{
  FlowAnswer answer;
  const FlowMeshes mesh = rigid_meshes(q.setup);
  const double work     = allowed_work(q.setup);
  const auto coarse     = rigid_flow(q, mesh.coarse_along, mesh.coarse_through, nullptr, work);
  run.progress.at(timer_name(q), 0.3);
  answer.fine          = rigid_flow(q, mesh.along, mesh.through, &coarse, work - coarse.work);
  answer.coarsening    = mesh.coarsening();
  answer.coarse_force  = coarse.state.force;
  answer.coarse_torque = coarse.state.torque;
  answer.coarse_slope  = slope_of(coarse);
  answer.coarse_slip   = coarse.state.forward_slip;
  return answer;
}

FlowAnswer elastic_answer(RunContext &run, const FlowQuestion &q, const bite::ArcFlexibility *flexibility)
{
  FlowAnswer answer;
  const FlowMeshes mesh = elastic_meshes(q.setup);
  const double work     = allowed_work(q.setup);
  const auto coarse     = elastic_flow(q, mesh.coarse_along, mesh.coarse_through, flexibility, work);
  run.progress.at(timer_name(q), 0.3);
  const auto fine           = elastic_flow(q, mesh.along, mesh.through, flexibility, work - coarse.flow.work);
  answer.fine               = fine.flow;
  answer.coarsening         = mesh.coarsening();
  answer.coarse_force       = coarse.flow.state.force;
  answer.coarse_torque      = coarse.flow.state.torque;
  answer.coarse_slope       = slope_of(coarse.flow);
  answer.coarse_slip        = coarse.flow.state.forward_slip;
  answer.elastic            = true;
  answer.smallest_thickness = fine.smallest_thickness;
  answer.elastic_entry      = fine.elastic_entry;
  answer.elastic_exit       = fine.elastic_exit;
  answer.elastic_power      = fine.elastic_power;
  answer.outlet_height      = fine.outlet_height;
  answer.outlet_stress      = fine.outlet_stress;
  return answer;
}
}  // namespace

std::string flow_inputs(const FlowQuestion &q, const bite::ArcFlexibility *flexibility)
{
  return record_text(flow_version, fem::library_version(), q.bite, flow_settings(q.setup),
                     flexibility ? *flexibility : bite::ArcFlexibility());
}

FlowAnswer solve_flow(RunContext &run, const FlowQuestion &q, const bite::ArcFlexibility *flexibility)
{
  StageTimer timer(run, "bite, finite elements, " + q.pass);
  const std::string key  = key_of(q, flexibility);
  const std::string file = run.cache + "/bite-" + key + ".bin";
  if (auto answer = taken_from_cache<FlowAnswer>(run, file, key)) {
    timer.cached = true;
    run.progress.note("finite-element bite taken from " + file);
    return std::move(*answer);
  }
  run.progress.at(timer_name(q), 0);
  FlowAnswer answer =
      q.setup.strip == BiteStrip::elastic_plastic ? elastic_answer(run, q, flexibility) : rigid_answer(run, q);
  for (const auto &level : answer.fine.history)
    run.progress.note(
        fmt::format("bite {}: {}, {} unknowns, g0 {:.3g}, d0 {:.3g}, {} steps, residual {:.2g}, force "
                    "{:.6g} kN",
                    q.pass, level.stage, level.n_unknowns, level.cutoff_strain_rate, level.cutoff_slip,
                    level.iterations, level.residual, level.force / 1e3));
  keep_in_cache(run, "the finite-element bite", file, key, answer);
  return answer;
}

namespace {
struct PointTask {
  const FlowQuestion *question;
  std::string key, file;
  std::optional<FlowPoint> point;
  std::string refused;
};

void solve_point(PointTask &task)
{
  try {
    const FlowQuestion &q = *task.question;
    const auto flow = rigid_flow(q, multiple_of_four(q.setup.elements_along), q.setup.elements_through, nullptr,
                                 allowed_work(q.setup));
    task.point      = FlowPoint{flow.state.force, slope_of(flow)};
  } catch (const InputError &e) {
    task.refused = e.problems.front().message;
  } catch (const SolverError &e) {
    task.refused = e.what();
  }
}
}  // namespace

std::vector<std::optional<FlowPoint>> solve_flow_points(RunContext &run,
                                                        const std::vector<FlowQuestion> &questions)
{
  std::vector<std::optional<FlowPoint>> points(questions.size());
  std::vector<PointTask> tasks;
  std::vector<std::size_t> place;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const FlowQuestion &q  = questions[i];
    const std::string key  = key_of(q, nullptr);
    const std::string file = run.cache + "/bite-point-" + key + ".bin";
    points[i]              = taken_from_cache<FlowPoint>(run, file, key);
    if (points[i])
      continue;
    tasks.push_back({&q, key, file, std::nullopt, ""});
    place.push_back(i);
  }
  share_tasks(long(tasks.size()), run.threads, [&](const long i) { solve_point(tasks[std::size_t(i)]); });
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (tasks[i].point)
      keep_in_cache(run, "a point of the bite's curves", tasks[i].file, tasks[i].key, *tasks[i].point);
    else
      run.progress.note("bite " + tasks[i].question->pass + ": " + tasks[i].refused);
    points[place[i]] = tasks[i].point;
  }
  return points;
}
}  // namespace mill
