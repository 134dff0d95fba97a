#include "app/stages/contact/contact_details.h"
#include "app/run/curve_files.h"
#include "app/stages/contact/contact_stage.h"
#include "core/case/contact_inputs.h"
#include "core/model/four_high.h"
#include "core/records/csv.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_contact.h"
#include "fem/roll/contact_details.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
Warning of_contact(const WarningId id, const std::string &name, std::string fact, std::string detail)
{
  return {id, "contact " + name, std::move(fact), std::move(detail), "", {result_name({family::contact, name})}};
}

namespace {
// @param inputs  keys behind it
Parameter computed(const KeyList &inputs, const std::string &unit, const double value, const double error,
                   const double load, const std::string &method)
{
  Parameter p;
  p.inputs         = inputs;
  p.value          = value;
  p.unit           = unit;
  p.method         = method;
  p.at             = at_force(load);
  p.error_estimate = error;
  return p;
}

// Keys behind a result at the load of the first pass.
KeyList keys_of(const RunContext &run, const std::string &name,
                const ContactReading reading = ContactReading::curve)
{
  return contact_keys(*run.keys, name, 0, reading);
}

// Length over which the rolls touch, and a word about it where it is not the whole barrel.
void add_contact_length(RunContext &run, const ContactModel &m, const std::string &name, const double load)
{
  const auto [touch, middle] = fem::contact_length(m, load);
  const double length = touch.value, whole = m.closed_form.length;
  Parameter p = computed(keys_of(run, name), "m", length, touch.error, load,
                         "contact FEM, stations that carry load, held as in the stand");
  p.checks.push_back({"length over which the barrels face each other", whole, ""});
  run.results.add(row::contact::contact_length.of(name), p);
  if (!middle)
    run.warn(of_contact(WarningId::contact_partly_open, name,
                        fmt::format("at {} the rolls do not touch at mid-length, only over {:.0f} of {:.0f} mm",
                                    in_kN(load), 1e3 * length, 1e3 * whole),
                        "the approach does not close the gap there; stiffness and half width at mid-length mean "
                        "little"));
  else if (length < 0.98 * whole)
    run.warn(of_contact(
        WarningId::contact_partly_open, name,
        fmt::format("at {} the rolls touch over {:.0f} of {:.0f} mm", in_kN(load), 1e3 * length, 1e3 * whole),
        "profile, tilt or bending keeps the rest open"));
}

void add_path_plateau(RunContext &run, const ContactModel &m, const std::string &name, const std::string &K,
                      const ContactSettings &settings, const double load)
{
  const auto plateau = fem::plateau_at(m, load, settings.path_trim);
  if (!plateau)
    return;
  const auto &path = plateau->path;
  Parameter p =
      computed(keys_of(run, name, ContactReading::path), "N/m", path.mean, plateau->error, load,
               fmt::format("mean of nodal force (summed over the width) over nodal relative "
                           "displacement, {} stations of {:.1f} mm on average, {:.0f} % of the path left "
                           "out at each end",
                           path.stations, 1e3 * path.tributary_length, 100 * settings.path_trim));
  p.checks.push_back({"secant of the contact for the same length", plateau->of_length,
                      "the plateau grows with the length that belongs to a node: no property of the contact"});
  p.checks.push_back({"mesh twice as coarse, for the same length", plateau->coarse, ""});
  run.results.add(row::roll_contact::path_plateau.of(K), p);
}

void add_joint(RunContext &run, const ContactModel &m, const std::string &name, const double load,
               const double largest)
{
  const auto joint = fem::joint_at(m, load, largest);
  const std::string method =
      "contact FEM, slope over the load fitted, frictionless, " + m.whole.reference + ", theory.md (2.14)";
  const auto add = [&](const RowOf<1> &made, const int row, const int column, const char *check,
                       const double reference) {
    Parameter p =
        computed(keys_of(run, name), made.unit, joint.value(row, column), joint.error(row, column), load, method);
    p.checks.push_back({check, reference, "uniform load, no barrel ends"});
    p.checks.push_back({"mesh twice as coarse", joint.coarse(row, column), ""});
    run.results.add(made.of(name), p);
  };
  add(row::contact::joint_yy, 1, 1, "Hertz line contact (3.5b)", joint.tangent);
  add(row::contact::joint_rx_rx, 3, 3, "the same spread over the length, K L^2/12", joint.spread);
  add(row::contact::joint_xx, 0, 0, "geometric term of the force, -F over the distance of the axes",
      joint.sideways);
  add(row::contact::joint_ry_ry, 4, 4, "geometric term of a uniform load, -F L^2/12 over it", joint.crossing);
  if (joint.value(2, 2) != 0)
    add(row::contact::joint_zz, 2, 2, "straight profiles", 0);
  if (m.extent == fem::Extent::whole) {
    add(row::contact::joint_y_rx, 1, 3, "the same on both sides", 0);
    add(row::contact::joint_y_z, 1, 2, "straight profiles", 0);
  }
}

// The tangent with Coulomb friction: that without, times what friction does to it on one mesh.
void add_friction(RunContext &run, const FourHigh &stand, const ContactModel &m, const std::string &name,
                  const std::string &K, const ContactSettings &settings, const double load,
                  const fem::Compared &tangent)
{
  constexpr int steps = 10;
  const auto solved   = [&](const fem::PairMesh mesh, const int n_steps) {
    const ContactModel &all = complete(m);
    const bool fine         = mesh == fem::PairMesh::fine;
    const auto &backup      = *(fine ? all.backup.fine : all.backup.coarse),
               &work        = *(fine ? all.work.fine : all.work.coarse);
    const auto quarter = fem::make_pair(name, backup, fem::held_by_mirror(backup), work, fem::held_by_mirror(work),
                                          even_drop(stand, settings, backup.grid.z));
    return fem::friction_effect(quarter, backup, work, settings.friction, load, n_steps);
  };
  const auto effect = fem::friction_at(m, settings.friction, load, steps, tangent, solved);
  Parameter p =
      computed(keys_of(run, name, ContactReading::friction), "N/m", effect.tangent, effect.error, load,
               fmt::format("contact FEM, {}.tangent times {:.5f}, the tangent with Coulomb friction {:g} "
                           "over that without on the same mesh, loaded from zero in {} equal steps, "
                           "{:.0f} % of the touching nodes slip",
                           K, effect.fine.ratio, settings.friction, steps, 100 * effect.fine.slipping));
  p.checks.push_back({"without friction", tangent.value, "equal materials: nearly uncoupled"});
  p.checks.push_back({"effect of friction on a mesh twice as coarse", tangent.value * effect.coarse.ratio, ""});
  p.checks.push_back(
      {"the same in twice as many load steps", tangent.value * effect.twice.ratio, "the load path matters"});
  run.results.add(row::roll_contact::friction_tangent.of(K), p);
}

// Where the force stands and how the axes are tilted: one is imposed, the other follows.
void add_one_sidedness(RunContext &run, const ContactModel &m, const std::string &name, const double load)
{
  const auto sides = fem::one_sidedness(m, load);
  if (!sides)
    return;
  const auto add = [&](const RowOf<1> &row, const fem::Compared &number, const double reference) {
    Parameter p = computed(keys_of(run, name), row.unit, number.value, number.error, load,
                           "contact FEM, held as in the stand");
    p.checks.push_back({"squeezed between mirrored contacts", reference, "another way of holding the rolls"});
    p.checks.push_back({"mesh twice as coarse", number.coarse, ""});
    run.results.add(row.of(name), p);
  };
  add(row::contact::tilt, sides->tilt, sides->mirrored_tilt);
  add(row::contact::load_offset, sides->offset, sides->mirrored_offset);
}

void add_largest_pressure(RunContext &run, const ContactModel &m, const FourHigh &stand, const std::string &name,
                          const double load)
{
  const auto [pressure, mirrored] = fem::largest_pressure(m, load);
  const double peak               = pressure.value;
  Parameter p                     = computed(keys_of(run, name), "Pa", peak, pressure.error, load,
                                             "contact FEM, largest nodal pressure of the patch, held as in the stand; at a sharp end "
                                                                 "it grows with the mesh");
  p.checks.push_back({"squeezed between mirrored contacts", mirrored, "another way of holding the rolls"});
  p.checks.push_back({"mesh twice as coarse", pressure.coarse, ""});
  run.results.add(row::contact::largest_pressure.of(name), p);
  if (peak > 5 * stand.steel.yield_stress)
    run.warn(of_contact(WarningId::contact_yield, name,
                        fmt::format("the largest pressure of {:.0f} MPa at {} is above five times "
                                    "steel.yield_stress = {:.0f} MPa",
                                    1e-6 * peak, in_kN(load), 1e-6 * stand.steel.yield_stress),
                        "small elastic strain does not hold there"));
}

void write_pressure_map(RunContext &run, const fem::ContactPair &pair, const std::string &name, const double load)
{
  const Eigen::MatrixXd p = fem::pressure_map(pair, fem::solve_load(pair, load));
  const auto &g           = pair.grid;
  Eigen::VectorXd z(p.size()), x(p.size()), value(p.size());
  Eigen::Index row = 0;
  for (int k = 0; k < g.n_z; ++k)
    for (int i = 0; i < p.cols(); ++i, ++row) {
      z[row]     = g.z[k];
      x[row]     = (i < g.n_x - 1 ? -1 : 1) * g.x[std::abs(i - (g.n_x - 1))];
      value[row] = p(k, i);
    }
  Table table;
  table.add("z", "m", z).add("x", "m", x).add("pressure", "Pa", value);
  write_curve(run, curve::contact_pressure, name, table);
}
}  // namespace

