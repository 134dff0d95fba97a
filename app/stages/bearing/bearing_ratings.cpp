#include "app/stages/bearing/bearing_ratings.h"
#include "app/stages/bearing/bearing_results.h"
#include "core/model/bearing_ratings.h"
#include "core/model/case.h"
#include "core/records/key_list.h"
#include "core/records/rows_of_bearing.h"
#include "reduce/bearing/geometry.h"
#include "reduce/bearing/rating_numbers.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using bearing::RatingNumbers;

/// Adds one number after the other under the bearing's name.
struct RatingResults {
  RunContext &run;
  const BearingStudy &study;
  const KeysOfRow &inputs;

  ResultName name(const RowOf<1> &row) const
  {
    return row.of(study.question.bearing.name);
  }
  Parameter &add(const RowOf<1> &row, const double value, const std::string &method, std::vector<Check> checks,
                 const double error = not_given)
  {
    Parameter p;
    p.value          = value;
    p.unit           = row.unit;
    p.method         = method;
    p.at             = operating_point(study);
    p.inputs         = inputs(row);
    p.checks         = std::move(checks);
    p.error_estimate = error;
    run.results.add(name(row), p);
    return run.results.values.back().second;
  }
};

// What an error of C lacks: a rating that does not come from these rollers, or the tolerances of the drawing.
std::vector<std::string> lacking_of_C(const RollerBearing &b)
{
  return keys_in("bearing." + b.name, std::isfinite(b.dynamic_rating)
                                          ? "dynamic_rating"
                                          : "rollers_per_row roller_diameter roller_length cup_angle");
}

void add_basic_ratings(RatingResults &out, const RollerBearing &b, const RatingNumbers &n)
{
  const std::string message =
      b.catalogue_source.empty() ? "rating of the case" : b.designation + ", " + b.catalogue_source;
  const auto one = [&](const RowOf<1> &row, const double value, const double error, const double published,
                       const double formula, const char *standard, std::vector<Check> checks) -> Parameter & {
    const bool by_maker = std::isfinite(published);
    if (by_maker)
      checks.insert(
          checks.begin(),
          {standard, formula, b.estimated.empty() ? "from the rollers" : "the rollers are estimated from it"});
    Parameter &p = out.add(row, value, by_maker ? message : std::string(standard) + " from the rollers, (5.29)",
                           checks, error);
    p.at         = {};
    if (by_maker)
      p.source = b.catalogue_source.empty() ? Source::given : Source::published;
    return p;
  };
  std::vector<Check> by_slices;
  if (n.load)
    by_slices.push_back({"load for 1e6 revolutions by slices", n.load->C_by_slices,
                         "P (L10r/1e6)^0.3: the solved loads of the rollers in place of the standard's"});
  Parameter &C = one(row::rating::C, n.C, n.C_error, b.dynamic_rating, n.by_formula.dynamic, "ISO 281", by_slices);
  if (std::isnan(n.C_error))
    C.error_lacks = lacking_of_C(b);
  one(row::rating::C0, n.C0, n.C0_error, b.static_rating, n.by_formula.static_rating, "ISO 76",
      {{"Hertz pressure 4000 MPa under the heaviest roller", n.C0_by_pressure,
        "five times the mean load of a roller"}});
}

void add_loads_and_safety(RatingResults &out, const RatingNumbers &n)
{
  out.add(
      row::rating::P, n.load->P, "ISO 281, equivalent load, (5.32)",
      {{"from the life by slices, C (L10r/1e6)^-0.3", n.slices.equivalent_load, "every roller's load counted"}},
      n.load->P_error);
  out.add(row::rating::S0, n.load->S0, "ISO 76, static safety C0/P0, (5.33)",
          {{"(4000 MPa over the heaviest roller's pressure)^2", n.load->S0_by_pressure,
            "solved load of the heaviest roller"},
           {"(yield_pressure over that pressure)^2", n.load->S0_by_yield, ""}},
          n.load->S0_error);
}

void add_lives(RatingResults &out, const RollerBearing &b, const RatingNumbers &n)
{
  const auto life = [&](const RowOf<1> &row, const double value, const std::string &method,
                        std::vector<Check> checks, const double error) {
    Parameter &p = out.add(row, value, method, std::move(checks), error);
    if (std::isnan(n.C_error))
      p.error_lacks = lacking_of_C(b);
  };
  std::vector<Check> checks{{"ISO/TS 16281, rigid rings", n.L10r_standard, ""},
                            {"without the factor of the ends", n.L10r_without_edge, ""},
                            {"with that of thin slices", n.L10r_thin_slices,
                             fmt::format("the factor of the ends is that of the {} slices", b.slices)}};
  constexpr int least_slices = 30;
  if (b.slices < least_slices)
    out.run.assume(fmt::format(
        "bearing.{}.slices is {}: ISO/TS 16281 takes at least {} slices for a life, since its factor of the ends "
        "applies to the last slice however wide it is; with thin slices L10r is {:.3g} times as long",
        b.name, b.slices, least_slices, n.L10r_thin_slices / n.slices.life));
  std::vector<Check> modified;
  const char *by_factor = "load of the rollers by a factor";
  if (n.load) {
    life(row::rating::L10, n.load->L10, "ISO 281, 1e6 (C/P)^(10/3) revolutions, (5.34)",
         {{"ISO/TS 16281 by slices", n.slices.life, "the solved load of every roller"}}, n.load->L10_error);
    checks.push_back({"ISO 281", n.load->L10, by_factor});
    modified.push_back({"ISO 281, a_ISO L10", n.load->L10mr, by_factor});
  }
  life(row::rating::L10r, n.slices.life,
       "ISO/TS 16281 by slices of every roller, revolutions, (5.37); " + model_name(b), checks, n.L10r_error);
  if (!std::isfinite(b.viscosity_ratio))
    out.run.assume(
        fmt::format("bearing.{}.viscosity_ratio is not given: 1 assumed in the modified life, known to a "
                    "factor of two",
                    b.name));
  if (!std::isfinite(b.contamination))
    out.run.assume(
        fmt::format("bearing.{}.contamination is not given: 0.3 assumed in the modified life, 0.2 .. 0.4 "
                    "of typical contamination (ISO 281)",
                    b.name));
  life(row::rating::L10mr, n.L10mr,
       fmt::format("ISO 281, a_ISO L10r revolutions with kappa {:.3g} and e_C {:.3g}, (5.39)", n.viscosity_ratio,
                   n.contamination),
       modified, n.L10mr_error);
}

