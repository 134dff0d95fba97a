#include "app/stages/contact/contact_model.h"
#include "app/stages/contact/contact_stage.h"
#include "core/model/four_high.h"
#include "core/records/contact_name.h"
#include "meshes/roll/contact_mesh_size.h"
#include "reduce/chain/roll_profile.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
// What both rolls lack in radius at z of the stand, and what crossed axes add.  The lower work roll is the upper
// one turned end for end and shifted the other way.
double drop_at(const FourHigh &stand, const ContactSettings &settings, const double side, const double z)
{
  const double between = 0.5 * (stand.work_roll.barrel_diameter + stand.backup_roll.barrel_diameter);
  return reduce::radius_drop(stand.backup_roll, z) +
         reduce::radius_drop(stand.work_roll, side * z - stand.work_roll.axial_shift) +
         reduce::crossing_gap(between, settings.cross_angle, settings.axis_offset, z);
}

// Part of the stand in which the barrels face each other, m; the mirror image for the lower rolls.
std::pair<double, double> facing_part(const FourHigh &stand)
{
  const double shift = stand.work_roll.axial_shift, L_work = 0.5 * stand.work_roll.barrel_length,
               L_backup = 0.5 * stand.backup_roll.barrel_length;
  return {std::max(-L_backup, shift - L_work), std::min(L_backup, shift + L_work)};
}

bool reaches_patch_edge(const fem::ContactPair &pair, const double load)
{
  const auto point = fem::solve_load(pair, load);
  for (int k = 0; k < pair.grid.n_z; ++k)
    if (point.state.active[std::size_t(k) * pair.grid.n_x + pair.grid.n_x - 1])
      return true;
  return false;
}

void make_pairs(ContactModel &m, const std::string &name, const FourHigh &stand, const ContactSettings &settings)
{
  const double side = is_contact(name, ContactName::lower) ? -1 : 1, shift = side * stand.work_roll.axial_shift;
  const auto pair_of = [&](const fem::CondensedRoll &backup, const fem::HeldRoll &a,
                           const fem::CondensedRoll &work, const fem::HeldRoll &b) {
    auto pair = shift == 0
                    ? fem::make_pair(name, backup, a, work, b, profile_drop(stand, settings, side, a.grid.z))
                    : fem::make_pair(
                          name, backup, a, work, b,
                          [&](const double z) { return drop_at(stand, settings, side, z); }, shift);
    if (!std::isnan(settings.tilt))
      pair.tilt = settings.tilt;
    pair.load_offset = settings.load_offset;
    return pair;
  };
  const auto mirrored = [&](const fem::CondensedRoll &backup, const fem::CondensedRoll &work,
                            const fem::Extent extent) {
    auto pair      = pair_of(backup, fem::held_by_mirror(backup, extent), work, fem::held_by_mirror(work, extent));
    pair.reference = "axis to axis, mean over the contact length, each roll squeezed between two opposite contact "
                     "lines (Johnson's datum)";
    return pair;
  };
  const auto in_stand = [&](const fem::CondensedRoll &backup, const fem::CondensedRoll &work) {
    const auto &bending = stand.work_roll.bending_force;
    const bool bent     = bending[0] != 0 || bending[1] != 0;
    const auto on_strip = fem::held_by_strip(work, stand.strip.width, m.extent, -shift);
    auto pair           = pair_of(backup, fem::held_by_necks(backup, m.extent), work, on_strip);
    if (bent)
      fem::bend(pair, on_strip, bending[0], bending[1]);
    pair.reference =
        "axis to axis, mean over the contact length, backup roll on its bearings, work roll on the strip";
    if (bent)
      pair.reference += ", from the first touch of the bent rolls";
    return pair;
  };
  m.mirrored        = mirrored(*m.backup.fine, *m.work.fine, m.extent);
  m.coarse          = mirrored(*m.backup.coarse, *m.work.coarse, m.extent);
  m.whole           = mirrored(*m.backup.fine, *m.work.fine, fem::Extent::whole);
  m.whole_coarse    = mirrored(*m.backup.coarse, *m.work.coarse, fem::Extent::whole);
  m.in_stand        = in_stand(*m.backup.fine, *m.work.fine);
  m.in_stand_coarse = in_stand(*m.backup.coarse, *m.work.coarse);
  for (fem::ContactPair *pair : all_pairs(m))
    pair->solved = std::make_shared<fem::SolvedLoads>();
}
}  // namespace

reduce::CylinderPair closed_form(const FourHigh &stand)
{
  const auto [low, high] = facing_part(stand);
  return {stand.work_roll.barrel_diameter, stand.backup_roll.barrel_diameter, high - low, stand.steel};
}

