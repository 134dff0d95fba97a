#include "app/export/exported_chatter.h"
#include "app/chatter/chatter_question.h"
#include "app/export/exported_stand.h"
#include "app/process/version.h"
#include "app/run/run_context.h"
#include "core/base/files.h"
#include "core/base/name_part.h"
#include "core/model/case.h"
#include "dynamics/chatter/equations.h"
#include "dynamics/chatter/run.h"
#include "dynamics/fmu/model_text.h"
#include "dynamics/fmu/unit_archive.h"
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using Eigen::MatrixXd, Eigen::VectorXd;

std::size_t condition_of(const ChatterCase &spec, const std::string &wanted)
{
  std::string names;
  for (std::size_t c = 0; c < spec.conditions.size(); ++c) {
    if (wanted.empty() || spec.conditions[c].name == name_part(wanted))
      return c;
    names += (c == 0 ? "\"" : ", \"") + spec.conditions[c].name + "\"";
  }
  throw InputError("--pass \"" + wanted + "\": the case has no condition of this name; it has " + names);
}

std::vector<double> by_rows(const MatrixXd &matrix)
{
  std::vector<double> all;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      all.push_back(matrix(i, j));
  return all;
}

// As exported units name it.
std::string scheme_name(const Linearisation scheme)
{
  return scheme == Linearisation::sequential ? "sequential"
         : scheme == Linearisation::implicit ? "implicit"
                                             : "frozen_friction";
}

fmu::PassData pass_data(const bite::RollBite &bite, const Linearisation scheme)
{
  const Strip &s = bite.strip;
  fmu::PassData p;
  p.entry_thickness   = s.entry_thickness;
  p.exit_thickness    = s.exit_thickness;
  p.entry_tension     = s.entry_tension;
  p.exit_tension      = s.exit_tension;
  p.width             = s.width;
  p.initial_thickness = std::isnan(s.initial_thickness) ? 0 : s.initial_thickness;
  p.roll_radius       = bite.roll_radius;
  p.roll_speed        = bite.roll_speed;
  p.youngs_modulus    = bite.roll.youngs_modulus;
  p.poisson_ratio     = bite.roll.poisson_ratio;
  p.scheme            = scheme_name(scheme);
  p.flow              = s.flow_stress;
  p.friction          = s.friction;
  return p;
}
}  // namespace

fmu::ChatterData chatter_data(const dynamics::ChatterStandModel &stand, const dynamics::WorkingPoint &point,
                              const Linearisation scheme, const dynamics::ChatterRunOptions &options,
                              const double start)
{
  const dynamics::StandStructure &s = stand.structure;
  const Eigen::LDLT<MatrixXd> mass(s.M);
  const auto list = [](const VectorXd &v) { return std::vector<double>(v.begin(), v.end()); };
  fmu::ChatterData c;
  c.stiffness = by_rows(mass.solve(s.K));
  c.damping   = by_rows(mass.solve(s.C));
  c.force_row = list(mass.solve(s.b));
  c.gap_row   = list(s.b);
  c.point     = by_rows(s.point);
  c.displaced = list(dynamics::displaced_rolls(s, 1).head(s.n()));
  for (const dynamics::RollContact &contact : options.contacts) {
    const VectorXd force = mass.solve(contact.row);
    c.contact_row.insert(c.contact_row.end(), contact.row.begin(), contact.row.end());
    c.contact_force_row.insert(c.contact_force_row.end(), force.begin(), force.end());
    c.contact_stiffness.push_back(contact.stiffness);
  }
  const dynamics::ChatterEquations equations(stand, point, scheme, options);
  const VectorXd unit = equations.magnitude();
  c.magnitude         = list(unit.cwiseMax(1e-9 * unit.maxCoeff() + 1e-300));
  c.longest_step      = 0.2 * M_PI * unit[0] / unit[s.n()];  // a tenth of the period of the rolls on the strip
  c.entry_distance    = stand.entry_distance;
  c.exit_distance     = stand.exit_distance;
  c.strip_modulus     = stand.strip_modulus;
  c.strip_density     = options.strip_density;
  c.start             = start;
  c.pass              = pass_data(point.bite, scheme);
  return c;
}

