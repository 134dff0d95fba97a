#include "app/stages/stand/modulus_stage.h"
#include "app/run/curve_files.h"
#include "app/stages/contact/contact_model.h"
#include "app/stages/stand/gauge_results.h"
#include "app/stages/stand/mode_results.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/numerics/difference.h"
#include "core/numerics/mesh_pair.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_stand.h"
#include "fem/roll/contact_slope.h"
#include "reduce/chain/beam_shapes.h"
#include "reduce/chain/frame_closure.h"
#include "reduce/chain/line_contact.h"
#include "reduce/chain/mill_modulus.h"
#include "reduce/stand/six_masses.h"
#include "reduce/stand/stand_modes.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

namespace mill {
namespace {
using reduce::PathPart;

constexpr double width_step = 0.01;  // relative, of central differences
constexpr double force_step = 0.02;

Parameter made(const char *unit, const double value, const std::string &method, const OperatingPoint &load)
{
  Parameter p;
  p.unit   = unit;
  p.value  = value;
  p.method = method;
  p.at     = load;
  return p;
}

// One work roll on its contact line under a strip of this width.
reduce::BentWorkRoll bent(const FourHigh &stand, const Component *solid, const double width, const double K)
{
  const Roll &roll = stand.work_roll;
  if (solid)
    return {*solid, width / 2, K};
  return {reduce::foundation_shape({roll.barrel_length / 2, width / 2, K / roll.barrel_length,
                                    reduce::beam_section(barrel_section(roll), stand.steel).bending})};
}

}  // namespace

reduce::CylinderPair work_roll_pair(const FourHigh &stand)
{
  const double d = stand.work_roll.barrel_diameter;
  return {d, d, stand.work_roll.barrel_length, stand.steel};
}

namespace {
// What ends and profiles make of a line contact is seen on K3, where it was computed.
double error_of_closed_form(const FourHigh &stand, const Parameter *K3, const double load)
{
  if (K3)
    return difference(K3->value, reduce::line_contact(closed_form(stand), load).tangent);
  const auto laws = reduce::secant_laws(work_roll_pair(stand), load);
  return difference(laws.palmgren, laws.johnson);
}

}  // namespace

Parameter touching_work_rolls(const FourHigh &stand, const double load, const Parameter *K3)
{
  Parameter p      = made("N/m", reduce::line_contact(work_roll_pair(stand), load).tangent,
                          "Hertz line contact of both work rolls over the barrel (3.5b)", at_force(load));
  p.error_estimate = error_of_closed_form(stand, K3, load);
  return p;
}

double work_rolls_bending(const FourHigh &stand, const Component *solid, const double width, const double K3,
                          const double K5)
{
  double sum = 0;
  for (const double K : {K3, K5})
    sum += reduce::work_roll_bending(bent(stand, solid, width, K), K, stand.work_roll.barrel_length / 2,
                                     stand.dynamics.mass_reference);
  return sum;
}

namespace {
const Component *solid_work_roll(const FourHigh &stand, const ModulusParts &parts)
{
  return parts.solid && stand.backup_roll.bending_model == BendingModel::solid ? parts.solid.work_roll : nullptr;
}

// The modulus of one pass on its way into the results.
class Modulus {
public:
  Modulus(RunContext &context, const FourHigh &s, const ModulusParts &p)
      : run(context), stand(s), parts(p), operating_point(at_force(p.load))
  {
  }
  void add()
  {
    add_touching();
    if (!std::isnan(parts.K4.flattening.value)) {
      flattening = parts.K4.flattening;
      add_bending();
      add_with_strip();
      warn_unusual();
    } else if (parts.pass == 0)
      run.assume("K4 is given and does not contain the flattening at the strip: the mill modulus is that of work "
                 "rolls that touch each other");
    if (parts.pass == 0)
      write();
    if (!with_strip.empty())
      add_gauge(run, stand, parts.pass, parts.K4.plastic_slope, {stretch(true), of_strip});
  }

private:
  RunContext &run;
  const FourHigh &stand;
  const ModulusParts &parts;
  OperatingPoint operating_point;
  Parameter flattening;
  double bend = 0;  // m/N, both work rolls
  std::vector<PathPart> common, with_strip, touching;
  KeyList of_path, of_rolls, of_bending, of_strip;  // keys behind the springs of the chain and what joins them

