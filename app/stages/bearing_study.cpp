#include "app/stages/bearing_study.h"
#include "app/stages/bearing_files.h"
#include "core/numerics/mesh_pair.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
bearing::RingDrive drive_of(const BearingQuestion &q, const double radial)
{
  auto drive = bearing::radial_drive(radial, q.tilt);
  if (q.axial != 0) {
    drive.value[2]     = q.axial;
    drive.by_motion[2] = false;
  }
  return drive;
}

RollerBearing by_standard(RollerBearing b, const std::string &law)
{
  b.roller_law = law;
  b.rings      = "rigid";
  return b;
}

bearing::BearingModel standard_model(const BearingQuestion &q, const std::string &law)
{
  auto model       = bearing::rigid_model(by_standard(with_row_places(q.bearing), law));
  model.cage_angle = q.cage_angle;
  return model;
}

// Load of the contact elements over that of the slices at one approach, less one.
double deviation_of_slices(const BearingParts &parts, const double load)
{
  if (!parts.roller || !(load > 0) || load > largest_contact_load(parts))
    return 0;
  fem::RollerContact contact(*parts.roller, drop_of(parts.model.bearing));
  const auto state = contact.solve_load(load);
  return state.load / bearing::roller_load(parts.model.roller, state.approach, 0).load - 1;
}

bearing::AssemblyState solved(bearing::BearingModel model, const BearingStudy &s)
{
  model.cage_angle = s.question.cage_angle;
  return bearing::BearingAssembly(std::move(model)).solve(s.drive);
}

// How well each ingredient of the model is known: the state without it, or with its neighbour.
void add_companions(BearingStudy &s)
{
  for (const BearingVariant &v : s.parts.companions)
    s.companions.push_back({v.about, solved(v.model, s)});
  if (s.slice_deviation != 0) {
    auto stiffer   = s.parts.model;
    stiffer.roller = bearing::stiffened(stiffer.roller, 1 + s.slice_deviation);
    s.companions.push_back({"contact elements instead of slices", solved(std::move(stiffer), s)});
  }
  if (!s.parts.roller) {
    // Without elements the spread of the published laws is how well the law of one roller is known.
    const bool is_iso = s.question.bearing.roller_law == "iso";
    auto other        = s.parts.model;
    other.roller =
        bearing::with_limits(bearing::roller_law(by_standard(other.bearing, is_iso ? "palmgren" : "iso")));
    s.companions.push_back({"another law of one roller", solved(std::move(other), s)});
  }
  for (const BearingVariant &v : s.parts.supports)
    s.supports.push_back({v.about, solved(v.model, s)});
}

// Rows in the other arrangements in use, between rigid rings: what hangs on an arrangement that nobody stated.
void add_arrangements(BearingStudy &s, bearing::BearingModel rigid)
{
  if (!s.question.bearing.row_hands_assumed)
    return;
  const RollerBearing &b = s.question.bearing;
  for (const std::string &hands : usual_arrangements(b.rows))
    if (const std::string name = arrangement_name(hands, b.rows); name != arrangement_name(b.row_hands, b.rows)) {
      rigid.bearing.row_hands = hands;
      s.arrangements.push_back({name, solved(rigid, s)});
    }
}

// The radial stiffness by the other models, beside that of the case.
void add_checks(BearingStudy &s, const bearing::AssemblyState &palmgren, const std::string &rigid_name)
{
  const bool elastic      = s.question.bearing.rings == "elastic";
  const std::string other = elastic ? "rigid rings" : "another law of one roller";
  const auto add = [&](const std::string &name, const bearing::AssemblyState &at, const std::string &note) {
    s.tangent_checks.push_back({name, bearing::radial_tangent(at, s.drive), note});
    s.secant_checks.push_back({name, bearing::radial_secant(at), note});
  };
  add("ISO/TS 16281, rigid rings", s.standard, other);
  add("Palmgren, rigid rings", palmgren, other);
  if (elastic)
    add(rigid_name, s.rigid, "the same rollers, rigid rings");
  for (const StudyVariant &support : s.supports)
    add(support.about, support.at, "a support that the case leaves open; part of the error");
}

