#include "app/stages/stand/modulus_stage.h"
#include "app/run/curve_files.h"
#include "app/stages/contact/contact_model.h"
#include "app/stages/stand/gauge_results.h"
#include "app/stages/stand/mode_results.h"
#include "core/case/modulus_inputs.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/numerics/difference.h"
#include "core/records/chain_number.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_bearing.h"
#include "core/records/rows_of_stand.h"
#include "fem/roll/contact_slope.h"
#include "reduce/stand/stand_modulus.h"
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <stdexcept>
#include <utility>

namespace mill {
namespace {
using reduce::PathSpring;

Parameter made(const char *unit, const double value, const std::string &method, const OperatingPoint &load)
{
  Parameter p;
  p.unit   = unit;
  p.value  = value;
  p.method = method;
  p.at     = load;
  return p;
}

}  // namespace

Parameter touching_work_rolls(const FourHigh &stand, const double load, const Parameter *K3)
{
  const auto rolls = reduce::touching_work_rolls(
      stand, load, K3 ? difference(K3->value, reduce::line_contact(closed_form(stand), load).tangent) : not_given);
  Parameter p = made("N/m", rolls.contact.tangent, "Hertz line contact of both work rolls over the barrel (3.5b)",
                     at_force(load));
  p.error_estimate = rolls.error;
  return p;
}

namespace {
// The modulus of one pass on its way into the results.
class Modulus {
public:
  Modulus(RunContext &context, const FourHigh &s, const ModulusParts &p)
      : run(context), stand(s), parts(p), operating_point(at_force(p.load))
  {
  }
  void add()
  {
    add_contact_of_work_rolls();
    add_touching();
    if (!std::isnan(parts.K4.flattening.value)) {
      add_bending();
      add_with_strip();
      if (parts.pass == 0)  // the same stand in every pass
        warn_unusual();
    } else if (parts.pass == 0)
      run.assume("K4 is given and does not contain the flattening at the strip: the mill modulus is that of work "
                 "rolls that touch each other");
    if (parts.pass == 0)
      write();
    if (with_strip)
      add_gauge(run, stand, parts.pass, parts.K4.plastic_slope, {with_strip->stretch, of_strip});
  }

private:
  RunContext &run;
  const FourHigh &stand;
  const ModulusParts &parts;
  OperatingPoint operating_point;
  std::vector<PathSpring> touching;
  reduce::BendingSpring bending;
  reduce::PathModulus closed;  // work rolls on each other
  std::optional<reduce::PathModulus> with_strip;
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
  // Of both bearings over the rolling force; null: not known.
  const reduce::LoadDeflection *bearing_curve(const std::size_t seat) const
  {
    const auto *seats = parts.backup_deflection;
    return seats && (*seats)[seat].load.size() >= 2 ? &(*seats)[seat] : nullptr;
  }
  // Of both bearings; the tangent where neither the result of a bearing nor its curve is there.
  double secant_of_bearings(const std::size_t seat) const
  {
    const double K_Zy = parts.K_Zy[seat].value;
    if (parts.pass == 0) {
      const char *bearing     = word_of(seat == 0 ? ChainNumber::Kzc1 : ChainNumber::Kzc4);
      const Parameter *secant = run.results.find(row::bearing::secant.of(bearing));
      return secant ? 2 * secant->value : K_Zy;
    }
    const auto *curve = bearing_curve(seat);
    return curve ? parts.load / reduce::deflected_at(*curve, parts.load).deflection : K_Zy;
  }
  static PathSpring part(const std::string &name, const Parameter &p, const double secant)
  {
    return {{name, p.value, secant, p.error_estimate, p.error_lacks}, {}};
  }
  PathSpring constant(const std::string &name) const
  {
    return part(name, spring(name), spring(name).value);
  }
  PathSpring with_bearings(const std::string &name, const std::size_t seat) const
  {
    if (stand.given.count(name) || stand.given.count("K_Zy"))
      return constant(name);
    return reduce::spring_with_bearings(constant(name), parts.K_Zy[seat].value, secant_of_bearings(seat),
                                        bearing_curve(seat));
  }
  PathSpring of_contact(const ChainNumber number, const SolvedContact *solved) const
  {
    PathSpring contact = constant(word_of(number));
    if (!solved)
      return contact;
    contact.secant    = solved->secant[parts.pass].value;
    contact.at_others = [solved](const double force) {
      const auto slope = fem::slope_of(solved->curve, force);
      return reduce::SpringAtForce{slope.tangent, slope.secant};
    };
    return contact;
  }
  static const ContactCurve *curve_of(const SolvedContact *solved)
  {
    return solved ? &solved->curve : nullptr;
  }
  reduce::PathModulus modulus_of(const std::vector<PathSpring> &path) const
  {
    return reduce::path_modulus(path, touching, stand.frame, parts.load,
                                {curve_of(parts.upper), curve_of(parts.lower)});
  }