namespace {
// Twenty milliseconds of the nonlinear run, by CVODE; no force in addition to that of the bite.
fmu::CheckRun chatter_check(const dynamics::ChatterStandModel &stand, const dynamics::WorkingPoint &point,
                            const Linearisation scheme, dynamics::ChatterRunOptions options, const double start,
                            const std::vector<std::string> &points)
{
  options.duration = 0.02;
  options.rate     = 2000;
  const auto run =
      dynamics::nonlinear_run(stand, point, scheme, dynamics::displaced_rolls(stand.structure, start), options);
  const auto &h = run.history;
  fmu::CheckRun check;
  check.step      = 1 / options.rate;
  check.force     = VectorXd::Zero(h.time.size());
  check.agreement = 1e-4;
  check.names     = {"dh", "dF", "sigma_entry", "sigma_exit"};
  check.values.resize(h.time.size(), 4 + h.point.rows());
  check.values.col(0) = h.gap;
  check.values.col(1) = h.force;
  check.values.col(2) = h.entry_tension.array() + point.bite.strip.entry_tension;
  check.values.col(3) = h.exit_tension.array() + point.bite.strip.exit_tension;
  for (Eigen::Index p = 0; p < h.point.rows(); ++p) {
    check.names.push_back("y_" + points[std::size_t(p)]);
    check.values.col(4 + p) = h.point.row(p).transpose();
  }
  return check;
}

// Hz, of the stand without the bite.
double highest_frequency(const dynamics::StandStructure &stand)
{
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(stand.K, stand.M, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0., modes.eigenvalues().maxCoeff())) / (2 * M_PI);
}
}  // namespace

fmu::ExportedModel exported_chatter(const ChatterCase &spec, const std::string &condition, const Case &of)
{
  const std::size_t place = condition_of(spec, condition);
  const ChatterQuestion q = chatter_question(spec, place);
  const auto point        = dynamics::working_point(q.bite, q.condition.speed, q.scheme);
  dynamics::ChatterRunOptions options;
  if (q.stand.structure.n() == 6)
    options.contacts = dynamics::roll_contacts(q.stand.structure, point.state.force);
  fmu::ExportedModel model;
  model.identifier    = fmu::identifier_of(of.name);
  model.title         = of.title.empty() ? of.name : of.title;
  model.force_meaning = ForceMeaning::measured;
  model.program       = "millstand " + version();
  model.step          = held_step(1e4, highest_frequency(q.stand.structure));
  model.method        = "stand, bite and strip, " + q.structure;
  model.origin = fmt::format("case {}, condition {} at {:g} m/s", of.name, q.condition.name, q.condition.speed);
  for (const char *key : {"entry_thickness", "entry_tension", "exit_tension"})
    model.source[key] = fmt::format("condition.{}.{}", place, key);
  model.source["roll_speed"]         = fmt::format("condition.{}.speed", place);
  model.source["reduction"]          = fmt::format("condition.{}.exit_thickness", place);
  model.source["viscosity"]          = "oil.viscosity";
  model.source["start_displacement"] = "analysis.disturbance";
  fmu::ModelData &data               = model.data;
  data.kind                          = fmu::StandKind::chatter;
  data.runtime                       = fmu::runtime_version;
  for (std::string label : q.stand.structure.labels) {
    label = slug(label);
    std::replace(label.begin(), label.end(), '-', '_');
    data.points.push_back(label);
  }
  data.chatter = chatter_data(q.stand, point, q.scheme, options, q.analysis.disturbance);
  model.check  = chatter_check(q.stand, point, q.scheme, options, q.analysis.disturbance, data.points);
  data.guid    = fmu::identity_of(model);
  return model;
}
}  // namespace mill