void add_speeds(RatingResults &out, const RollerBearing &b)
{
  const double speed = out.study.question.speed;
  if (!(speed > 0)) {
    out.run.assume(fmt::format(
        "bearing.{}: the lives are in revolutions only, since the speed of the shaft is not "
        "known; give {} for hours",
        b.name, std::holds_alternative<FourHigh>(out.run.the_case.spec) ? "pass.speed" : "load.speed"));
    return;
  }
  const auto hours = [&](const RowOf<1> &in_revolutions, const RowOf<1> &in_time) {
    const Parameter *life = out.run.results.find(out.name(in_revolutions));
    if (!life)
      return;
    Parameter timed = *life;
    timed.value /= speed;
    timed.unit   = in_time.unit;
    timed.inputs = out.inputs(in_time);
    timed.method += fmt::format(", at {:.4g} turns of the shaft in a minute", 60 * speed);
    for (Check &check : timed.checks)
      check.value /= speed;
    out.run.results.add(out.name(in_time), timed);
  };
  hours(row::rating::L10, row::rating::L10_time);
  hours(row::rating::L10r, row::rating::L10r_time);
  hours(row::rating::L10mr, row::rating::L10mr_time);
  const double heaviest = out.study.at.roller_load.maxCoeff();
  out.add(row::rating::cage_speed, bearing::cage_speed(b, speed),
          "rolling without slip, shaft turning, cup at rest", {});
  out.add(row::rating::centrifugal_force, bearing::centrifugal_force(b, speed),
          "of one steel roller at the cage's speed", {{"heaviest roller", heaviest, "what it stands against"}});
}

// Numbers that are not printed, from those that are printed.
void add_estimates(RatingResults &out, const RollerBearing &b)
{
  if (b.candidates.empty())
    return;
  const auto one = [&](const RowOf<1> &row, const char *key, const double value, double RollerCandidate::*member) {
    if (std::find(b.estimated.begin(), b.estimated.end(), key) == b.estimated.end())
      return;
    const auto range = bearing::candidate_range(b.candidates, value, [&](const RollerCandidate &c) {
      return member ? c.*member : double(c.rollers_per_row);
    });
    Parameter &p =
        out.add(row, value, "from C and C0 of " + b.designation + ", (5.40), (5.41)",
                {{"least candidate", range.low, ""}, {"largest candidate", range.high, ""}}, range.error);
    p.source = Source::estimated;
    p.at     = {};
  };
  one(row::rating::rollers_per_row, "rollers_per_row", b.rollers_per_row, nullptr);
  one(row::rating::roller_diameter, "roller_diameter", b.roller_diameter, &RollerCandidate::roller_diameter);
  one(row::rating::roller_length, "roller_length", b.roller_length, &RollerCandidate::roller_length);
  one(row::rating::cup_angle, "cup_angle", b.cup_angle, &RollerCandidate::cup_angle);
  const auto range =
      bearing::candidate_range(b.candidates, 1, [](const RollerCandidate &c) { return c.stiffness; });
  Parameter &p = out.add(
      row::rating::stiffness_spread, stiffness_spread(b.candidates),
      fmt::format("largest distance of the radial stiffness with {} other sets of rollers, (5.30); "
                  "part of the errors of the stiffnesses",
                  b.candidates.size() - 1),
      {{"softest set over the one taken", range.low, ""}, {"stiffest set over the one taken", range.high, ""}});
  p.source = Source::estimated;
  p.at     = {};
}
}  // namespace

void add_rating_results(RunContext &run, const BearingStudy &s, const KeysOfRow &inputs)
{
  const RollerBearing &b = s.question.bearing;
  if (run.results.find(row::rating::C.of(b.name)))
    return;  // another seat of the same bearing
  if (!(b.roller_diameter > 0) || !(bearing::pitch_diameter(b) > 0)) {
    run.assume(
        fmt::format("bearing.{}: no ratings and no life without roller_diameter and a pitch diameter (or bore and "
                    "outside diameter)",
                    b.name));
    return;
  }
  RatingResults out{run, s, inputs};
  const RatingNumbers numbers = bearing::rating_numbers(b, s);
  add_estimates(out, b);
  add_basic_ratings(out, b, numbers);
  if (numbers.load)
    add_loads_and_safety(out, numbers);
  else
    run.assume(
        fmt::format("bearing.{}: neither radial nor axial load, therefore no equivalent load, no S0 and no L10; "
                    "the life by slices uses the load of every roller",
                    b.name));
  add_lives(out, b, numbers);
  add_speeds(out, b);
}
}  // namespace mill