std::vector<fem::ContactPair *> all_pairs(ContactModel &m)
{
  return {&m.mirrored, &m.in_stand, &m.coarse, &m.in_stand_coarse, &m.whole, &m.whole_coarse};
}

std::vector<const fem::ContactPair *> all_pairs(const ContactModel &m)
{
  return {&m.mirrored, &m.in_stand, &m.coarse, &m.in_stand_coarse, &m.whole, &m.whole_coarse};
}

const ContactModel &complete(const ContactModel &m)
{
  return m.completed ? m.completed() : m;
}

Eigen::VectorXd profile_drop(const FourHigh &stand, const ContactSettings &settings, const double side,
                             const Eigen::VectorXd &z)
{
  return z.unaryExpr([&](const double position) { return drop_at(stand, settings, side, position); });
}

Eigen::VectorXd even_drop(const FourHigh &stand, const ContactSettings &settings, const Eigen::VectorXd &z)
{
  return 0.5 * (profile_drop(stand, settings, 1, z) + profile_drop(stand, settings, 1, -z));
}

bool is_one_sided(const FourHigh &stand, const ContactSettings &settings)
{
  const auto &bending = stand.work_roll.bending_force;
  return stand.work_roll.axial_shift != 0 || reduce::is_one_sided(stand.work_roll) ||
         reduce::is_one_sided(stand.backup_roll) || (!std::isnan(settings.tilt) && settings.tilt != 0) ||
         (!std::isnan(settings.load_offset) && settings.load_offset != 0) || bending[0] != bending[1] ||
         (settings.cross_angle != 0 && settings.axis_offset != 0);
}

PlannedPair planned_rolls(const FourHigh &stand, const ContactSettings &settings, const double largest_load,
                          const double reach)
{
  const double b         = reduce::line_contact(closed_form(stand), largest_load).half_width;
  const auto [low, high] = facing_part(stand);
  const double shift     = stand.work_roll.axial_shift;
  const auto size        = meshes::roll_contact_size(b, settings.elements_per_half_width, reach);
  const auto planned     = [&](const Roll &roll, const double from, const double to) {
    PlannedRoll plan{roll_geometry(roll, std::max(std::abs(from), std::abs(to))), size};
    plan.size.break_at = std::abs(from + to) > 1e-9 ? std::min(std::abs(from), std::abs(to)) : 0;
    return plan;
  };
  PlannedPair pair{planned(stand.backup_roll, low, high), planned(stand.work_roll, low - shift, high - shift), {}};
  pair.wanted.both_sides = is_one_sided(stand, settings);
  pair.wanted.tractions  = !std::isnan(settings.friction);
  return pair;
}

ContactModel contact_model(RunContext &run, const FourHigh &stand, const std::string &name,
                           const ContactSettings &settings, const double largest_load)
{
  ContactModel m;
  m.extent       = is_one_sided(stand, settings) ? fem::Extent::whole : fem::Extent::quarter;
  m.closed_form  = closed_form(stand);
  const double b = reduce::line_contact(m.closed_form, largest_load).half_width;
  // Crown, bending and a narrow strip gather the load, so the contact may be wider than that of a uniform load.
  for (double reach = first_reach; reach < 12; reach *= 1.5) {
    auto plan           = planned_rolls(stand, settings, largest_load, reach);
    plan.wanted.smaller = "a smaller contact." + name + ".elements_per_half_width";
    const auto into     = [&](CondensedPair &pair, const char *roll, const PlannedRoll &planned) {
      return [&, roll](RunContext &part_run) {
        pair = condensed_pair(part_run, roll, planned.geometry, planned.size, stand.steel, plan.wanted);
      };
    };
    run_side_by_side(run, {into(m.backup, "backup roll", plan.backup), into(m.work, "work roll", plan.work)});
    make_pairs(m, name, stand, settings);
    if (!reaches_patch_edge(m.mirrored, largest_load) && !reaches_patch_edge(m.in_stand, largest_load))
      return m;
    run.progress.note("contact " + name + ": the contact reaches the edge of its patch, meshing a wider one");
  }
  throw SolverError({"contact " + name + ": the contact is wider than any patch tried",
                     fmt::format("12 times the Hertz half width of {:.3f} mm at {}", 1e3 * b, in_kN(largest_load)),
                     "a crown that leaves only a short part of the barrel in contact",
                     "check work_roll.crown and backup_roll.crown, or lower contact." + name + ".loads", ""});
}
}  // namespace mill
