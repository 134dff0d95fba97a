#include "app/stages/bearing/bearing_results.h"
#include "core/records/rows_of_bearing.h"
#include "reduce/bearing/chock_supports.h"
#include "reduce/bearing/clearance.h"
#include "reduce/bearing/geometry.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace mill {
namespace {
using bearing::ComparedNumber;

Parameter plain(const BearingStudy &s, const std::vector<std::string> &inputs)
{
  Parameter p;
  p.unit   = "N/m";
  p.method = model_name(s.question.bearing);
  p.at     = operating_point(s);
  p.inputs = inputs;
  return p;
}

// A number as a result, with the error of the study.
Parameter stated(const BearingStudy &s, const ComparedNumber &number, const std::vector<std::string> &inputs)
{
  Parameter p      = plain(s, inputs);
  p.value          = number.value;
  p.error_estimate = number.error;
  return p;
}

// The same number by the model of the standard, and by the other arrangements of the rows where the case does not
// say which one it is; their difference is not an error of the model.
std::vector<Check> comparisons(const BearingStudy &s, const ComparedNumber &number,
                               const bool of_arrangement = false)
{
  std::vector<Check> checks{{"ISO/TS 16281, rigid rings", number.standard, ""}};
  if (!of_arrangement || s.arrangements.empty())
    return checks;
  const RollerBearing &b = s.question.bearing;
  checks.push_back({"rows " + arrangement_name(b.arrangement, b.rows) + ", rigid rings", number.rigid, "assumed"});
  for (std::size_t i = 0; i < s.arrangements.size(); ++i)
    checks.push_back(
        {"rows " + s.arrangements[i].about + ", rigid rings", number.arrangements[i], "not excluded by the case"});
  return checks;
}

// A radial stiffness by the models that the case does not use.
std::vector<Check> other_models(const BearingStudy &s, const ComparedNumber &number)
{
  RollerBearing b         = s.question.bearing;
  const bool elastic      = b.rings == RingBodies::elastic;
  const std::string other = elastic ? "rigid rings" : "another law of one roller";
  std::vector<Check> checks{{"ISO/TS 16281, rigid rings", number.standard, other},
                            {"Palmgren, rigid rings", number.palmgren, other}};
  b.rings = RingBodies::rigid;
  if (elastic)
    checks.push_back({model_name(b), number.rigid, "the same rollers, rigid rings"});
  for (std::size_t i = 0; i < s.supports.size(); ++i)
    checks.push_back(
        {s.supports[i].about, number.supports[i], "a support that the case leaves open; part of the error"});
  return checks;
}
}  // namespace

Parameter tangent_of(const BearingStudy &s, const std::vector<std::string> &inputs)
{
  Parameter p = stated(s, s.numbers.tangent, inputs);
  p.checks    = other_models(s, s.numbers.tangent);
  return p;
}

Parameter across_of(const BearingStudy &s, const std::vector<std::string> &inputs)
{
  Parameter p = stated(s, s.numbers.tangent_across, inputs);
  p.method += ", across the load";
  p.checks = comparisons(s, s.numbers.tangent_across);
  return p;
}