  void add_contact_of_work_rolls();
  void add_touching();
  void add_bending();
  void add_with_strip();
  void warn_unusual();
  void write();
  Parameter result_of(const reduce::MillModulus &m, const std::string &method, const bool tangent) const
  {
    Parameter p      = made("N/m", tangent ? m.tangent : m.secant, method, operating_point);
    p.error_estimate = m.error;
    p.error_lacks    = m.lacks;
    return p;
  }
};

// Both contacts may have samples at this one force only.
void check_by_differences(Parameter &tangent, const reduce::PathModulus &m)
{
  if (!std::isnan(m.by_differences))
    tangent.checks.push_back({"differences of the stretch over the force", m.by_differences,
                              "by the secants of all springs, 2 % of the force"});
}

void Modulus::add_contact_of_work_rolls()
{
  const auto rolls = reduce::touching_work_rolls(stand, parts.load, not_given);
  Parameter tangent =
      touching_work_rolls(stand, parts.load, parts.upper ? &parts.upper->tangent[parts.pass] : nullptr);
  tangent.inputs = of_rolls = touching_roll_keys(*run.keys, parts.pass);
  tangent.checks            = {{"differences of the approach (3.4)", rolls.by_differences, "1 % of the force"}};
  Parameter secant          = tangent;
  secant.value              = rolls.contact.secant;
  secant.method             = "Hertz line contact of both work rolls over the barrel (3.5a)";
  secant.checks             = {{"Foeppl (3.8)", rolls.laws.foeppl, ""},
                               {"Palmgren (3.10)", rolls.laws.palmgren, "lower end of the band"}};
  run.results.add(name_of(row::stand::K_ww_tangent), tangent);
  run.results.add(name_of(row::stand::K_ww_secant), secant);
}

void Modulus::add_touching()
{
  for (const char *name : {"K1", "K2", "K3", "K5", "K6", "K7"})
    of_path = joined(std::move(of_path), spring(name).inputs);
  const std::string K_ww    = name_of(row::stand::K_ww_tangent);
  touching                  = {constant("K1"),
                               constant("K7"),
                               with_bearings("K2", 0),
                               with_bearings("K6", 1),
                               of_contact(ChainNumber::K3, parts.upper),
                               of_contact(ChainNumber::K5, parts.lower),
                               part(K_ww, result(K_ww), result(name_of(row::stand::K_ww_secant)).value)};
  touching.back().at_others = [this](const double force) {
    const auto contact = reduce::line_contact(reduce::work_roll_pair(stand), force);
    return reduce::SpringAtForce{contact.tangent, contact.secant};
  };
  closed = modulus_of(touching);
  Parameter tangent =
      result_of(closed.modulus, "K1, K2, K3, work rolls on each other, K5, K6, K7 in series (30.1)", true);
  check_by_differences(tangent, closed);
  Parameter secant = result_of(closed.modulus, "screw-down of touching work rolls from zero force (30.2)", false);
  tangent.inputs = secant.inputs = joined(of_path, of_rolls);
  run.results.add(name_of(row::stand::modulus_kiss), tangent);
  run.results.add(name_of(row::stand::modulus_kiss_secant), secant);
}

void Modulus::add_bending()
{
  const Parameter K3 = spring("K3"), K5 = spring("K5");
  bending    = reduce::bending_spring(stand, parts.solid, K3, K5);
  of_bending = joined(bent_work_roll_keys(*run.keys, true), K3.inputs, K5.inputs);
  of_strip   = joined(of_path, of_bending, bite_keys(*run.keys, parts.pass));
  if (!bending.bends)
    return;
  const ResultName name = name_of(row::stand::K_bend);
  Parameter p           = made("N/m", 1 / bending.compliance,
                               std::string("bending of both work rolls between strip and contact, ") +
                                   (bending.meshed ? "rolls by finite elements" : "Euler beam on its contact line") + ", " +
                                   word_of(stand.dynamics.mass_reference) + " reference (30.3)",
                               operating_point);
  p.error_estimate      = bending.error;
  p.error_lacks         = parts.solid ? bending.lacks : KeyList{name};
  if (parts.solid)
    p.checks.push_back(bending.meshed ? Check{"Euler beam on its contact line (4.9)", bending.beam, "no shear"}
                                      : Check{"rolls by finite elements (22.13a)", bending.solid, ""});
  p.inputs = of_bending;
  run.results.add(name, p);
}

void Modulus::add_with_strip()
{
  const Parameter &flattening = parts.K4.flattening;
  auto path                   = touching;
  path.back() = {{"K4.flattening", flattening.value / 2, flattening.value / 2, flattening.error_estimate,
                  flattening.error_lacks},
                 {}};
  if (bending.bends)
    path.push_back(part(name_of(row::stand::K_bend), result(name_of(row::stand::K_bend)), 1 / bending.compliance));
  with_strip = modulus_of(path);
  Parameter tangent =
      result_of(with_strip->modulus,
                "K1, K2, K3, flattening and bending of the work rolls, K5, K6, K7 in series (30.1)", true);
  for (const Check &gap : parts.gap)
    tangent.checks.push_back({gap.name + ", gap without the bite, in series with the flattening",
                              1 / (gap.value + 2 / flattening.value), gap.note});
  check_by_differences(tangent, *with_strip);
  Parameter secant = result_of(with_strip->modulus, "stretch of the stand from zero force (30.2)", false);
  tangent.inputs = secant.inputs = of_strip;
  secant.checks.push_back(
      {"tangents summed over the force", with_strip->by_tangents, "from the smallest force of the curve"});
  run.results.add(name_of(row::stand::modulus_tangent), tangent);
  run.results.add(name_of(row::stand::modulus_secant), secant);
  const auto by_width = [&](const double slope) {
    return reduce::modulus_by_width(with_strip->modulus.tangent, parts.K4.flattening.value, stand.strip.width,
                                    slope);
  };
  Parameter p   = made("N/m2", by_width(bending.by_width),
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
  const auto &m = with_strip->modulus;
  if (m.tangent < reduce::least_usual_modulus || m.tangent > reduce::largest_usual_modulus)
    run.warn({WarningId::modulus_unusual,
              "",
              fmt::format("the mill modulus of {:.3g} MN/mm is outside the usual {:g} .. {:g} MN/mm",
                          m.tangent / 1e9, reduce::least_usual_modulus / 1e9, reduce::largest_usual_modulus / 1e9),
              fmt::format("the softest spring on the path of the force is {}, {:.3g} MN/mm", m.softest,
                          m.softest_tangent / 1e9),
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
  Table table;
  table.add("load", "N", closed.stretch.load);
  add(table, "kiss_", closed.stretch);
  if (with_strip)
    add(table, "", with_strip->stretch);
  write_curve(run, curve::stand_modulus, "", table);
}
}  // namespace

std::vector<Check> gaps_of(const StandModels &models, const MassReference reference)
{
  std::vector<Check> gaps;
  for (const auto *s : {&models.craig_bampton, &models.beam})
    gaps.push_back({title_of(s->model.name), reduce::gap_opening(s->model, reference),
                    "springs of the contact along the barrel"});
  return gaps;
}

void add_stand_modulus(RunContext &run, const FourHigh &stand, const ModulusParts &parts)
{
  StageTimer timer(run, "modulus");
  Modulus(run, stand, parts).add();
}
}  // namespace mill
