#include "app/contact_model.h"
#include "app/contact_stage.h"
#include "meshes/contact_mesh_size.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
RollGeometry geometry_of(const Roll &roll, const double facing)
{
  RollGeometry g;
  g.radius              = 0.5 * roll.barrel_diameter;
  g.half_length         = 0.5 * roll.barrel_length;
  g.neck_radius         = 0.5 * roll.neck_diameter;
  g.neck_length         = roll.neck_length;
  g.seat_centre         = 0.5 * roll.bearing_span;
  g.contact_half_length = 0.5 * facing;
  return g;
}

double table_at(const std::vector<std::array<double, 2>> &table, const double z)
{
  if (z <= table.front()[0])
    return table.front()[1];
  for (std::size_t i = 1; i < table.size(); ++i)
    if (z <= table[i][0]) {
      const double t = (z - table[i - 1][0]) / (table[i][0] - table[i - 1][0]);
      return table[i - 1][1] + t * (table[i][1] - table[i - 1][1]);
    }
  return table.back()[1];
}

// How much the radius is smaller than at mid-length; of a table the mean of both halves of the barrel.
double radius_drop(const Roll &roll, const double z)
{
  if (roll.crown_table.empty())
    return 0.5 * roll.crown * std::pow(2 * z / roll.barrel_length, 2);
  const auto diameter = [&](const double s) {
    return 0.5 * (table_at(roll.crown_table, s) + table_at(roll.crown_table, -s));
  };
  return 0.5 * (diameter(0) - diameter(z));
}

Eigen::VectorXd profile_drop(const FourHigh &stand, const fem::CondensedRoll &grid)
{
  Eigen::VectorXd drop(grid.n_z);
  for (int k = 0; k < grid.n_z; ++k)
    drop[k] = radius_drop(stand.backup_roll, grid.z[k]) + radius_drop(stand.work_roll, grid.z[k]);
  return drop;
}

bool reaches_patch_edge(const fem::ContactPair &pair, const double load)
{
  const auto point = fem::solve_load(pair, load);
  for (int k = 0; k < pair.grid->n_z; ++k)
    if (point.state.active[std::size_t(k) * pair.grid->n_x + pair.grid->n_x - 1])
      return true;
  return false;
}

void make_pairs(ContactModel &m, const std::string &name, const FourHigh &stand)
{
  const auto mirrored = [&](const fem::CondensedRoll &backup, const fem::CondensedRoll &work) {
    auto pair      = fem::make_pair(name, backup, fem::held_by_mirror(backup), work, fem::held_by_mirror(work),
                                    profile_drop(stand, backup));
    pair.reference = "axis to axis, mean over the contact length, each roll squeezed between two opposite contact "
                     "lines (Johnson's datum)";
    return pair;
  };
  const auto &backup = *m.backup.fine;
  const auto &work   = *m.work.fine;
  m.mirrored         = mirrored(backup, work);
  m.coarse           = mirrored(*m.backup.coarse, *m.work.coarse);
  m.in_stand         = fem::make_pair(name, backup, fem::held_by_necks(backup), work,
                                      fem::held_by_strip(work, stand.strip.width), profile_drop(stand, backup));
  m.in_stand.reference =
      "axis to axis, mean over the contact length, backup roll on its bearings, work roll on the strip";
}
}  // namespace

ContactModel contact_model(RunContext &run, const FourHigh &stand, const std::string &name,
                           const ContactSettings &settings, const double largest_load)
{
  const double facing = std::min(stand.work_roll.barrel_length, stand.backup_roll.barrel_length);
  ContactModel m;
  m.closed_form  = {stand.work_roll.barrel_diameter, stand.backup_roll.barrel_diameter, facing, stand.steel};
  const double b = reduce::line_contact(m.closed_form, largest_load).half_width;
  // Crown, bending and a narrow strip gather the load, so the contact may be wider than that of a uniform load.
  for (double reach = 1.5; reach < 12; reach *= 1.5) {
    const auto size = meshes::roll_contact_size(b, settings.elements_per_half_width, reach);
    m.backup =
        condensed_pair(run, "backup roll", geometry_of(stand.backup_roll, facing), size, stand.steel, false);
    m.work = condensed_pair(run, "work roll", geometry_of(stand.work_roll, facing), size, stand.steel, false);
    make_pairs(m, name, stand);
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
