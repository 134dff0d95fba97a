#include "app/stack/stack_motion.h"
#include "app/run/curve_files.h"
#include "app/stack/stack_bite.h"
#include "app/stages/response/dynamics_stage.h"
#include "app/stages/stand/mode_results.h"
#include "app/stages/stand/model_files.h"
#include "core/model/case.h"
#include "core/numerics/mesh_pair.h"
#include "core/records/named_mode.h"
#include "core/records/rows_of_stack.h"
#include "core/records/rows_of_stand.h"
#include "core/records/stack_names.h"
#include "reduce/stack/stack_mode_names.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr int elements_in_motion   = 60;   // over the width
constexpr int shapes_drawn         = 8;    // modes
constexpr Eigen::Index small_model = 100;  // unknowns whose matrices are written unasked

reduce::StandWithModes named_stand(const MovingPass &pass, const reduce::MovingStack &moving, StandModel model,
                                   const double limit)
{
  reduce::StandWithModes s{std::move(model), {}};
  s.modes = reduce::stand_modes(s.model, limit);
  s.names = reduce::gap_mode_names(reduce::gap_motions(pass.stack, pass.state, moving, s.model, s.modes));
  for (reduce::ModeName &name : s.names)
    name.listed = name.gap_share >= reduce::least_share_listed;
  return s;
}

// Under the force of the pass: its load, the mean of its record, else that of [strip].
double force_of_pass(const Pass &pass, const ForceRecord &record, const Stack &stack)
{
  if (!std::isnan(pass.load))
    return pass.load;
  return record.force.size() > 0 ? record.force.mean() : stack.strip.force;
}

// (modes of the full model, modes of the lumped one): a lumped shape moves every roll without tilting or bending.
Eigen::MatrixXd likeness(const MovingPass &pass)
{
  const auto &full = pass.moving.moved, &lumped = pass.lumped.moved;
  const Eigen::VectorXd mass = pass.lumped.model.M.diagonal();
  Eigen::MatrixXd expanded = Eigen::MatrixXd::Zero(Eigen::Index(full.size()), pass.lumped_open.modes.shape.cols());
  for (std::size_t i = 0; i < full.size(); ++i)
    for (std::size_t k = 0; k < lumped.size(); ++k)
      if (full[i].motion == reduce::MovedRoll::Motion::translation && full[i].roll == lumped[k].roll &&
          full[i].axis == lumped[k].axis)
        expanded.row(Eigen::Index(i)) =
            std::sqrt(mass[Eigen::Index(k)]) * pass.lumped_open.modes.shape.row(Eigen::Index(k));
  return (pass.open.modes.shape.transpose() * pass.open.model.M * expanded).cwiseAbs2();
}

// Beams resolve both to 1e-4; how well the springs are known decides.
Parameter on_two_meshes(const RunContext &run, const double force, const double value, const double coarse)
{
  Parameter f;
  f.value          = value;
  f.unit           = "Hz";
  f.at             = {"{}", {{force, "kN", ".5g"}}};
  f.inputs         = keys_of_stack(run.the_case);
  f.error_estimate = not_given;
  f.error_lacks    = {"stiffness of the supports"};
  if (std::isfinite(coarse))
    f.checks.push_back({"half as many elements", coarse, ""});
  return f;
}

// stack.f1.. of the beams themselves, each with the mode of the lumped stack that it is.
void add_frequencies(RunContext &run, const MovingPass &fine, const MovingPass &coarse)
{
  const Eigen::VectorXd f         = fine.engine->frequencies(frequencies_listed),
                        on_coarse = coarse.engine->frequencies(frequencies_listed);
  const auto pairs =
      reduce::pair_modes(likeness(fine), fine.open.modes.frequency, fine.lumped_open.modes.frequency, 0.4, 3);
  for (Eigen::Index k = 0; k < f.size(); ++k) {
    Parameter p = on_two_meshes(run, fine.force, f[k], on_coarse[k]);
    p.method    = "beams with their masses about the solved state, rolling force imposed";
    for (const reduce::ModePair &pair : pairs)
      if (pair.other == int(k))
        p.checks.push_back({"one mass for each roll, springs of the contacts (51.23)",
                            fine.lumped_open.modes.frequency[pair.mode],
                            "its rolls neither tilt nor bend, and their contacts have one spring each"});
    run.results.add(row::stack::frequency.of(std::to_string(k + 1)), p);
  }
}

// mode.<key>.frequency and .gap_share of one state.
void add_named(RunContext &run, const MovingPass &pass, const reduce::StandWithModes &stand,
               const reduce::StandWithModes &coarse, const GapState state, const double limit)
{
  for (std::size_t k = 0; k < stand.names.size(); ++k) {
    const reduce::ModeName &name = stand.names[k];
    const auto mode              = Eigen::Index(k);
    if (name.key.empty() || !name.listed || stand.modes.frequency[mode] > limit)
      continue;
    // The same name, which another place in the list may have on the other mesh.
    const auto same        = std::find_if(coarse.names.begin(), coarse.names.end(),
                                          [&](const reduce::ModeName &other) { return other.key == name.key; });
    const bool both        = same != coarse.names.end();
    const double on_coarse = both ? coarse.modes.frequency[Eigen::Index(same - coarse.names.begin())] : not_given;
    Parameter f            = on_two_meshes(run, pass.force, stand.modes.frequency[mode], on_coarse);
    f.method               = mode_method({name.name, name.decided,
                                          fmt::format("rolls as beams about the solved state, {} (51.22)",
                                        state == GapState::rolling ? "strip as springs between the work rolls"
                                                                                 : "without the strip")});
    Parameter share        = on_two_meshes(run, pass.force, name.gap_share, both ? same->gap_share : not_given);
    share.unit             = "1";
    share.method           = name.name + ": share in the static compliance of the gap (22.23)";
    if (state == GapState::open)
      for (std::size_t i = 0; i < pass.lumped_open.names.size(); ++i)
        if (pass.lumped_open.names[i].key == name.key)
          f.checks.push_back({"one mass for each roll, springs of the contacts (51.23)",
                              pass.lumped_open.modes.frequency[Eigen::Index(i)],
                              "its rolls neither tilt nor bend, and their contacts have one spring each"});
    run.results.add(row::modes::frequency.of(word_of_state(state), name.key), f);
    run.results.add(row::modes::gap_share.of(word_of_state(state), name.key), share);
  }
}

