#include "app/run/curve_files.h"
#include "app/stages/contact/body_pair.h"
#include "app/stages/contact/contact_files.h"
#include "app/stages/contact/contact_model.h"
#include "app/stages/contact/contact_stage.h"
#include "app/stages/contact/half_plane_stage.h"
#include "app/stages/contact/space_stage.h"
#include "core/case/contact_inputs.h"
#include "core/records/rows_of_contact.h"
#include "fem/contact/half_plane_numbers.h"
#include "fem/contact/two_bodies.h"
#include "fem/roll/contact_slope.h"
#include "fem/roll/contact_study.h"
#include "meshes/roll/contact_mesh_size.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using contact::LineValues;

// What one engine says of the contact at its working load, and on larger elements.
struct LineAnswer {
  std::string method;
  std::string coarser;       ///< name of the second set of values
  LineValues value, second;  ///< per metre of length
  double ratio = 2;          ///< -, element size of the second over that of the first
  double exact = not_given;  ///< N/m2, slope with the active set held; NaN where the engine has none to show
  ContactCurve curve;
};

struct Slabs {
  CondensedPair upper, lower;
};

// Meshes and condenses the elastic cylinders; of one on a rigid plane that one alone.
Slabs slabs_of(RunContext &run, const TwoCylinders &spec, const PlaneEngine engine)
{
  Slabs slabs;
  const auto slab_into = [&](CondensedPair &pair, const std::string &name, const RoundBody &body) {
    return [&, name](RunContext &part_run) {
      const PlannedRoll plan = planned_cylinder(spec, body.diameter);
      pair = condensed_pair(part_run, name, plan.geometry, plan.size, material_of(body, spec.steel),
                            {true, false, false, "a smaller contact.line.elements_per_half_width"});
    };
  };
  std::vector<IndependentStage> stages;
  if (engine != PlaneEngine::mirrored_lower)
    stages.push_back(slab_into(slabs.upper, "upper cylinder", spec.upper));
  if (engine != PlaneEngine::mirrored_upper)
    stages.push_back(slab_into(slabs.lower, "lower cylinder", spec.lower));
  run_side_by_side(run, std::move(stages));
  return slabs;
}

// One of two alike, which their plane of symmetry halves: theory.md 33.2.
void halve(ContactCurve &curve)
{
  curve.approach *= 0.5;
  curve.tangent *= 2;
  curve.secant *= 2;
}
void halve(LineValues &values)
{
  values.approach *= 0.5;
  values.tangent *= 2;
  values.secant *= 2;
}

LineAnswer by_finite_elements(RunContext &run, const TwoCylinders &spec, const Slabs &slabs,
                              const PlaneEngine engine)
{
  const ContactSettings &c    = spec.contact;
  const CondensedPair &first  = engine == PlaneEngine::mirrored_lower ? slabs.lower : slabs.upper,
                      &facing = engine == PlaneEngine::mirrored_upper ? slabs.upper : slabs.lower;
  const auto contact          = [&](const fem::CondensedRoll &a, const fem::CondensedRoll &b) {
    auto pair = fem::make_pair("line", a, fem::held_by_mirror(a), b, fem::held_by_mirror(b),
                                        Eigen::VectorXd::Zero(a.grid.n_z));
    pair.reference =
        engine == PlaneEngine::two_cylinders
                     ? "axis to axis, each cylinder squeezed between two opposite contact lines (Johnson's datum)"
                     : "axis to rigid plane, the cylinder squeezed between two opposite contact lines "
                       "(Johnson's datum), the plane as that of symmetry of two alike";
    return pair;
  };
  const auto fine = contact(*first.fine, *facing.fine), coarse = contact(*first.coarse, *facing.coarse);
  const auto range = fem::log_spaced(c.loads[0], c.loads[1], c.samples);
  LineAnswer a;
  a.curve            = fem::sweep(fine, range, run.progress);
  const auto curve2  = fem::sweep(coarse, range);
  const auto working = fem::sweep(fine, Eigen::VectorXd::Constant(1, c.at));
  const auto second  = fem::sweep(coarse, Eigen::VectorXd::Constant(1, c.at));
  const auto slope   = fem::slope_at(fine, a.curve, c.at),
             slope2  = fem::slope_at(coarse, curve2, c.at, fem::Role::companion);
  const auto point2  = fem::solve_load(coarse, c.at);
  a.method           = "contact FEM, plane strain, " + fine.reference;
  a.coarser          = "mesh twice as coarse";
  a.value  = {working.half_width[0], working.peak_pressure[0], working.approach[0], slope.tangent, slope.secant};
  a.second = {second.half_width[0], second.peak_pressure[0], second.approach[0], slope2.tangent, slope2.secant};
  a.exact  = slope.exact;
  if (engine != PlaneEngine::two_cylinders) {
    halve(a.curve);
    halve(a.value);
    halve(a.second);
    a.exact *= 2;
  }
  if (slabs.upper.coarse)
    write_fields(run, "fields/contact-line-upper.vtu", slabs.upper, material_of(spec.upper, spec.steel),
                 point2.state);
  if (slabs.lower.coarse)
    write_fields(run, "fields/contact-line-lower.vtu", slabs.lower, material_of(spec.lower, spec.steel),
                 point2.state);
  return a;
}

