#include "app/stages/contact/fourier_stage.h"
#include "app/run/kept_part.h"
#include "app/stages/contact/contact_stage.h"
#include "core/base/files.h"
#include "core/case/contact_inputs.h"
#include "core/model/four_high.h"
#include "core/records/contact_name.h"
#include "core/records/record_text.h"
#include "core/records/rows_of_contact.h"
#include "fem/members.h"
#include "fem/roll/contact_study.h"
#include "fem/roll/fourier_contact.h"
#include "meshes/bearing/meridian.h"
#include "meshes/common/mesher.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace fs = std::filesystem;

namespace mill {
namespace {
// Raised by hand when the Fourier solver changes what it computes.
constexpr const char *fourier_stage_version = "fourier 2";

fem::FourierRoll fourier_roll(RunContext &run, const std::string &name, const RollGeometry &g, const Material &m,
                              const fem::FourierOptions &options, const Eigen::VectorXd &edge,
                              const std::string &smaller)
{
  const std::string key  = hash_of(fourier_inputs(g, m, options, edge));
  const std::string file = run.cache + "/fourier-" + key + ".bin";
  const auto make        = [&] {
    const std::string mesh_file = run.out.staging() + "/fourier-" + key + ".msh";
    const MeshFile mesh = meshes::mesh_meridian(name, g, meshes::meridian_size(options.half_width), mesh_file);
    const fem::SectionBody body(mesh, m, 2, fem::Section::axisymmetric);
    fs::remove(mesh_file);
    return fem::fourier_roll(body, g, m, edge.size() > 0 ? edge : fem::stations_of(body), options, run.progress);
  };
  return kept_part<fem::FourierRoll>(run, "Fourier series, " + name, file, key, make, smaller);
}

// The approach as the first engine defines it: from the first touch, and under a force off the middle at the
// force.
ContactCurve counted_from_touch(const fem::FourierPair &pair, ContactCurve curve, const fem::FourierDrive &loading)
{
  if (!pair.whole)
    return curve;
  const double touch  = fem::touching_approach(pair.z, pair.drop, loading.tilt, loading.load_offset);
  const auto at_force = [&](const double load) {
    const auto point = fem::solve_load(pair, load, loading);
    return point.approach + loading.load_offset * point.tilt;
  };
  for (Eigen::Index i = 0; i < curve.load.size(); ++i) {
    const double F = curve.load[i];
    if (!std::isnan(loading.load_offset)) {
      constexpr double step = 1e-3;
      curve.approach[i]     = at_force(F);
      curve.tangent[i]      = 2 * step * F / (at_force(F * (1 + step)) - at_force(F * (1 - step)));
    }
    curve.approach[i] -= touch;
    curve.secant[i] = F / curve.approach[i];
  }
  return curve;
}
}  // namespace

std::string fourier_inputs(const RollGeometry &geometry, const Material &steel, const fem::FourierOptions &options,
                           const Eigen::VectorXd &edge)
{
  return record_text(fourier_stage_version, fem::library_version(), meshes::library_version(), geometry,
                     at_rest(steel), options, edge);
}

bool second_engine_knows(RunContext &run, const FourHigh &stand, const std::string &name)
{
  const auto &bending = stand.work_roll.bending_force;
  if (stand.work_roll.axial_shift == 0 && bending[0] == 0 && bending[1] == 0)
    return true;
  run.assume(
      fmt::format("contact {}: the Fourier solver does not know {}; the error estimates come from two meshes "
                  "of the first one only",
                  name, stand.work_roll.axial_shift != 0 ? "shifted rolls" : "roll bending forces"));
  return false;
}

FourierRolls fourier_rolls(RunContext &run, const FourHigh &stand, const ContactSettings &settings,
                           const double largest)
{
  const PlannedPair plan = planned_rolls(stand, settings, largest, first_reach);
  fem::FourierOptions options;
  // For the whole sweep, so that another working load finds the rolls in the cache: the contact at a quarter of
  // the largest load.  Below it the harmonics follow their asymptote.
  options.half_width        = 0.5 * reduce::line_contact(closed_form(stand), largest).half_width;
  options.both_sides        = plan.wanted.both_sides;
  const std::string smaller = "loads of contact.*.loads that end higher";  // a wider contact has a coarser section
  FourierRolls rolls;
  rolls.backup = fourier_roll(run, "backup roll", plan.backup.geometry, stand.steel, options, {}, smaller);
  rolls.work =
      fourier_roll(run, "work roll", plan.work.geometry, stand.steel, options, rolls.backup.edge, smaller);
  return rolls;
}

fem::SecondEngine solve_again(RunContext &run, const FourHigh &stand, const FourierRolls &rolls,
                              const std::string &name, const ContactSettings &settings,
                              const Eigen::VectorXd &loads, const double working_load)
{
  const bool whole           = is_one_sided(stand, settings);
  const auto &[backup, work] = rolls;
  StageTimer timer(run, "contact " + name + ", Fourier solver");
  const Eigen::VectorXd side = fem::station_centres(backup.edge);
  Eigen::VectorXd z          = side;
  if (whole) {
    z.resize(2 * side.size());
    z << -side.reverse(), side;
  }
  const Eigen::VectorXd drop = profile_drop(stand, settings, is_contact(name, ContactName::lower) ? -1 : 1, z);
  fem::FourierDrive loading;
  loading.tilt        = std::isnan(settings.tilt) ? 0 : settings.tilt;
  loading.load_offset = settings.load_offset;
  const auto mirrored = fem::fourier_pair(name, backup, {}, work, {}, drop);
  const auto in_stand = fem::fourier_pair(name, backup, {fem::RollSupport::necks, 0}, work,
                                          {fem::RollSupport::strip, stand.strip.width}, drop);
  fem::SecondEngine second;
  second.mirrored    = counted_from_touch(mirrored, fem::sweep(mirrored, loads, loading, run.progress), loading);
  second.in_stand    = counted_from_touch(in_stand, fem::sweep(in_stand, loads, loading, run.progress), loading);
  second.mirrored_at = fem::barrel_profile(mirrored, fem::solve_load(mirrored, working_load, loading));
  second.in_stand_at = fem::barrel_profile(in_stand, fem::solve_load(in_stand, working_load, loading));
  return second;
}

void add_line_load_spread(RunContext &run, const std::string &name, const double load, const double spread)
{
  Parameter p;
  p.value  = spread;
  p.unit   = "1";
  p.method = "largest difference of the line load between the two engines over the largest line load, held as in "
             "the stand, nine half widths at each end of the contact left out";
  p.at     = at_force(load);
  p.inputs = contact_keys(*run.keys, name, 0, ContactReading::curve);
  p.checks.push_back({"two engines that agree", 0, "meshes, elements and treatment of the contact differ"});
  run.results.add(row::contact::line_load_spread.of(name), p);
}
}  // namespace mill