// Axes of all rolls in the modes that open the gap most, roll by roll.
void write_shapes(RunContext &run, const reduce::StandWithModes &stand)
{
  std::vector<std::size_t> order(stand.names.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) {
    return stand.names[a].gap_share > stand.names[b].gap_share;
  });
  order.resize(std::min<std::size_t>(order.size(), shapes_drawn));
  std::sort(order.begin(), order.end());
  for (const std::size_t k : order) {
    const Eigen::VectorXd shape = stand.modes.shape.col(Eigen::Index(k));
    std::vector<double> roll, z, y;
    for (std::size_t r = 0; r < stand.model.lines.size(); ++r) {
      const Eigen::VectorXd moved = stand.model.lines[r].rows * shape;
      roll.insert(roll.end(), std::size_t(moved.size()), double(r + 1));
      z.insert(z.end(), stand.model.lines[r].z.begin(), stand.model.lines[r].z.end());
      y.insert(y.end(), moved.begin(), moved.end());
    }
    const auto column = [](const std::vector<double> &v) {
      return Eigen::Map<const Eigen::VectorXd>(v.data(), Eigen::Index(v.size())).eval();
    };
    const double largest = column(y).cwiseAbs().maxCoeff();
    Table table;
    table.add("roll", "", column(roll)).add("z", "m", column(z)).add("y", "", column(y) / largest);
    write_curve(run, curve::stack_mode, fmt::format("{}", k + 1), table);
  }
}
}  // namespace

MovingPass moving_pass(const StackInput &input, const Stack &stack, const Pass &pass, const int elements_per_width,
                       const int threads)
{
  MovingPass made;
  made.pass = pass;
  if (has_force(pass))
    made.record = force_of(pass);
  made.force             = force_of_pass(pass, made.record, stack);
  made.stack             = stack;
  made.stack.strip.force = made.force;
  made.stack             = with_slopes_of_bite(input, made.stack, pass);
  made.engine = std::make_shared<reduce::BeamStack>(made.stack, beam_settings(input, elements_per_width, threads));
  made.state  = made.engine->solve();
  made.moving = reduce::moving_stack(*made.engine);
  made.lumped = reduce::lumped_stack(*made.engine, made.state);
  const double limit = 2 * input.dynamics.frequency_limit;
  made.open          = named_stand(made, made.moving, made.moving.model, limit);
  if (made.moving.strip_stiffness > 0)
    made.rolling = named_stand(made, made.moving, reduce::with_strip(made.moving), limit);
  made.lumped_open = named_stand(made, made.lumped, made.lumped.model, INFINITY);
  return made;
}

std::vector<MovingPass> moving_passes(const StackInput &input, const Stack &stack, const int threads,
                                      const std::string &wanted)
{
  std::vector<MovingPass> passes;
  const auto add = [&](const Pass &pass) {
    passes.push_back(moving_pass(input, stack, pass, elements_in_motion, threads));
  };
  if (!wanted.empty())
    add(input.passes[place_of_pass(input.passes, wanted)]);
  else if (input.passes.empty())
    add(Pass{});
  for (std::size_t p = 0; wanted.empty() && p < input.passes.size(); ++p)
    add(input.passes[p]);
  return passes;
}

void add_stack_modes(RunContext &run, const StackInput &input, const MovingPass &fine, const MovingPass &coarse)
{
  const double limit = input.dynamics.frequency_limit;
  add_frequencies(run, fine, coarse);
  if (fine.rolling) {
    Parameter K4 = on_two_meshes(run, fine.force, fine.moving.strip_stiffness, coarse.moving.strip_stiffness);
    K4.unit      = "N/m";
    K4.method    = "slope of the strip in series with the flattening of both work rolls, even opening (51.22)";
    run.results.add(row::stack::strip_stiffness.of(), K4);
    add_named(run, fine, *fine.rolling, *coarse.rolling, GapState::rolling, limit);
    write_mode_table(run, *fine.rolling);
    write_shapes(run, *fine.rolling);
  } else
    run.assume(
        "the line load of the strip does not follow the gap (strip.law = \"uniform\" or modulus = 0): modes "
        "of the rolling state (mode.*) are not computed, those without the strip are open.mode.*");
  add_named(run, fine, fine.open, coarse.open, GapState::open, limit);
  write_mode_table(run, fine.open, GapState::open);
  if (!fine.rolling)
    write_shapes(run, fine.open);
  if (fine.open.model.M.rows() <= small_model || input.dynamics.model_files == ModelFileSet::all)
    write_model_matrices(run, input.dynamics, fine.driven(input.dynamics), 0);
  else
    run.progress.note(fmt::format("the matrices of {} unknowns are not written; dynamics.model_files = \"all\" "
                                  "writes them",
                                  fine.open.model.M.rows()));
}
}  // namespace mill
