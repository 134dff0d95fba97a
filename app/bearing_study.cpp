#include "app/bearing_study.h"
#include "app/bearing_files.h"
#include <Eigen/LU>
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

double relative(const double other, const double value)
{
  return std::abs(other / value - 1);
}

// Load that the slices give where the contact elements give `load`, relative.
double deviation_of_slices(const BearingParts &parts, const double load)
{
  if (!parts.roller || !(load > 0) || load > largest_contact_load(parts))
    return 0;
  fem::RollerContact contact(*parts.roller, drop_of(parts.model.bearing));
  const auto state = contact.solve_load(load);
  return relative(bearing::roller_load(parts.model.roller, state.approach, 0).load, state.load);
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

double stiffness_along(const bearing::AssemblyState &state, const bearing::RingDrive &drive, const int axis)
{
  std::vector<int> free;
  int place = 0;
  for (int i = 0; i < 5; ++i)
    if (!drive.by_motion[std::size_t(i)] || i == axis) {
      if (i == axis)
        place = int(free.size());
      free.push_back(i);
    }
  const Eigen::MatrixXd K = state.tangent(free, free);
  return 1 / K.inverse()(place, place);
}

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
  s.parts.model.cage_angle = s.parts.coarse.cage_angle = q.cage_angle;
  s.drive                                              = drive_of(q, q.radial);
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
  s.tangent_across = stiffness_along(s.at, s.drive, 1);

  // What the result is known to: the roller's mesh, the rings' mesh for their part of the deflection, the slices.
  const double rigid_tangent = bearing::radial_tangent(s.rigid, s.drive);
  const double ring_part     = s.parts.ring_error * std::max(0., 1 - s.tangent / rigid_tangent);
  s.slice_deviation          = deviation_of_slices(s.parts, s.at.roller_load.maxCoeff());
  s.error_tangent = s.error_secant = ring_part + s.slice_deviation;
  const auto palmgren_at           = palmgren.solve(s.drive);
  const double iso_tangent         = bearing::radial_tangent(s.standard, s.drive);
  const double palmgren_tangent    = bearing::radial_tangent(palmgren_at, s.drive);
  if (s.parts.roller) {
    const auto coarse = bearing::BearingAssembly(s.parts.coarse).solve(s.drive);
    s.error_tangent += relative(bearing::radial_tangent(coarse, s.drive), s.tangent);
    s.error_secant += relative(bearing::radial_secant(coarse), s.secant);
  } else if (q.bearing.rings == "rigid") {
    // Without elements the spread of the published laws is how well the law of one roller is known.
    const bool is_iso = q.bearing.roller_law == "iso";
    s.error_tangent   = relative(is_iso ? palmgren_tangent : iso_tangent, s.tangent);
    s.error_secant    = relative(bearing::radial_secant(is_iso ? palmgren_at : s.standard), s.secant);
  }
  const std::string rings = q.bearing.rings == "elastic" ? "rigid rings" : "another law of one roller";
  s.tangent_checks.push_back({"ISO/TS 16281, rigid rings", iso_tangent, rings});
  s.tangent_checks.push_back({"Palmgren, rigid rings", palmgren_tangent, rings});
  s.secant_checks.push_back({"ISO/TS 16281, rigid rings", bearing::radial_secant(s.standard), rings});
  s.secant_checks.push_back({"Palmgren, rigid rings", bearing::radial_secant(palmgren_at), rings});
  if (q.bearing.rings == "elastic") {
    s.tangent_checks.push_back({model_name(rigid_parts.bearing), rigid_tangent, "the same rollers, rigid rings"});
    s.secant_checks.push_back(
        {model_name(rigid_parts.bearing), bearing::radial_secant(s.rigid), "the same rollers, rigid rings"});
  }
  run.progress.at("bearing " + q.bearing.name, 1);
  return s;
}

}  // namespace mill