  const Parameter &result(const std::string &name) const
  {
    const Parameter *p = run.results.find(name);
    if (!p)
      throw std::logic_error("the mill modulus comes before " + name);
    return *p;
  }
  // A spring of the chain at the load of this pass.
  const Parameter &spring(const std::string &name) const
  {
    return result(of_pass(name));
  }
  std::string of_pass(const std::string &name) const
  {
    return parts.pass == 0 ? name : result_name({stand.passes[parts.pass].name, name});
  }
  // A result of this stage for this pass.
  ResultName name_of(const RowOf<1> &row) const
  {
    return stand_result(stand, parts.pass, row);
  }
  double secant_of(const std::string &name, const double otherwise) const
  {
    const Parameter *p = run.results.find(of_pass(name));
    return p ? p->value : otherwise;
  }
  // A spring of the chain whose bearing deflects by its secant.
  double secant_with_bearing(const std::string &spring_name, const Parameter &K_Zy, const std::size_t seat) const
  {
    const double K = spring(spring_name).value;
    if (stand.given.count(spring_name) || stand.given.count("K_Zy"))
      return K;
    return 1 / (1 / K - 1 / K_Zy.value + 1 / secant_of_bearings(K_Zy, seat));
  }
  // Of both bearings; the tangent where neither the result of a bearing nor its curve is there.
  double secant_of_bearings(const Parameter &K_Zy, const std::size_t seat) const
  {
    if (parts.pass == 0)
      return 2 * secant_of(seat == 0 ? "Kzc1.secant" : "Kzc4.secant", K_Zy.value / 2);
    if (!has_curve(seat))
      return K_Zy.value;
    return parts.load / reduce::deflected_at((*parts.backup_deflection)[seat], parts.load).deflection;
  }
  bool has_curve(const std::size_t seat) const
  {
    return parts.backup_deflection && (*parts.backup_deflection)[seat].load.size() >= 2;
  }
  static PathPart part(const std::string &name, const Parameter &p, const double secant)
  {
    return {name, p.value, secant, p.error_estimate, p.error_lacks};
  }
  std::vector<PathPart> common_path() const
  {
    std::vector<PathPart> path;
    for (const char *name : {"K1", "K7"})
      path.push_back(part(name, spring(name), spring(name).value));
    path.push_back(part("K2", spring("K2"), secant_with_bearing("K2", parts.K_Zy[0], 0)));
    path.push_back(part("K6", spring("K6"), secant_with_bearing("K6", parts.K_Zy[1], 1)));
    for (const char *name : {"K3", "K5"})
      path.push_back(part(name, spring(name),
                          stand.given.count(name) ? spring(name).value
                                                  : secant_of(std::string(name) + ".secant", spring(name).value)));
    return path;
  }