// The state at the working load; without one, the curve as far as it went is left behind.
bearing::AssemblyState solve_or_keep(RunContext &run, const BearingStudy &s, bearing::BearingAssembly &assembly)
{
  try {
    return assembly.solve(s.drive);
  } catch (SolverError &e) {
    if (!s.curve.states.empty()) {
      write_load_curve(run, s);
      e.report.kept =
          fmt::format("{} loads of the curve up to {:.4g} kN, curves/bearing-{}.csv", s.curve.states.size(),
                      s.question.loads[s.curve.states.size() - 1] / 1e3, slug(s.question.bearing.name));
    }
    throw;
  }
}
}  // namespace

std::string model_name(const RollerBearing &b)
{
  const std::string law = b.roller_law == "fe"         ? "contact FEM of one roller"
                          : b.roller_law == "iso"      ? "ISO/TS 16281 laminae"
                          : b.roller_law == "palmgren" ? "Palmgren, two contacts in series"
                                                       : "elastic line contact";
  if (b.rings != "elastic")
    return law + ", rigid rings";
  return law + ", elastic rings, " +
         (b.chock == "rigid"   ? "cup held"
          : b.chock == "round" ? "round housing"
                               : "block chock");
}

double largest_roller_load(const BearingQuestion &q)
{
  double radial = q.radial;
  for (const double load : q.loads)
    radial = std::max(radial, load);
  double bound = roller_load_bound(q.bearing, radial, q.tilt);
  if (q.axial != 0)
    bound =
        std::max(bound, roller_load_bound(q.bearing, std::abs(q.axial) / std::tan(q.bearing.cup_angle), q.tilt));
  return bound;
}

BearingStudy study_bearing(RunContext &run, const BearingParts &parts, const BearingQuestion &q)
{
  BearingStudy s;
  s.question               = q;
  s.parts                  = parts;
  s.parts.model.cage_angle = q.cage_angle;
  s.drive                  = drive_of(q, q.radial);
  StageTimer timer(run, "bearing " + q.bearing.name);
  auto rigid_parts          = s.parts.model;
  rigid_parts.rings         = {};
  rigid_parts.bearing.rings = "rigid";
  bearing::BearingAssembly assembly(s.parts.model), rigid(rigid_parts), iso(standard_model(q, "iso")),
      palmgren(standard_model(q, "palmgren"));
  std::vector<bearing::RingDrive> drives;
  for (const double load : q.loads)
    drives.push_back(drive_of(q, load));
  run.progress.at("bearing " + q.bearing.name, 0);
  s.curve          = assembly.curve(drives);
  s.standard_curve = iso.curve(drives);
  s.rigid_curve    = rigid.curve(drives);
  if (s.curve.failure)
    run.warn(fmt::format("bearing {}: {}; the curve ends at {} of {} loads", q.bearing.name, s.curve.failure->what,
                         s.curve.states.size(), drives.size()));
  run.progress.at("bearing " + q.bearing.name, 0.8);
  s.at             = solve_or_keep(run, s, assembly);
  s.standard       = iso.solve(s.drive);
  s.rigid          = rigid.solve(s.drive);
  s.tangent        = bearing::radial_tangent(s.at, s.drive);
  s.secant         = bearing::radial_secant(s.at);
  s.tangent_across = bearing::stiffness_along(s.at, s.drive, 1);

  s.slice_deviation = deviation_of_slices(s.parts, s.at.roller_load.maxCoeff());
  add_companions(s);
  add_arrangements(s, rigid_parts);
  add_checks(s, palmgren.solve(s.drive), model_name(rigid_parts.bearing));
  run.progress.at("bearing " + q.bearing.name, 1);
  return s;
}

double error_of(const BearingStudy &s, const StateNumber &number)
{
  const double value = number(s.at);
  if (s.companions.empty() || !(std::abs(value) > 0))
    return not_given;
  const auto change = [&](const StudyVariant &v) { return std::abs(number(v.at) / value - 1); };
  double sum = 0, support = 0;
  const std::size_t meshes = s.parts.companions.size();  // these come first; the others are other models
  for (std::size_t i = 0; i < s.companions.size(); ++i)
    sum += (i < meshes ? mesh_pair_safety : 1) * change(s.companions[i]);
  for (const StudyVariant &v : s.supports)
    support = std::max(support, change(v));
  return sum + support;
}
}  // namespace mill
