#include "app/pipeline.h"
#include "app/case_kinds.h"
#include "app/stages/bearing_stage.h"
#include "app/stages/bite_stage.h"
#include "app/stages/chatter_stage.h"
#include "app/stages/contact_stage.h"
#include "app/stages/curve_files.h"
#include "app/stages/dynamics_stage.h"
#include "app/stages/frame_stage.h"
#include "app/stages/model_stage.h"
#include "app/stages/result_inputs.h"
#include "core/records/csv.h"
#include "core/records/lumped_model.h"
#include "core/records/provenance.h"
#include "reduce/stand/lumped_stand.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
void add_model(RunContext &run, const LumpedModel &model, const std::string &prefix)
{
  reduce::each_number(
      [&](const std::string &name, const Parameter &number) { run.results.add(prefix + name, number); }, model);
}

// Published values of the case beside the computed ones, under the plain name and beside tangent or plastic slope.
void set_beside(RunContext &run, const GivenValues &published)
{
  for (auto &[name, parameter] : run.results.values)
    for (const auto &[key, value] : published)
      if (name == key || name == key + ".tangent" || name == key + ".combined")
        parameter.checks.push_back(check(CheckId::published, value.parameter.value, value.parameter.at));
}

void write_shapes(RunContext &run, const reduce::LumpedStand &s)
{
  Table work, backup;
  work.add("x", "m", s.f1_upper.x).add("f1_upper", "m/N", s.f1_upper.value);
  work.add("f1_lower", "m/N", s.f1_lower.value);
  backup.add("x", "m", s.f2_upper.x).add("f2_upper", "m/N", s.f2_upper.value);
  backup.add("f2_lower", "m/N", s.f2_lower.value);
  write_curve(run, curve::shape_work_roll, "", work);
  write_curve(run, curve::shape_backup_roll, "", backup);
}

// Mean of the record, or the load that stands for it.
double working_load(const Pass &pass, const ForceRecord &force)
{
  return std::isnan(pass.load) ? force.force.mean() : pass.load;
}

// K4 over reduction, tension and friction says nothing of masses and modes.
bool draws_bite_curves(const Goal goal)
{
  return goal == Goal::stiffness || goal == Goal::simulate;
}

// What a pass drives: the six masses, or the model that the case asks for.
PassModel model_of_pass(const FourHigh &stand, const reduce::LumpedStand &chain, const StandModels &models)
{
  if (const auto *detailed = driven(models, stand.dynamics))
    return pass_model(*detailed, chain.model, stand.dynamics);
  PassModel six = pass_model(chain.model, stand.dynamics);
  six.missing   = models.verdict.missing;
  return six;
}

}  // namespace

