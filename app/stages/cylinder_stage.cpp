#include "app/stages/contact_files.h"
#include "app/stages/contact_model.h"
#include "app/stages/contact_slope.h"
#include "app/stages/contact_stage.h"
#include "app/stages/curve_files.h"
#include "core/model/two_cylinders.h"
#include "core/numerics/mesh_pair.h"
#include "fem/roll/contact_study.h"
#include "meshes/roll/contact_mesh_size.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
PlannedRoll planned_cylinder(const TwoCylinders &spec, const double diameter)
{
  const ContactSettings &c = spec.contact;
  const reduce::CylinderPair metre{spec.upper_diameter, spec.lower_diameter, 1, spec.steel};
  const auto half_width = [&](const double q) { return reduce::line_contact(metre, q).half_width; };
  PlannedRoll plan;
  plan.geometry.radius      = 0.5 * diameter;
  plan.geometry.half_length = std::min(spec.upper_diameter, spec.lower_diameter) / 20;
  plan.size = meshes::slab_contact_size(half_width(c.loads[0]), half_width(c.loads[1]), c.elements_per_half_width);
  plan.size.end_layer = plan.size.largest_layer = plan.geometry.half_length;
  return plan;
}

void solve_cylinders(RunContext &run, const TwoCylinders &spec)
{
  const ContactSettings &c = spec.contact;
  const reduce::CylinderPair metre{spec.upper_diameter, spec.lower_diameter, 1, spec.steel};
  const auto slab = [&](RunContext &own, const std::string &name, const double diameter) {
    const PlannedRoll plan = planned_cylinder(spec, diameter);
    return condensed_pair(own, name, plan.geometry, plan.size, spec.steel, {true, false, false});
  };
  CondensedPair upper, lower;
  const auto slab_into = [&](CondensedPair &pair, const std::string &name, const double diameter) {
    return [&, name, diameter](RunContext &own) { pair = slab(own, name, diameter); };
  };
  run_side_by_side(run, {slab_into(upper, "upper cylinder", spec.upper_diameter),
                         slab_into(lower, "lower cylinder", spec.lower_diameter)});
  StageTimer timer(run, "contact line");
  const auto contact = [&](const fem::CondensedRoll &a, const fem::CondensedRoll &b) {
    auto pair      = fem::make_pair("line", a, fem::held_by_mirror(a), b, fem::held_by_mirror(b),
                                    Eigen::VectorXd::Zero(a.grid.n_z));
    pair.reference = "axis to axis, each cylinder squeezed between two opposite contact lines (Johnson's datum)";
    return pair;
  };
  const auto fine = contact(*upper.fine, *lower.fine), coarse = contact(*upper.coarse, *lower.coarse);
  const auto range = fem::log_spaced(c.loads[0], c.loads[1], c.samples);
  const auto curve = fem::sweep(fine, range, run.progress), curve2 = fem::sweep(coarse, range);
  const auto at     = fem::sweep(fine, Eigen::VectorXd::Constant(1, c.at));
  const auto second = fem::sweep(coarse, Eigen::VectorXd::Constant(1, c.at));
  const auto slope = slope_at(fine, curve, c.at), slope2 = slope_at(coarse, curve2, c.at, Role::companion);
  const auto point2 = fem::solve_load(coarse, c.at);
  const auto hertz  = reduce::line_contact(metre, c.at);
  const auto laws   = reduce::secant_laws(metre, c.at);
  // Half width and peak are fitted apart (1.4); a parabola of them must carry the load again.
  const double carried = 0.5 * M_PI * at.half_width[0] * at.peak_pressure[0];
  const double misfit  = std::abs(carried / c.at - 1);
  const auto scalar = [&](const std::string &what, const std::string &unit, const double value, const double other,
                          std::vector<Check> checks) {
    Parameter s;
    s.value          = value;
    s.unit           = unit;
    s.method         = "contact FEM, plane strain, " + fine.reference;
    s.at             = fmt::format("{:.6g} N/mm", c.at / 1e3);
    s.error_estimate = mesh_pair_error(value, other);
    if (what == "half_width" || what == "peak_pressure")
      s.error_estimate = std::max(s.error_estimate, misfit);
    if (what == "tangent")
      s.error_estimate = std::max(s.error_estimate, difference(slope.exact, value));
    s.checks = std::move(checks);
    s.checks.push_back({"mesh twice as coarse", other, ""});
    run.results.add("contact.line." + what, s);
  };
  scalar("half_width", "m", at.half_width[0], second.half_width[0],
         {
             {"Hertz (3.2)", hertz.half_width, ""}
  });
  scalar("peak_pressure", "Pa", at.peak_pressure[0], second.peak_pressure[0],
         {
             {"Hertz (3.3)", hertz.peak_pressure, ""}
  });
  scalar("approach", "m", at.approach[0], second.approach[0],
         {
             {"Johnson, axis to axis (3.4)", hertz.approach, ""}
  });
  scalar("tangent", "N/m2", slope.tangent, slope2.tangent,
         {
             {"Johnson, axis to axis (3.5b)",      hertz.tangent, ""                                },
             {"active set of this one load (2.8)", slope.exact,   "steps as nodes come into contact"}
  });
  scalar("secant", "N/m2", slope.secant, slope2.secant,
         {
             check(CheckId::johnson_secant, hertz.secant), {"Foeppl (3.8)", laws.foeppl, "another datum"}
  });

  write_curve(run, curve::contact, "line", curve_table(curve, "N/m", "N/m2"));
  write_curve(run, curve::contact_closed, "line", closed_table(metre, range, "N/m", "N/m2"));
  write_fields(run, "fields/contact-line-upper.vtu", upper, spec.steel, point2.state);
  write_fields(run, "fields/contact-line-lower.vtu", lower, spec.steel, point2.state);
  run.progress.note(fmt::format("contact line: {} loads, largest complementarity residual {:.1e}", range.size(),
                                curve.residual));
}
}  // namespace mill