namespace {
void add_closing_angle(RunContext &run, const std::string &prefix, const RollerBearing &b,
                       const std::vector<std::string> &inputs)
{
  Parameter p;
  p.value = closing_cup_angle(b);
  if (std::isnan(p.value))
    return;
  p.unit   = "rad";
  p.method = "cup angle at which roller, cup and cone share one apex, (5.1)";
  p.checks = {{"cup_angle of the case", b.cup_angle, "up to 0.5 deg apart are accepted"}};
  p.inputs = inputs;
  run.results.add(row::bearing::closing_cup_angle.of(prefix), p);
}

using Add = std::function<void(const ResultName &, const ComparedNumber &, bool, const std::string &)>;

void add_stiffnesses(const std::string &prefix, const BearingStudy &s, const Add &add)
{
  add(row::bearing::axial.of(prefix), s.numbers.axial, false, ", tangent along the axis, all other motions held");
  if (std::isfinite(s.question.bearing.width))  // else the places of the rows are not known
    add(row::bearing::tilting.of(prefix), s.numbers.tilting, true,
        ", tangent against tilt in the plane of the load, loads and imposed motions held");
}

// How the ring stands under what else acts on it.
void add_motions(const std::string &prefix, const BearingStudy &s, const Add &add)
{
  const BearingQuestion &q = s.question;
  if (std::isfinite(q.axial_displacement))
    add(row::bearing::axial_load.of(prefix), s.numbers.axial_load, true, ", under the imposed axial displacement");
  else if (q.axial != 0)
    add(row::bearing::axial_displacement.of(prefix), s.numbers.axial_displacement, true,
        ", of the inner ring from its concentric place");
  if (std::isfinite(q.moment))
    add(row::bearing::tilt.of(prefix), s.numbers.tilt, true, ", of the inner ring under the moment");
  else if (q.tilt != 0)
    add(row::bearing::moment.of(prefix), s.numbers.moment, true, ", that holds the imposed tilt");
}

void add_rollers(const std::string &prefix, const BearingStudy &s, const Add &add)
{
  const char *between = ", heaviest roller between its raceways";
  add(row::bearing::roller_secant.of(prefix), s.numbers.roller_secant, false, between);
  add(row::bearing::roller_tangent.of(prefix), s.numbers.roller_tangent, false, between);
  add(row::bearing::roller_max.of(prefix), s.numbers.roller_max, false, ", heaviest roller");
  const bool tilted = s.question.tilt != 0 || std::isfinite(s.question.moment);
  for (std::size_t r = 0; s.question.radial > 0 && r < s.numbers.row_share.size(); ++r)
    add(row::bearing::row_share.of(prefix, std::to_string(r + 1)), s.numbers.row_share[r], tilted, "");
  if (!(s.question.bearing.cup_angle > 0))
    return;
  for (std::size_t r = 0; r < s.numbers.row_axial.size(); ++r)
    add(row::bearing::row_axial.of(prefix, std::to_string(r + 1)), s.numbers.row_axial[r], true,
        ", axial force of the row on the cup");
  add(row::bearing::rib_max.of(prefix), s.numbers.rib_max, false, ", heaviest roller on the cone's rib");
}
}  // namespace

void add_bearing_results(RunContext &run, const std::string &prefix, const BearingStudy &s,
                         const KeysOfRow &inputs, const KeyList &of_closing_angle)
{
  const Add add = [&](const ResultName &name, const ComparedNumber &number, const bool of_arrangement,
                      const std::string &more) {
    Parameter p = stated(s, number, inputs(name.row()));
    p.unit      = name.row().unit;
    p.checks    = comparisons(s, number, of_arrangement);
    p.method += more;
    run.results.add(name, p);
  };
  run.results.add(row::bearing::tangent.of(prefix), tangent_of(s, inputs(row::bearing::tangent)));
  if (s.question.radial > 0) {
    Parameter secant = stated(s, s.numbers.secant, inputs(row::bearing::secant));
    secant.checks    = other_models(s, s.numbers.secant);
    run.results.add(row::bearing::secant.of(prefix), secant);
  }
  run.results.add(row::bearing::tangent_across.of(prefix), across_of(s, inputs(row::bearing::tangent_across)));
  add_stiffnesses(prefix, s, add);
  add_motions(prefix, s, add);
  add_rollers(prefix, s, add);
  const auto state = [&](const RowOf<1> &row, const double value, const std::string &more,
                         std::vector<Check> checks) {
    Parameter p = plain(s, inputs(row));
    p.value     = value;
    p.unit      = row.unit;
    p.checks    = std::move(checks);
    p.method += more;
    run.results.add(row.of(prefix), p);
  };
  state(row::bearing::heaviest_angle, s.numbers.heaviest_angle,
        ", of the heaviest roller from the line of the load", {});
  state(row::bearing::loaded_rollers, s.at.loaded_rollers.maxCoeff(),
        fmt::format(", in the fullest row; {} of {} in all rows", s.at.loaded_rollers.sum(),
                    s.at.roller_load.size()),
        {{"ISO/TS 16281, rigid rings", double(s.standard.loaded_rollers.maxCoeff()), ""}});
  add_closing_angle(run, prefix, s.question.bearing, of_closing_angle);
}

