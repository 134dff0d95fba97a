#include "app/stages/stand/frame_stage.h"
#include "core/base/errors.h"
#include "core/case/stand_rows.h"
#include "core/records/key_list.h"
#include "core/records/rows_of_stand.h"
#include "fem/housing/housing.h"
#include "meshes/housing/housing.h"
#include "reduce/chain/chain_keys.h"
#include "reduce/chain/frame_closure.h"
#include "reduce/chain/housing_frame.h"
#include "reduce/chain/screwdown.h"
#include "reduce/chain/spring_chain.h"
#include <array>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace mill {
namespace {
const std::array<const char *, 4> part_names{"upper_post", "upper_beam", "lower_post", "lower_beam"};

Parameter computed(const double value, const char *unit, const std::string &method, const double error,
                   std::vector<std::string> keys)
{
  Parameter p;
  p.value          = value;
  p.unit           = unit;
  p.method         = method;
  p.error_estimate = error;
  p.inputs         = std::move(keys);
  return p;
}

void add_given(Parameter &p, const double given)
{
  if (given > 0)
    p.checks.push_back({"given in [frame]", given, "replaced by the drawing"});
}

// "piston_stiffness" -> "frame.piston_stiffness"
ResultName spring_of_frame(const std::string &row_key)
{
  return row::frame::stiffness.of(row_key.substr(0, row_key.rfind("_stiffness")));
}

std::array<double, 4> post_beam_stiffness(const Frame &f)
{
  return {f.upper_post_stiffness, f.upper_beam_stiffness, f.lower_post_stiffness, f.lower_beam_stiffness};
}

std::array<double, 4> post_beam_mass(const Frame &f)
{
  return {f.upper_post_mass, f.upper_beam_mass, f.lower_post_mass, f.lower_beam_mass};
}

double given_value(const FourHigh &stand, const char *name)
{
  const auto given = stand.given.find(name);
  return given == stand.given.end() ? not_given : given->second.parameter.value;
}

// Results of a drawn housing, once its masses are where the chain has them.
void add_housing(RunContext &run, const FourHigh &stand, const Frame &before, const fem::HousingStatics &statics)
{
  const auto beams   = reduce::housing_frame(stand.housing);
  const auto rule    = reduce::masses_by_rule(stand.housing);
  const auto given_K = post_beam_stiffness(before), given_M = post_beam_mass(before);
  const auto K = post_beam_stiffness(stand.frame), M = post_beam_mass(stand.frame);
  const std::string how = fmt::format("housing by finite elements, {} unknowns of a quarter", statics.n_unknowns);
  const KeyList springs = housing_keys(*run.keys, false, ChainReading::run),
                masses  = housing_keys(*run.keys, true, ChainReading::run);
  for (std::size_t i = 0; i < part_names.size(); ++i) {
    Parameter spring = computed(K[i], "N/m", how, statics.flexibility_error[i], springs);
    if (beams.flexibility[i] > 0)
      spring.checks.push_back(
          {"frame of Timoshenko beams (23.10)", 1 / beams.flexibility[i], "corners half rigid"});
    add_given(spring, given_K[i]);
    run.results.add(row::frame::stiffness.of(part_names[i]), spring);
    // Beam theory and the rules speak of the mass at screw or seat; the chain's point deflects more.
    const double moved = M[i] / statics.reduced_mass[i];
    Parameter mass =
        computed(M[i], "kg", how + ", kinetic energy of the static shape, at the chain's point (4.13a)",
                 statics.mass_error[i], masses);
    mass.checks.push_back({"frame of Timoshenko beams (23.10)", moved * beams.reduced_mass[i], ""});
    mass.checks.push_back({"a third of a post, 17/35 of a beam on two posts", moved * rule[i], ""});
    mass.checks.push_back(
        {"of it what moves up and down", moved * statics.vertical_mass[i], "without the posts' bow"});
    mass.checks.push_back({"mass of the part itself", statics.mass[i], "both housings, as drawn"});
    add_given(mass, given_M[i]);
    run.results.add(row::frame::mass.of(part_names[i]), mass);
  }
}

fem::HousingStatics resolve_housing(RunContext &run, FourHigh &stand)
{
  StageTimer timer(run, "housing");
  const MillHousing &h = stand.housing;
  const auto solve     = [&](const meshes::HousingMeshSize &size, const bool draw) {
    const std::string path = fmt::format("{}/housing-{}.msh", run.out.staging(), ::getpid());
    const MeshFile mesh    = meshes::mesh_housing(h, size, path);
    const fem::ElasticBody body(mesh, h.steel, 2);
    fem::HousingStatics statics = fem::housing_statics(h, body);
    if (draw)
      fem::write_housing_vtu(run.out.file("fields/housing.vtu"), body, statics, 1e6);
    std::remove(path.c_str());
    return statics;
  };
  meshes::HousingMeshSize fine_size, coarse_size;
  coarse_size.through         = fine_size.through / 2;
  const auto coarse           = solve(coarse_size, false);
  fem::HousingStatics statics = solve(fine_size, true);
  fem::estimate_error(statics, coarse, double(fine_size.through) / coarse_size.through);
  stand.frame = fem::frame_with_housing(stand.frame, statics);
  return statics;
}

void resolve_screwdown(RunContext &run, FourHigh &stand)
{
  const reduce::FrameWithScrewdown done = reduce::frame_with_screwdown(stand.frame, stand.screwdown, stand.steel);
  for (const reduce::Replacement &spring : done.replaced) {
    Parameter p = computed(spring.after, "N/m", spring.parts + " by formula", not_given,
                           frame_keys(*run.keys, {spring.member}, ChainReading::run));
    // The error of a formula is not known, but the designer of the part may state it.
    const std::string row_key = spring.key.substr(std::string("frame.").size());
    if (const auto tolerance = stand.frame.tolerance.find(row_key); tolerance != stand.frame.tolerance.end())
      p.error_estimate = tolerance->second;
    else
      p.error_lacks = {tolerance_key(spring.key)};
    add_given(p, spring.before);
    run.results.add(spring_of_frame(row_key), p);
  }
  stand.frame = done.frame;
}
}  // namespace

