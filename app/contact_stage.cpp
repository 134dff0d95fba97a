#include "app/contact_stage.h"
#include "app/condensed_rolls.h"
#include "app/contact_files.h"
#include "fem/contact_study.h"
#include "meshes/contact_mesh_size.h"
#include "reduce/contact_stiffness.h"
#include "reduce/line_contact.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill
{
namespace
{
  const std::string mirrored_reference =
      "axis to axis, mean over the contact length, each roll squeezed between two opposite contact lines (Johnson's datum)";
  const std::string stand_reference =
      "axis to axis, mean over the contact length, backup roll on its bearings, work roll on the strip";

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

  // How much the radius is smaller than at mid-length, mean of both halves of the barrel.
  double radius_drop(const Roll &roll, const double z)
  {
    if (roll.crown_table.empty())
      return 0.5 * roll.crown * std::pow(2 * z / roll.barrel_length, 2);
    const auto diameter = [&](const double s) { return 0.5 * (table_at(roll.crown_table, s) + table_at(roll.crown_table, -s)); };
    return 0.5 * (diameter(0) - diameter(z));
  }

  bool is_one_sided(const Roll &roll)
  {
    return std::any_of(roll.crown_table.begin(), roll.crown_table.end(), [&](const auto &row) {
      return std::abs(row[1] - table_at(roll.crown_table, -row[0])) > 1e-7;
    });
  }

  // Both ways of holding the rolls side by side.
  Table barrel_table(const BarrelProfile &p, const BarrelProfile &held)
  {
    Table table{{"z", "line_load", "approach", "tangent", "half_width", "peak_pressure"},
                {"m", "N/m", "m", "N/m2", "m", "Pa"},
                {p.z, p.line_load, p.approach, p.tangent, p.half_width, p.peak_pressure}};
    for (int c = 1; c < 6; ++c) {
      table.names.push_back("in_stand_" + table.names[c]);
      table.units.push_back(table.units[c]);
    }
    table.columns.insert(table.columns.end(),
                         {held.line_load, held.approach, held.tangent, held.half_width, held.peak_pressure});
    return table;
  }

  // Slope at a working load: of the fitted curve, which does not step as nodes come into contact, where the contact is a
  // line contact; else the exact slope of the active set.
  struct Slope {
    double tangent, secant, exact;
  };
  Slope slope_at(const fem::ContactPair &pair, const ContactCurve &curve, const double load)
  {
    const auto point = fem::solve_load(pair, load);
    try {
      const auto fit = reduce::contact_stiffness(curve, load);
      return {fit.tangent, load / point.approach, point.tangent};
    } catch (const SolverError &) {
      return {point.tangent, load / point.approach, point.tangent};
    }
  }

  bool reaches_patch_edge(const fem::ContactPair &pair, const double load)
  {
    const auto point = fem::solve_load(pair, load);
    for (int k = 0; k < pair.grid->n_z; ++k)
      if (point.state.active[std::size_t(k) * pair.grid->n_x + pair.grid->n_x - 1])
        return true;
    return false;
  }

  // A contact on both meshes and in both ways of holding the rolls.
  struct ContactModel {
    CondensedPair backup, work;
    fem::ContactPair mirrored, in_stand, coarse;
  };

  ContactModel build(Session &session, const FourHigh &stand, const std::string &name, const ContactSettings &settings,
                     const double largest_load)
  {
    const double facing = std::min(stand.work_roll.barrel_length, stand.backup_roll.barrel_length);
    const reduce::CylinderPair pair{stand.work_roll.barrel_diameter, stand.backup_roll.barrel_diameter, facing, stand.steel};
    const double b = reduce::line_contact(pair, largest_load).half_width;
    ContactModel m;
    // Crown, bending and a narrow strip gather the load: the patch is widened until nothing touches its edge.
    for (double reach = 1.5; reach < 12; reach *= 1.5) {
      const auto size = meshes::roll_contact_size(b, settings.elements_per_half_width, reach);
      m.backup        = condensed_pair(session, "backup roll", geometry_of(stand.backup_roll, facing), size, stand.steel, false);
      m.work          = condensed_pair(session, "work roll", geometry_of(stand.work_roll, facing), size, stand.steel, false);
      const auto drop = [&](const fem::CondensedRoll &grid) {
        Eigen::VectorXd d(grid.n_z);
        for (int k = 0; k < grid.n_z; ++k)
          d[k] = radius_drop(stand.backup_roll, grid.z[k]) + radius_drop(stand.work_roll, grid.z[k]);
        return d;
      };
      const auto &B = *m.backup.fine, &W = *m.work.fine;
      m.mirrored = fem::make_pair(name, B, fem::held_by_mirror(B), W, fem::held_by_mirror(W), drop(B));
      m.in_stand = fem::make_pair(name, B, fem::held_by_necks(B), W, fem::held_by_strip(W, stand.strip.width), drop(B));
      const auto &b2 = *m.backup.coarse, &w2 = *m.work.coarse;
      m.coarse       = fem::make_pair(name, b2, fem::held_by_mirror(b2), w2, fem::held_by_mirror(w2), drop(b2));
      m.mirrored.reference = m.coarse.reference = mirrored_reference;
      m.in_stand.reference                      = stand_reference;
      if (!reaches_patch_edge(m.mirrored, largest_load) && !reaches_patch_edge(m.in_stand, largest_load))
        return m;
      session.progress.note("contact " + name + ": the contact reaches the edge of its patch, meshing a wider one");
    }
    throw SolverError({"contact " + name + ": the contact is wider than any patch tried",
                       fmt::format("12 times the Hertz half width of {:.3f} mm at {}", 1e3 * b, in_kN(largest_load)),
                       "a crown that leaves only a short part of the barrel in contact",
                       "check work_roll.crown and backup_roll.crown, or lower contact." + name + ".loads", ""});
  }

  std::vector<std::string> contact_inputs(const std::string &name)
  {
    std::vector<std::string> keys{"steel.youngs_modulus", "steel.poisson_ratio"};
    for (const char *roll : {"work_roll", "backup_roll"})
      for (const char *key : {"barrel_diameter", "barrel_length", "neck_diameter", "crown"})
        keys.push_back(std::string(roll) + "." + key);
    keys.insert(keys.end(), {"work_roll.total_length", "backup_roll.neck_length", "contact." + name + ".loads",
                             "contact." + name + ".elements_per_half_width"});
    return keys;
  }

  SolvedContact solve_one(Session &session, const FourHigh &stand, const std::string &name, const std::string &K,
                          const ContactSettings &settings, const std::vector<double> &loads)
  {
    const auto [least, most] = std::minmax_element(loads.begin(), loads.end());
    const bool given_range   = !std::isnan(settings.loads[0]);
    const double low = given_range ? settings.loads[0] : 0.1 * *least, high = given_range ? settings.loads[1] : 2 * *most;
    for (const double load : loads)
      if (load < low || load > high)
        throw InputError(settings.loads_place, fmt::format("contact.{}.loads = {} .. {} does not hold the working load of {}; "
                                                           "a curve is never extrapolated, widen the range",
                                                           name, in_kN(low), in_kN(high), in_kN(load)));
    const ContactModel m = build(session, stand, name, settings, high);
    StageTimer timer(session, "contact " + name);
    const auto range = fem::log_spaced(low, high, settings.samples);
    SolvedContact out;
    out.curve               = fem::sweep(m.mirrored, range, session.progress);
    const auto stand_curve  = fem::sweep(m.in_stand, range, session.progress);
    const auto coarse_curve = fem::sweep(m.coarse, range, session.progress);

    const double facing = 2 * m.backup.fine->z[m.backup.fine->n_z - 1];
    const reduce::CylinderPair pair{stand.work_roll.barrel_diameter, stand.backup_roll.barrel_diameter, facing, stand.steel};
    for (std::size_t p = 0; p < loads.size(); ++p) {
      const double F   = loads[p];
      const auto fine  = slope_at(m.mirrored, out.curve, F), coarse = slope_at(m.coarse, coarse_curve, F);
      const auto held  = slope_at(m.in_stand, stand_curve, F);
      const auto hertz = reduce::line_contact(pair, F);
      const auto laws  = reduce::secant_laws(pair, F);
      Parameter k;
      k.unit   = "N/m";
      k.method = "contact FEM, " + mirrored_reference;
      k.at     = in_kN(F);
      k.inputs = contact_inputs(name);
      Parameter tangent = k, secant = k;
      tangent.value          = fine.tangent;
      tangent.error_estimate = std::max(std::abs(coarse.tangent / fine.tangent - 1), std::abs(fine.exact / fine.tangent - 1));
      tangent.checks         = {{"Hertz line contact, infinitely long (3.5b)", hertz.tangent, "no barrel ends"},
                                {"active set of this one load", fine.exact, "steps as nodes come into contact"},
                                {"mesh twice as coarse", coarse.tangent, ""},
                                {"rolls held as in the stand", held.tangent, "bending, strip width, shear-balanced backup roll"}};
      secant.value          = fine.secant;
      secant.error_estimate = std::abs(coarse.secant / fine.secant - 1);
      secant.checks         = {{"Johnson, axis to axis (3.5a)", hertz.secant, "upper end of the band of closed forms"},
                               {"Foeppl (3.8)", laws.foeppl, ""},
                               {"half space (3.9)", laws.half_space, ""},
                               {"Palmgren (3.10)", laws.palmgren, "lower end of the band"},
                               {"rolls held as in the stand", held.secant, "bending, strip width, shear-balanced backup roll"}};
      out.tangent.push_back(tangent);
      out.secant.push_back(secant);
      const std::string prefix = p == 0 ? "" : stand.passes[p].name + ".";
      session.results.add(prefix + K + ".tangent", tangent);
      session.results.add(prefix + K + ".secant", secant);
      const auto add_held = [&](const char *what, const double value, const double exact, const double mirrored) {
        Parameter h      = k;
        h.method         = "contact FEM, " + stand_reference;
        h.value          = value;
        h.error_estimate = std::max(tangent.error_estimate, std::abs(exact / value - 1));
        h.checks         = {{"rolls squeezed between mirrored contacts", mirrored, "another datum and no bending"}};
        h.inputs.insert(h.inputs.end(), {"strip.width", "backup_roll.bearing_span"});
        session.results.add(prefix + K + ".in_stand_" + what, h);
      };
      add_held("tangent", held.tangent, held.exact, fine.tangent);
      add_held("secant", held.secant, held.secant, fine.secant);
    }

    const double F    = loads[0];
    const auto point  = fem::solve_load(m.mirrored, F);
    const auto fine   = fem::barrel_profile(m.mirrored, point);
    const auto held   = fem::barrel_profile(m.in_stand, fem::solve_load(m.in_stand, F));
    const auto state2 = fem::solve_load(m.coarse, F);
    const auto coarse = fem::barrel_profile(m.coarse, state2);
    const auto hertz  = reduce::line_contact(pair, F);
    const auto scalar = [&](const std::string &what, const std::string &unit, const double value, const double second,
                            const double closed, const std::string &reference) {
      Parameter s;
      s.value  = value;
      s.unit   = unit;
      s.method = "contact FEM, " + reference;
      s.at     = in_kN(F);
      s.inputs = contact_inputs(name);
      s.error_estimate = std::abs(second / value - 1);
      s.checks         = {{"Hertz line contact", closed, ""}, {"mesh twice as coarse", second, ""}};
      session.results.add("contact." + name + "." + what, s);
    };
    scalar("half_width", "m", fine.half_width[0], coarse.half_width[0], hertz.half_width, "at mid-length");
    scalar("peak_pressure", "Pa", fine.peak_pressure[0], coarse.peak_pressure[0], hertz.peak_pressure, "at mid-length");
    scalar("approach", "m", point.approach, state2.approach, hertz.approach, mirrored_reference);
    Table table = curve_table(out.curve);
    table.names.insert(table.names.end(), {"in_stand_approach", "in_stand_tangent", "in_stand_secant"});
    table.units.insert(table.units.end(), {"m", "N/m", "N/m"});
    table.columns.insert(table.columns.end(), {stand_curve.approach, stand_curve.tangent, stand_curve.secant});
    session.out.write("curves/contact-" + name + ".csv", csv_text(table));
    session.out.write("curves/contact-" + name + "-closed.csv", csv_text(closed_table(pair, range)));
    session.out.write("curves/contact-" + name + "-barrel.csv", csv_text(barrel_table(fine, held)));
    write_fields(session, "fields/contact-" + name + "-backup-roll.vtu", m.backup, stand.steel, state2.state);
    write_fields(session, "fields/contact-" + name + "-work-roll.vtu", m.work, stand.steel, state2.state);
    session.progress.note(fmt::format("contact {}: {} loads, largest complementarity residual {:.1e}", name, range.size(),
                                      out.curve.residual));
    return out;
  }
} // namespace

std::string in_kN(const double load)
{
  return fmt::format("{:.1f} kN", load / 1e3);
}

std::map<std::string, SolvedContact> solve_contacts(Session &session, const FourHigh &stand, const std::vector<double> &loads)
{
  for (const auto &[name, roll] : {std::pair{"work_roll", &stand.work_roll}, std::pair{"backup_roll", &stand.backup_roll}})
    if (is_one_sided(*roll))
      session.warn(std::string(name) + ".crown_table differs between the two sides; the contact uses the mean of both");
  std::map<std::string, SolvedContact> out;
  out["upper"] = solve_one(session, stand, "upper", "K3", stand.upper_contact, loads);
  out["lower"] = solve_one(session, stand, "lower", "K5", stand.lower_contact, loads);
  return out;
}
} // namespace mill