  void add_contact_of_work_rolls();
  void add_touching();
  void add_bending();
  void add_with_strip();
  void add_by_width();
  void warn_unusual();
  void write();
  Parameter result_of(const reduce::MillModulus &m, const std::string &method, const bool tangent) const
  {
    Parameter p      = made("N/m", tangent ? m.tangent : m.secant, method, operating_point);
    p.error_estimate = m.error;
    p.error_lacks    = m.lacks;
    return p;
  }
  double error_of(const std::vector<PathPart> &path) const;
  void state_error(reduce::MillModulus &m, const std::vector<PathPart> &path) const;
  std::vector<PathPart> path_at(double F, bool strip) const;
  reduce::LoadDeflection stretch(bool strip) const;
  Check difference_of_stretch(bool strip) const;
};

void Modulus::add_contact_of_work_rolls()
{
  const double F     = parts.load;
  const auto contact = reduce::line_contact(work_roll_pair(stand), F);
  const auto laws    = reduce::secant_laws(work_roll_pair(stand), F);
  const auto stretch = [&](const double load) {
    return reduce::line_contact(work_roll_pair(stand), load).approach;
  };
  Parameter tangent = touching_work_rolls(stand, F, run.results.find(of_pass("K3.tangent")));
  tangent.inputs = of_rolls = touching_roll_keys(*run.keys, parts.pass);
  tangent.checks   = {{"differences of the approach (3.4)", 0.02 * F / (stretch(1.01 * F) - stretch(0.99 * F)),
                       "1 % of the force"}};
  Parameter secant = tangent;
  secant.value     = contact.secant;
  secant.method    = "Hertz line contact of both work rolls over the barrel (3.5a)";
  secant.checks = {{"Foeppl (3.8)", laws.foeppl, ""}, {"Palmgren (3.10)", laws.palmgren, "lower end of the band"}};
  run.results.add(name_of(row::stand::K_ww_tangent), tangent);
  run.results.add(name_of(row::stand::K_ww_secant), secant);
}

// The slope again, from secants: tangents do not enter.
Check Modulus::difference_of_stretch(const bool strip) const
{
  const double F = parts.load, d = force_step * F;
  const auto at_force = [&](const double force) {
    return force / reduce::mill_modulus(path_at(force, strip)).secant;
  };
  return {"differences of the stretch over the force", 2 * d / (at_force(F + d) - at_force(F - d)),
          "by the secants of all springs, 2 % of the force"};
}

// Where the frame follows a measured modulus, the springs in series do not err on their own: what one of them is
// softer the frame is stiffer.  Only what the path has in place of the touching work rolls adds to the error.
double Modulus::error_of(const std::vector<PathPart> &path) const
{
  if (!reduce::is_closed(stand.frame))
    return reduce::mill_modulus(path).error;
  const auto m = reduce::mill_modulus(path), closed = reduce::mill_modulus(touching);
  double error   = m.tangent / closed.tangent * stand.frame.modulus_error;  // (30.12)
  const auto add = [&](const std::vector<PathPart> &of, const std::vector<PathPart> &without) {
    for (const PathPart &part : of)
      if (std::none_of(without.begin(), without.end(), [&](const PathPart &p) { return p.name == part.name; }))
        error += m.tangent / part.tangent * part.error;
  };
  add(path, touching);
  add(touching, path);
  return error;
}

void Modulus::state_error(reduce::MillModulus &m, const std::vector<PathPart> &path) const
{
  m.error = error_of(path);
  if (!std::isnan(m.error))
    m.lacks.clear();
}

void Modulus::add_touching()
{
  add_contact_of_work_rolls();
  common = common_path();
  for (const char *name : {"K1", "K2", "K3", "K5", "K6", "K7"})
    of_path = joined(std::move(of_path), spring(name).inputs);
  touching = common;
  touching.push_back(part(name_of(row::stand::K_ww_tangent), result(name_of(row::stand::K_ww_tangent)),
                          result(name_of(row::stand::K_ww_secant)).value));
  auto m = reduce::mill_modulus(touching);
  state_error(m, touching);
  Parameter tangent = result_of(m, "K1, K2, K3, work rolls on each other, K5, K6, K7 in series (30.1)", true);
  tangent.checks.push_back(difference_of_stretch(false));
  Parameter secant = result_of(m, "screw-down of touching work rolls from zero force (30.2)", false);
  tangent.inputs = secant.inputs = joined(of_path, of_rolls);
  run.results.add(name_of(row::stand::modulus_kiss), tangent);
  run.results.add(name_of(row::stand::modulus_kiss_secant), secant);
}

void Modulus::add_bending()
{
  const double K3 = spring("K3").value, K5 = spring("K5").value, b = stand.strip.width;
  const Component *solid = solid_work_roll(stand, parts);
  bend                   = work_rolls_bending(stand, solid, b, K3, K5);
  of_bending             = joined(bent_work_roll_keys(*run.keys, true), spring("K3").inputs, spring("K5").inputs);
  of_strip               = joined(of_path, of_bending, bite_keys(*run.keys, parts.pass));
  if (!(bend * K3 > least_bending))
    return;  // the strip is as wide as the barrel
  Parameter p       = made("N/m", 1 / bend,
                           std::string("bending of both work rolls between strip and contact, ") +
                               (solid ? "rolls by finite elements" : "Euler beam on its contact line") + ", " +
                               word_of(stand.dynamics.mass_reference) + " reference (30.3)",
                           operating_point);
  const double beam = 1 / work_rolls_bending(stand, nullptr, b, K3, K5);
  if (parts.solid) {
    const double fine = 1 / work_rolls_bending(stand, parts.solid.work_roll, b, K3, K5);
    p.error_estimate =
        mesh_pair_error(fine, 1 / work_rolls_bending(stand, parts.solid.coarse_work_roll, b, K3, K5),
                        parts.solid.gain) +
        (solid ? 0 : difference(fine, beam));
    const double eK = 0.5 * (spring("K3").error_estimate + spring("K5").error_estimate);
    if (std::isnan(eK)) {  // given without a tolerance
      p.error_lacks    = {"K3", "K5"};
      p.error_estimate = not_given;
    } else {
      p.error_estimate +=
          difference(1 / work_rolls_bending(stand, solid, b, (1 + eK) * K3, (1 + eK) * K5), 1 / bend);
    }
    p.checks.push_back(solid ? Check{"Euler beam on its contact line (4.9)", beam, "no shear"}
                             : Check{"rolls by finite elements (22.13a)", fine, ""});
  } else
    p.error_lacks = {name_of(row::stand::K_bend)};
  p.inputs = of_bending;
  run.results.add(name_of(row::stand::K_bend), p);
}

std::vector<PathPart> Modulus::path_at(const double F, const bool strip) const
{
  std::vector<PathPart> path = strip ? with_strip : touching;
  const auto set             = [&](const std::string &name, const double tangent, const double secant) {
    for (PathPart &p : path)
      if (p.name == name) {
        p.tangent = tangent;
        p.secant  = secant;
      }
  };
  for (const auto &[name, curve] : {std::pair("K3", parts.upper), std::pair("K5", parts.lower)})
    if (curve && !stand.given.count(name)) {
      const auto slope = fem::slope_of(*curve, F);
      set(name, slope.tangent, slope.secant);
    }
  for (const std::size_t seat : {std::size_t(0), std::size_t(1)}) {
    const char *name = seat == 0 ? "K2" : "K6";
    if (stand.given.count(name) || stand.given.count("K_Zy") || !has_curve(seat))
      continue;
    const auto deflected = reduce::deflected_at((*parts.backup_deflection)[seat], F);
    const double rest    = 1 / spring(name).value - 1 / parts.K_Zy[seat].value;
    set(name, 1 / (rest + deflected.compliance), 1 / (rest + deflected.deflection / F));
  }
  const auto contact = reduce::line_contact(work_roll_pair(stand), F);
  set(name_of(row::stand::K_ww_tangent), contact.tangent, contact.secant);
  return path;
}

// Over the loads that both contacts were computed for.
reduce::LoadDeflection Modulus::stretch(const bool strip) const
{
  constexpr int n = 41;
  double low = 0.1 * parts.load, high = 2 * parts.load;
  for (const ContactCurve *curve : {parts.upper, parts.lower})
    if (curve) {
      low  = std::max(low, curve->load[0]);
      high = std::min(high, curve->load[curve->load.size() - 1]);
    }
  reduce::LoadDeflection all{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    const double F    = i == n - 1 ? high : low * std::pow(high / low, double(i) / (n - 1));
    const auto m      = reduce::mill_modulus(path_at(F, strip));
    all.load[i]       = F;
    all.deflection[i] = F / m.secant;
    all.tangent[i]    = m.tangent;
  }
  return all;
}

void Modulus::add_with_strip()
{
  with_strip = common;
  with_strip.push_back({"K4.flattening", flattening.value / 2, flattening.value / 2, flattening.error_estimate,
                        flattening.error_lacks});
  if (run.results.find(name_of(row::stand::K_bend)))
    with_strip.push_back(part(name_of(row::stand::K_bend), result(name_of(row::stand::K_bend)), 1 / bend));
  auto m = reduce::mill_modulus(with_strip);
  state_error(m, with_strip);
  const auto curve = stretch(true);
  const double F   = parts.load;
  Parameter tangent =
      result_of(m, "K1, K2, K3, flattening and bending of the work rolls, K5, K6, K7 in series (30.1)", true);
  for (const Check &gap : parts.gap)
    tangent.checks.push_back({gap.name + ", gap without the bite, in series with the flattening",
                              1 / (gap.value + 2 / flattening.value), gap.note});
  tangent.checks.push_back(difference_of_stretch(true));
  Parameter secant = result_of(m, "stretch of the stand from zero force (30.2)", false);
  // The tangents summed up from the smallest force of the curve, Simpson's rule over ln F.
  double sum            = curve.deflection[0];
  const auto compliance = [&](const double load) { return 1 / reduce::mill_modulus(path_at(load, true)).tangent; };
  constexpr int n       = 64;
  const double first = curve.load[0], h = std::log(F / first) / n;
  for (int i = 0; i <= n; ++i) {
    const double load = first * std::exp(i * h);
    sum += h / 3 * (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * load * compliance(load);
  }
  tangent.inputs = secant.inputs = of_strip;
  secant.checks.push_back({"tangents summed over the force", F / sum, "from the smallest force of the curve"});
  run.results.add(name_of(row::stand::modulus_tangent), tangent);
  run.results.add(name_of(row::stand::modulus_secant), secant);
  add_by_width();
}

void Modulus::add_by_width()
{
  const double K3 = spring("K3").value, K5 = spring("K5").value, b = stand.strip.width, step = width_step * b;
  const Component *solid = solid_work_roll(stand, parts);
  const double M         = result(name_of(row::stand::modulus_tangent)).value;
  const double slope     = bend * K3 > least_bending ? (work_rolls_bending(stand, solid, b + step, K3, K5) -
                                                    work_rolls_bending(stand, solid, b - step, K3, K5)) /
                                                       (2 * step)
                                                     : 0;
  const auto by_width    = [&](const double bending) {
    return reduce::modulus_by_width(M, flattening.value, b, bending);
  };
  Parameter p   = made("N/m2", by_width(slope),
                       "flattening and bending of the work rolls under another width, "
                         "same force and arc (30.10)",
                       operating_point);
  p.inputs      = of_strip;
  p.checks      = {{"flattening alone", by_width(0), "work rolls that do not bend"}};
  p.error_lacks = {"K4.flattening"};
  run.results.add(name_of(row::stand::modulus_by_width), p);
}

void Modulus::warn_unusual()
{
  if (parts.pass > 0)  // the same stand
    return;
  const auto m = reduce::mill_modulus(with_strip);
  if (m.tangent < reduce::least_usual_modulus || m.tangent > reduce::largest_usual_modulus)
    run.warn({WarningId::modulus_unusual,
              "",
              fmt::format("the mill modulus of {:.3g} MN/mm is outside the usual {:g} .. {:g} MN/mm",
                          m.tangent / 1e9, reduce::least_usual_modulus / 1e9, reduce::largest_usual_modulus / 1e9),
              fmt::format("the softest spring on the path of the force is {}, {:.3g} MN/mm", m.softest,
                          std::find_if(with_strip.begin(), with_strip.end(),
                                       [&](const PathPart &p) { return p.name == m.softest; })
                                  ->tangent /
                              1e9),
              "",
              {name_of(row::stand::modulus_tangent)}});
}

void Modulus::write()
{
  const auto add = [](Table &table, const std::string &prefix, const reduce::LoadDeflection &c) {
    table.add(prefix + "stretch", "m", c.deflection)
        .add(prefix + "tangent", "N/m", c.tangent)
        .add(prefix + "secant", "N/m", c.load.cwiseQuotient(c.deflection));
  };
  const auto closed = stretch(false);
  Table table;
  table.add("load", "N", closed.load);
  add(table, "kiss_", closed);
  if (!with_strip.empty())
    add(table, "", stretch(true));
  write_curve(run, curve::stand_modulus, "", table);
}
}  // namespace

std::vector<Check> gaps_of(const StandModels &models, const MassReference reference)
{
  std::vector<Check> gaps;
  for (const auto *s : {&models.craig_bampton, &models.beam}) {
    const StandModel path   = reduce::load_path(s->model);
    const Eigen::VectorXd y = reduce::static_displacement(path);
    const double gap =
        reference == MassReference::mean ? path.b.dot(y) : (path.points[2].row - path.points[3].row).dot(y);
    gaps.push_back({title_of(s->model.name), gap, "springs of the contact along the barrel"});
  }
  return gaps;
}

void add_stand_modulus(RunContext &run, const FourHigh &stand, const ModulusParts &parts)
{
  StageTimer timer(run, "modulus");
  Modulus(run, stand, parts).add();
}
}  // namespace mill
