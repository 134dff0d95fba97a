#include "app/stages/bearing/bearing_study.h"
#include "app/run/kept_part.h"
#include "app/stages/bearing/bearing_files.h"
#include "app/stages/bearing/bearing_store.h"
#include "core/base/files.h"
#include "core/model/case.h"
#include "core/process/parallel.h"
#include "reduce/bearing/rating_life.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill {
namespace {
bearing::BearingModel standard_model(const BearingQuestion &q, const OneRollerLaw law)
{
  auto model              = bearing::model_by_law(q.bearing, law);
  model.cage_angle        = q.cage_angle;
  model.centrifugal_force = q.centrifugal;
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
  model.cage_angle        = s.question.cage_angle;
  model.centrifugal_force = s.question.centrifugal;
  return bearing::BearingAssembly(std::move(model)).solve(s.loading);
}

// How well each ingredient of the model is known: the model without it, or with its neighbour.
std::vector<bearing::BearingVariant> companions_of(const BearingStudy &s)
{
  std::vector<bearing::BearingVariant> out = s.parts.companions;
  if (s.slice_deviation != 0) {
    out.push_back({"contact elements instead of slices", s.parts.model});
    out.back().model.roller = bearing::stiffened(s.parts.model.roller, 1 + s.slice_deviation);
  }
  if (!s.parts.roller)
    // Without elements the spread of the published laws is how well the law of one roller is known.
    out.push_back({"another law of one roller", bearing::with_neighbouring_law(s.parts.model)});
  return out;
}

std::vector<bearing::AssemblyState> solved_all(const RunContext &run, const BearingStudy &s,
                                               const std::vector<bearing::BearingVariant> &variants)
{
  std::vector<bearing::AssemblyState> states(variants.size());
  share_tasks(long(variants.size()), run.threads,
              [&](const long i) { states[std::size_t(i)] = solved(variants[std::size_t(i)].model, s); });
  return states;
}

std::vector<bearing::StateVariant> named(const std::vector<bearing::BearingVariant> &variants,
                                         std::vector<bearing::AssemblyState> &&states)
{
  std::vector<bearing::StateVariant> out;
  for (std::size_t i = 0; i < variants.size(); ++i)
    out.push_back({variants[i].about, std::move(states.at(i))});
  return out;
}

// The state at the working load; without one, the curve as far as it went is left behind.
bearing::AssemblyState solve_or_keep(RunContext &run, const BearingStudy &s, bearing::BearingAssembly &assembly)
{
  try {
    return assembly.solve(s.loading);
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

BearingQuestion question_of(const BearingCase &spec)
{
  BearingQuestion q;
  q.bearing            = bearing_of(spec.bearings, spec.load.bearing);
  q.radial             = spec.load.radial;
  q.axial              = spec.load.axial;
  q.tilt               = spec.load.tilt;
  q.cage_angle         = spec.load.cage_angle;
  q.axial_displacement = spec.load.axial_displacement;
  q.moment             = spec.load.moment;
  q.speed              = spec.load.speed;
  q.centrifugal        = std::isfinite(q.speed) ? bearing::centrifugal_force(q.bearing, q.speed) : 0;
  return q;
}

OperatingPoint operating_point(const BearingStudy &s)
{
  const BearingQuestion &q = s.question;
  OperatingPoint load_text = "no radial load";
  if (q.radial > 0)
    load_text = {"{} on one bearing", {{q.radial, "kN"}}};
  if (std::isfinite(q.axial_displacement))
    load_text.add(", {} along the axis", {{q.axial_displacement, "um", ".4g"}});
  else if (q.axial != 0)
    load_text.add(", {} axial", {{q.axial, "kN"}});
  if (std::isfinite(q.moment))
    load_text.add(", moment {}", {{q.moment, "kN m", ".4g"}});
  else if (q.tilt != 0)
    load_text.add(", tilted by {}", {{q.tilt, "mrad", ".4g"}});
  return load_text;
}

namespace {
std::string law_name(const OneRollerLaw law)
{
  switch (law) {
  case OneRollerLaw::fe:
    return "contact FEM of one roller";
  case OneRollerLaw::iso:
    return "ISO/TS 16281 laminae";
  case OneRollerLaw::palmgren:
    return "Palmgren, two contacts in series";
  case OneRollerLaw::elastic:
    return "elastic line contact";
  }
  return "";
}

std::string seat_name(const ChockForm chock)
{
  switch (chock) {
  case ChockForm::block:
    return "block chock";
  case ChockForm::round:
    return "round housing";
  case ChockForm::rigid:
    return "cup held";
  }
  return "";
}
}  // namespace

std::string model_name(const RollerBearing &b)
{
  if (b.rings != RingBodies::elastic)
    return law_name(b.roller_law) + ", rigid rings";
  return law_name(b.roller_law) + ", elastic rings, " + seat_name(b.chock);
}

namespace {
// Curves and working load by the model of the case, by the standard, and between rigid rings; then what each
// ingredient is known to.  The curve's failure is left in the study.
SolvedBearing solve_all(RunContext &run, BearingStudy &s)
{
  const BearingQuestion &q = s.question;
  SolvedBearing out;
  const auto rigid_model = bearing::with_rigid_rings(s.parts.model);
  std::vector<bearing::RingLoading> loadings;
  for (const double load : q.loads)
    loadings.push_back(bearing::drive_of(q, load));
  run.progress.at("bearing " + q.bearing.name, 0);
  bearing::AssemblyCurve standard_curve, rigid_curve;
  const auto by = [&](const bearing::BearingModel &model, bearing::AssemblyCurve &curve,
                      bearing::AssemblyState &state) {
    bearing::BearingAssembly assembly(model);
    curve = assembly.curve(loadings);
    state = assembly.solve(s.loading);
  };
  run_side_by_side(run,
                   {[&](RunContext &part_run) {
                      bearing::BearingAssembly assembly(s.parts.model);
                      s.curve = assembly.curve(loadings);
                      out.at  = solve_or_keep(part_run, s, assembly);
                    },
                    [&](RunContext &) { by(standard_model(q, OneRollerLaw::iso), standard_curve, out.standard); },
                    [&](RunContext &) { by(rigid_model, rigid_curve, out.rigid); }});
  run.progress.at("bearing " + q.bearing.name, 0.8);
  out.palmgren        = bearing::BearingAssembly(standard_model(q, OneRollerLaw::palmgren)).solve(s.loading);
  out.slice_deviation = s.slice_deviation = deviation_of_slices(s.parts, out.at.roller_load.maxCoeff());
  out.companions                          = solved_all(run, s, companions_of(s));
  out.supports                            = solved_all(run, s, s.parts.supports);
  out.arrangements                        = solved_all(run, s, bearing::other_arrangements(rigid_model));
  out.curve                               = s.curve.states;
  out.standard_curve                      = std::move(standard_curve.states);
  out.rigid_curve                         = std::move(rigid_curve.states);
  return out;
}

SolvedBearing solved_or_kept(RunContext &run, BearingStudy &s)
{
  const BearingQuestion &q = s.question;
  const std::string inputs = bearing_inputs_text(q, s.parts.roller ? s.parts.roller->setup.largest_load : 0);
  const std::string key    = hash_of(inputs);
  s.readings               = std::make_shared<BearingReadings>(run, inputs);
  // The next run has to say again that a curve ended.
  const auto whole = [&](const SolvedBearing &) { return !s.curve.failure; };
  return kept_part<SolvedBearing>(
      run, "bearing " + q.bearing.name, run.cache + "/bearing-" + key + ".bin", key,
      [&] { return solve_all(run, s); }, "bearing." + q.bearing.name + ".roller_law = \"iso\"", whole);
}
}  // namespace

BearingStudy study_bearing(RunContext &run, const BearingParts &parts, const BearingQuestion &q)
{
  BearingStudy s;
  s.question                      = q;
  s.parts                         = parts;
  s.parts.model.cage_angle        = q.cage_angle;
  s.parts.model.centrifugal_force = q.centrifugal;
  s.loading                       = bearing::drive_of(q, q.radial);
  SolvedBearing solved            = solved_or_kept(run, s);
  s.curve.states                  = std::move(solved.curve);
  s.standard_curve.states         = std::move(solved.standard_curve);
  s.rigid_curve.states            = std::move(solved.rigid_curve);
  if (s.curve.failure)
    run.warn({WarningId::bearing_curve_ends, "bearing " + q.bearing.name,
              fmt::format("the curve ends at {} of {} loads", s.curve.states.size(), q.loads.size()),
              s.curve.failure->what, s.curve.failure->remedy});
  s.at              = std::move(solved.at);
  s.standard        = std::move(solved.standard);
  s.palmgren        = std::move(solved.palmgren);
  s.rigid           = std::move(solved.rigid);
  s.slice_deviation = solved.slice_deviation;
  s.companions      = named(companions_of(s), std::move(solved.companions));
  s.meshes          = s.parts.companions.size();  // these come first; the others are other models
  s.supports        = named(s.parts.supports, std::move(solved.supports));
  s.arrangements =
      named(bearing::other_arrangements(bearing::with_rigid_rings(s.parts.model)), std::move(solved.arrangements));
  s.numbers = bearing::bearing_numbers(s, q.bearing.candidates);
  run.progress.at("bearing " + q.bearing.name, 1);
  return s;
}
}  // namespace mill