namespace {
// The assumed arrangement of the rows decides results: a warning states the range of these.
void warn_of_arrangement(RunContext &run, const std::string &prefix, const BearingStudy &s)
{
  const RollerBearing &b = s.question.bearing;
  if (!b.arrangement_assumed)
    return;
  const auto range = [&](const ComparedNumber &number, const char *format, const double unit) {
    double low = number.rigid, high = low;
    for (const double other : number.arrangements) {
      low  = std::min(low, other);
      high = std::max(high, other);
    }
    return fmt::format(fmt::runtime(format), unit * low, unit * high);
  };
  std::string others, shares;
  for (const bearing::StateVariant &v : s.arrangements)
    others += (others.empty() ? "" : "; ") + v.about;
  if (s.question.tilt == 0)
    shares = "the shares of the rows do not depend on it as long as nothing tilts";
  else
    for (std::size_t r = 0; r < s.numbers.row_share.size(); ++r)
      shares += fmt::format("{} {}: {}", shares.empty() ? "shares between rigid rings, row" : ", row", r + 1,
                            range(s.numbers.row_share[r], "{:.1f} .. {:.1f} %", 100));
  std::string tilting;
  if (std::isfinite(b.width))
    tilting =
        prefix + ".tilting between rigid rings: " + range(s.numbers.tilting, "{:.3g} .. {:.3g} kN m/mrad; ", 1e-6);
  const std::string key = "bearing." + b.name + ".arrangement";
  run.warn(
      {WarningId::bearing_arrangement,
       "bearing " + b.name,
       "arrangement is not given",
       fmt::format("{} is assumed, and {}.tilting, the axial forces of the rows and, under tilt, their shares "
                   "depend on it (alternatives: {}). {}{}",
                   arrangement_name(b.arrangement, b.rows), prefix, others, tilting, shares),
       fmt::format("give {} as the drawing shows it", key),
       {prefix},
       key});
}

void say_supports(RunContext &run, const std::string &prefix, const BearingStudy &s)
{
  const RollerBearing &b = s.question.bearing;
  if (s.supports.empty())
    return;
  std::string text = fmt::format("bearing.{} does not say how its chock is held: {}.tangent is {:.4g} kN/mm, {}",
                                 b.name, prefix, s.numbers.tangent.value / 1e6, bearing::support_name(b));
  for (std::size_t i = 0; i < s.supports.size(); ++i)
    text += fmt::format("; {:.4g} kN/mm, {}", s.numbers.tangent.supports[i] / 1e6, s.supports[i].about);
  run.assume(text + "; the largest difference is part of the error of every result of this bearing");
}
}  // namespace

void note_bearing(RunContext &run, const std::string &prefix, const BearingStudy &s)
{
  const RollerBearing &b = s.question.bearing;
  warn_of_arrangement(run, prefix, s);
  say_supports(run, prefix, s);
  for (const std::string &sentence : b.filled)
    run.assume(sentence);
  for (const std::string &sentence : s.parts.notes)
    run.assume("bearing " + b.name + ": " + sentence);
  if (std::isnan(b.pitch_diameter) && std::isfinite(bearing::pitch_diameter(b)))
    run.assume(
        fmt::format("bearing.{}.pitch_diameter is not given: {:.5g} mm, the mean of bore and outside diameter",
                    b.name, 1e3 * bearing::pitch_diameter(b)));
  const std::string subject = "bearing " + b.name;
  const int loaded          = s.at.loaded_rollers.maxCoeff();
  if (loaded <= 2)
    run.warn(
        {WarningId::bearing_few_rollers,
         subject,
         fmt::format("of {} rollers of a row {} carr{} {}", b.rollers_per_row, loaded, loaded == 1 ? "ies" : "y",
                     s.question.radial > 0 ? fmt::format("{:.4g} kN", s.question.radial / 1e3) : "the load"),
         fmt::format("with a clearance of {:.4g} mm the stiffness depends on the position of the cage",
                     1e3 * bearing::diametral_clearance(b)),
         "",
         {prefix}});
  const double heaviest = s.at.roller_load.maxCoeff();
  if (std::isfinite(b.roller_diameter) && std::isfinite(bearing::pitch_diameter(b))) {
    const double pressure = bearing::elastic_roller(b, heaviest, b.roller_diameter / 2).inner_peak_pressure;
    if (pressure > b.yield_pressure)
      run.warn({WarningId::bearing_yield,
                subject,
                fmt::format("the heaviest roller presses its inner raceway with {:.0f} MPa under {:.4g} kN",
                            pressure / 1e6, heaviest / 1e3),
                fmt::format("bearing.{}.yield_pressure is {:.0f} MPa, beyond which elastic stiffnesses end",
                            b.name, b.yield_pressure / 1e6),
                "",
                {prefix},
                "bearing." + b.name + ".yield_pressure"});
  }
  if (s.at.row_share.minCoeff() < 0)
    run.warn({WarningId::bearing_far_row,
              subject,
              fmt::format("the tilt loads a row on the far side (its share is {:.3g} %)",
                          100 * s.at.row_share.minCoeff()),
              "",
              "",
              {prefix}});
}
}  // namespace mill