void run_four_high(RunContext &run, FourHigh stand, const Goal goal, const std::string &force_file)
{
  if (goal == Goal::chatter)
    stand.dynamics.force_meaning = "measured";  // the stand without the strip, which the bite then adds
  std::vector<ForceRecord> forces(stand.passes.size());
  std::vector<double> loads;
  for (std::size_t p = 0; p < stand.passes.size(); ++p) {
    if (!force_file.empty())
      stand.passes[p].force_file = force_file;
    if (has_force(stand.passes[p]))
      forces[p] = force_of(stand.passes[p]);
    loads.push_back(working_load(stand.passes[p], forces[p]));
    if (forces[p].force.size() > 0 && std::abs(loads[p] / forces[p].force.mean() - 1) > 0.05)
      run.warn(
          fmt::format("{}: pass.load is {}, the mean of its force record {}; stiffnesses belong to the first, "
                      "accelerations to the second",
                      stand.passes[p].name, in_kN(loads[p]), in_kN(forces[p].force.mean())));
  }
  set_given_inputs(stand.given);
  resolve_frame(run, stand);
  ComponentSets components;  // before the contacts: what the meshes cannot show is said at once
  if (goal >= Goal::masses || stand.backup_roll.bending_model == "solid")
    components = stand_components(run, stand, goal >= Goal::masses);
  const auto contacts     = solve_contacts(run, stand, loads);
  const auto all_bearings = solve_bearings(run, stand, loads);
  for (std::size_t p = 0; p < stand.passes.size(); ++p) {
    const Pass &pass     = stand.passes[p];
    const bool first     = p == 0;
    const auto &bearings = all_bearings[p];
    const Parameter K4   = solve_bite_stiffness(run, stand, pass, loads[p], first, draws_bite_curves(goal));
    reduce::ChainInputs in;
    in.K3         = contacts.at("upper").tangent[p];
    in.K5         = contacts.at("lower").tangent[p];
    in.K4         = K4;
    in.K_Zy_upper = bearings.K_Zy_upper;
    in.K_Zy_lower = bearings.K_Zy_lower;
    in.Kzc        = bearings.Kzc;
    in.Kzc_across = bearings.Kzc_across;
    in.solid      = solid_rolls(components);
    in.at         = in_kN(loads[p]);
    set_inputs(in, stand, p);
    auto chain = reduce::lumped_stand(stand, in);
    StandModels models;
    reduce::FeMasses fe_masses{};
    if (goal >= Goal::masses) {
      models    = stand_models(stand, chain, components);
      fe_masses = add_fe_masses(chain.model, stand, models);
    }
    add_model(run, chain.model, first ? "" : pass.name + ".");
    if (first) {
      run.results.add("K_ZW", chain.K_ZW);
      run.results.add("K_Zy", chain.K_Zy_upper);
      run.results.add("K_Zy_lower", chain.K_Zy_lower);
      write_shapes(run, chain);
      run.out.write("lumped_model.toml", lumped_model_toml(chain.model, run.the_case, run.out.path()));
    }
    if (goal >= Goal::modes && first)
      add_modes(run, chain.model, stand.dynamics, stand.frame.chock_to_housing_stiffness,
                {2 * stand.work_roll.chock_mass_upper, 2 * stand.work_roll.chock_mass_lower});
    if (goal >= Goal::masses && first) {
      compare_models(run, stand, chain, models, components, fe_masses);
      add_housing_frequencies(run, stand, components);
      add_model_checks(run, models);
    }
    if (goal == Goal::chatter)
      solve_stand_chatter(run, stand, pass, chain, models);
    if (goal >= Goal::simulate) {
      if (has_force(pass))
        simulate_pass(run, model_of_pass(stand, chain, models), stand.dynamics, pass, forces[p]);
      else
        run.warn(pass.name + " has a load but no force record: nothing was simulated for it");
    }
    run.progress.at("passes", double(p + 1) / double(stand.passes.size()));
  }
  set_beside(run, stand.published);
  if (stand.passes.size() > 1)
    run.assume("lumped_model.toml holds the model at the load of " + stand.passes[0].name +
               "; here every pass has its own");
  run.assume("modal damping of " + fmt::format("{:g}", 100 * stand.dynamics.modal_damping) +
             " % in every mode; acceleration levels of a given force range follow (damping x "
             "bandwidth)^(-1/2), so that only "
             "this product can be told from measured levels");
}

void run_lumped(RunContext &run, Lumped lumped, const Goal goal, const std::string &force_file)
{
  LumpedModel model = lumped_model_of(run.the_case);
  set_given_inputs(model);
  add_model(run, model, "");
  run.out.write("lumped_model.toml", lumped_model_toml(model, run.the_case, run.out.path()));
  if (goal >= Goal::modes)
    add_modes(run, model, lumped.dynamics, not_given, {0, 0});
  if (goal < Goal::simulate)
    return;
  for (std::size_t p = 0; p < lumped.passes.size(); ++p) {
    Pass &pass = lumped.passes[p];
    if (!force_file.empty())
      pass.force_file = force_file;
    if (has_force(pass))
      simulate_pass(run, pass_model(model, lumped.dynamics), lumped.dynamics, pass, force_of(pass));
    run.progress.at("passes", double(p + 1) / double(lumped.passes.size()));
  }
}

void run_stages(RunContext &run, const Goal goal, const std::string &force_file)
{
  run_kind(run.the_case).run(run, goal, force_file);
  set_inputs(run.results, run.the_case);
}
}  // namespace mill