LineAnswer by_half_planes(RunContext &run, const TwoCylinders &spec)
{
  const ContactSettings &c = spec.contact;
  LineAnswer a;
  a.method =
      "half planes, boundary elements (sec. 33.2), cylinders to their axes with Johnson's datum, an elastic plane "
      "to the stated depth";
  a.coarser = "strips twice as wide";
  a.ratio   = contact::half_plane_coarsening();
  a.value   = contact::half_plane_values(spec, c.at, true);
  a.second  = contact::half_plane_values(spec, c.at, false);
  a.curve   = contact::half_plane_curve(spec, fem::log_spaced(c.loads[0], c.loads[1], c.samples), run.progress);
  return a;
}

void add_results(RunContext &run, const TwoCylinders &spec, const PlaneEngine engine, const LineAnswer &a)
{
  const ContactSettings &c = spec.contact;
  const auto closed        = contact::line_bodies(contact::line_bodies_of(spec), c.at);
  const LineValues error   = contact::line_errors(a.value, a.second, c.at, a.exact, a.ratio);
  const bool by_elements   = engine != PlaneEngine::half_planes;
  const LineValues other   = by_elements ? contact::half_plane_values(spec, c.at, true) : LineValues{};
  const auto scalar        = [&](const RowOf<0> &row, double LineValues::*member, std::vector<Check> checks,
                          const BodyReading reading = BodyReading::pressed) {
    Parameter s;
    s.value          = a.value.*member;
    s.unit           = row.unit;
    s.method         = a.method;
    s.at             = {"{}", {{c.at, "N/mm"}}};
    s.error_estimate = error.*member;
    s.checks         = std::move(checks);
    s.inputs         = cylinder_keys(*run.keys, reading);
    if (by_elements)
      s.checks.push_back({"half planes, boundary elements (sec. 33.2)", other.*member, ""});
    s.checks.push_back({a.coarser, a.second.*member, ""});
    run.results.add(row.of(), s);
  };
  const char *johnson = engine == PlaneEngine::two_cylinders ? "Johnson, axis to axis " : "Johnson ";
  scalar(row::line::half_width, &LineValues::half_width, {{"Hertz (3.2)", closed.half_width, ""}});
  scalar(row::line::peak_pressure, &LineValues::peak_pressure, {{"Hertz (3.3)", closed.peak_pressure, ""}});
  scalar(row::line::approach, &LineValues::approach, {{johnson + std::string("(3.4)"), closed.approach, ""}});
  std::vector<Check> slopes{{johnson + std::string("(3.5b)"), closed.tangent, ""}};
  if (std::isfinite(a.exact))
    slopes.push_back({"active set of this one load (2.8)", a.exact, "steps as nodes come into contact"});
  scalar(row::line::tangent, &LineValues::tangent, std::move(slopes), BodyReading::slope);
  std::vector<Check> secants{check(CheckId::johnson_secant, closed.secant)};
  if (const auto steel = one_steel(spec))
    secants.push_back({"Foeppl (3.8)", reduce::secant_laws(*steel, c.at).foeppl, "another datum"});
  scalar(row::line::secant, &LineValues::secant, std::move(secants));
}

// Laws of rolls of one steel, or what holds for any two bodies.
Table closed_curve(const TwoCylinders &spec, const Eigen::VectorXd &loads)
{
  if (const auto steel = one_steel(spec))
    return closed_table(*steel, loads, "N/m", "N/m2");
  Eigen::VectorXd secant(loads.size()), tangent(loads.size());
  for (Eigen::Index i = 0; i < loads.size(); ++i) {
    const auto line = contact::line_bodies(contact::line_bodies_of(spec), loads[i]);
    secant[i]       = line.secant;
    tangent[i]      = line.tangent;
  }
  Table table;
  table.add("load", "N/m", loads).add("hertz_secant", "N/m2", secant).add("hertz_tangent", "N/m2", tangent);
  return table;
}
}  // namespace

PlannedRoll planned_cylinder(const TwoCylinders &spec, const double diameter)
{
  const ContactSettings &c = spec.contact;
  const auto half_width    = [&](const double q) {
    return contact::line_bodies(contact::line_bodies_of(spec), q).half_width;
  };
  const auto round = [](const RoundBody &body) {
    return body.plane() ? std::numeric_limits<double>::infinity() : body.diameter;
  };
  PlannedRoll plan;
  plan.geometry.radius      = 0.5 * diameter;
  plan.geometry.half_length = std::min(round(spec.upper), round(spec.lower)) / 20;
  plan.size = meshes::slab_contact_size(half_width(c.loads[0]), half_width(c.loads[1]), c.elements_per_half_width);
  plan.size.end_layer = plan.size.largest_layer = plan.geometry.half_length;
  return plan;
}

void solve_cylinders(RunContext &run, const TwoCylinders &spec)
{
  if (spec.in_space)
    return solve_space(run, spec);
  const PlaneEngine engine = plane_engine(spec);
  Slabs slabs;
  if (engine != PlaneEngine::half_planes)
    slabs = slabs_of(run, spec, engine);
  StageTimer timer(run, "contact line");
  const LineAnswer answer = engine == PlaneEngine::half_planes ? by_half_planes(run, spec)
                                                               : by_finite_elements(run, spec, slabs, engine);
  add_results(run, spec, engine, answer);
  write_curve(run, curve::contact, "line", curve_table(answer.curve, "N/m", "N/m2"));
  write_curve(run, curve::contact_closed, "line", closed_curve(spec, answer.curve.load));
  solve_over_width(run, spec);
  run.progress.note(fmt::format("contact line: {} loads, largest complementarity residual {:.1e}",
                                answer.curve.load.size(), answer.curve.residual));
}
}  // namespace mill