void require_resolved(RunContext &run, const ContactModel &m, const std::string &name,
                      const ContactSettings &settings, const double load)
{
  const auto &grid     = m.mirrored.grid;
  const double element = grid.x[grid.degree] - grid.x[0];
  const double b       = reduce::line_contact(m.closed_form, load).half_width;
  if (b >= 2 * element)
    return;
  const std::string key = fmt::format("contact.{}.elements_per_half_width", name);
  const Warning warning{
      WarningId::contact_mesh,
      "",
      fmt::format("{} = {} makes elements of {:.3f} mm for the largest load", key,
                  settings.elements_per_half_width, 1e3 * element),
      fmt::format("at the working load of {} the contact is only {:.3f} mm to each side and needs elements of "
                  "{:.3f} mm",
                  in_kN(load), 1e3 * b, 1e3 * b / 2),
      fmt::format("take {} or more, or narrow contact.{}.loads",
                  int(std::ceil(settings.elements_per_half_width * 2 * element / b)), name),
      {result_name({family::contact, name})},
      key,
      settings.elements_place};
  if (b < element)
    throw InputError(settings.elements_place, text_of(warning));
  run.warn(warning);
}

void add_contact_details(RunContext &run, const ContactModel &model, const std::string &name, const std::string &K,
                         const FourHigh &stand, const ContactSettings &settings, const double load,
                         const double largest, const fem::Compared &tangent)
{
  add_contact_length(run, model, name, load);
  add_path_plateau(run, model, name, K, settings, load);
  add_joint(run, model, name, load, largest);
  if (!std::isnan(settings.friction)) {
    if (model.extent == fem::Extent::whole)
      run.assume(
          fmt::format("contact {}: the effect of friction is that of the mean of both sides: neither tilt nor "
                      "offset enter it",
                      name));
    add_friction(run, stand, model, name, K, settings, load, tangent);
  }
  write_pressure_map(run, model.in_stand, name, load);
  add_one_sidedness(run, model, name, load);
  add_largest_pressure(run, model, stand, name, load);
  const auto &bending = stand.work_roll.bending_force;
  if (load < bending[0] + bending[1])
    run.warn(of_contact(WarningId::contact_bending, name,
                        fmt::format("the bending forces on the chocks exceed the load of {}", in_kN(load)),
                        "the strip would have to pull on the roll; values held as in the stand are not valid"));
}
}  // namespace mill