void resolve_frame(RunContext &run, FourHigh &stand)
{
  const Frame before = stand.frame;
  if (!stand.housing.present()) {
    resolve_screwdown(run, stand);
    return;
  }
  const fem::HousingStatics statics = resolve_housing(run, stand);
  resolve_screwdown(run, stand);
  stand.frame = reduce::with_masses_at_the_chain(stand.frame, given_value(stand, "K1"), given_value(stand, "K7"));
  // The chain is made of the whole of post and beam, whose error is not that of either share.
  for (std::size_t i = 0; i < part_names.size(); ++i) {
    const bool upper                                                 = i < 2;
    stand.frame.tolerance[std::string(part_names[i]) + "_stiffness"] = statics.error[upper ? 0 : 1];
    stand.frame.tolerance[std::string(part_names[i]) + "_mass"]      = statics.error[upper ? 2 : 3];
  }
  add_housing(run, stand, before, statics);
  if (stand.dynamics.frame == FrameForm::closed)
    run.assume(
        "a drawn housing is already closed: dynamics.frame = \"closed\" concerns the six masses and the beams");
}

void close_frame(RunContext &run, FourHigh &stand, const reduce::ChainInputs &inputs)
{
  if (!reduce::is_closed(stand.frame))
    return;
  const Frame rules = stand.frame;
  stand.frame       = reduce::frame_on_modulus(stand, inputs);
  for (const Field<Frame> &row : frame_rows()) {
    const auto member = std::get<double Frame::*>(row.member);
    if (!rules.closing.count(row.key))
      continue;
    const std::string key = std::string("frame.") + row.key;
    Parameter p           = computed(
                  stand.frame.*member, "N/m",
                  fmt::format("share of what frame.modulus = {:.4g} MN/mm leaves for the frame at the load of {} (30.11)",
                              rules.modulus / 1e9, stand.passes.front().name),
                  not_given, joined(KeyList{key}, closure_keys(*run.keys)));
    p.at = inputs.at;
    if (const auto tolerance = rules.tolerance.find(row.key); tolerance != rules.tolerance.end())
      p.error_estimate = tolerance->second;
    p.checks.push_back({"by the rules alone (34.9), (34.10)", rules.*member, ""});
    run.results.add(spring_of_frame(row.key), p);
  }
}
}  // namespace mill
