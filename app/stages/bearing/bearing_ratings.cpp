#include "app/stages/bearing/bearing_ratings.h"
#include "app/stages/bearing/bearing_results.h"
#include "core/case/provenance.h"
#include "core/model/bearing_ratings.h"
#include "core/model/case.h"
#include "core/records/rows_of_bearing.h"
#include "reduce/bearing/geometry.h"
#include "reduce/bearing/rating_life.h"
#include "reduce/bearing/ratings.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
// What represents the oil where the case does not say it, and how far it may be off.
constexpr double usual_viscosity = 1, usual_contamination = 0.3;

/// What every rating of one bearing is made from.
struct RatedBearing {
  const BearingStudy &study;
  const RollerBearing &bearing;
  Ratings by_formula;
  double C, C0;
  bearing::EquivalentLoads loads;

  explicit RatedBearing(const BearingStudy &s)
      : study(s), bearing(s.question.bearing), by_formula(ratings(bearing)),
        C(std::isfinite(bearing.dynamic_rating) ? bearing.dynamic_rating : by_formula.dynamic),
        C0(std::isfinite(bearing.static_rating) ? bearing.static_rating : by_formula.static_rating),
        loads(bearing::equivalent_loads(bearing, s.at.load.head<2>().norm(), s.at.load[2]))
  {
  }

  // A moment alone loads the rollers, and leaves no force but rounding.
  bool has_equivalent_load() const
  {
    return loads.dynamic > 1e-9 * study.at.roller_load.sum();
  }
  bearing::ReferenceLife life(const bearing::AssemblyState &state, const bool edge = true) const
  {
    return bearing::reference_life(bearing, state, C, edge);
  }
  double a_ISO(const double kappa, const double contamination, const double P) const
  {
    return bearing::life_factor(kappa, contamination,
                                bearing::fatigue_load_limit(C0, bearing::pitch_diameter(bearing)) / P);
  }
};

/// Adds one number after the other under the bearing's name.
struct RatingResults {
  RunContext &run;
  const BearingStudy &study;
  std::vector<std::string> inputs;

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
    p.inputs         = inputs;
    p.checks         = std::move(checks);
    p.error_estimate = error;
    run.results.add(name(row), p);
    return run.results.values.back().second;
  }
};

double ratio_error(const double a, const double b)
{
  return std::isfinite(a) && std::isfinite(b) && b != 0 ? std::abs(a / b - 1) : not_given;
}

/// A life goes with C^(10/3), (5.34): its relative error by that of C.
double life_error_of(const double error_of_C)
{
  return std::pow(1 + error_of_C, 10. / 3) - 1;
}

// Sizes of the drawing, whose tolerances are not stated.
std::vector<std::string> drawing_keys(const RollerBearing &b)
{
  return keys_in("bearing." + b.name, "rollers_per_row roller_diameter roller_length cup_angle");
}

void add_basic_ratings(RatingResults &out, const RatedBearing &r)
{
  const RollerBearing &b = r.bearing;
  const std::string message =
      b.catalogue_source.empty() ? "rating of the case" : b.designation + ", " + b.catalogue_source;
  const double from_hertz = bearing::radial_load_of_pressure(b, 4e9);
  const auto one = [&](const RowOf<1> &row, const double value, const double published, const double formula,
                       const char *standard, std::vector<Check> checks) {
    const bool by_maker = std::isfinite(published);
    if (by_maker)
      checks.insert(
          checks.begin(),
          {standard, formula, b.estimated.empty() ? "from the rollers" : "the rollers are estimated from it"});
    Parameter &p = out.add(row, value, by_maker ? message : std::string(standard) + " from the rollers, (5.29)",
                           checks, by_maker && b.estimated.empty() ? ratio_error(formula, published) : not_given);
    p.at         = {};
    if (by_maker)
      p.source = b.catalogue_source.empty() ? Source::given : Source::published;
    if (std::isnan(p.error_estimate))
      p.error_lacks = by_maker ? keys_in("bearing." + b.name, "dynamic_rating") : drawing_keys(b);
    return &p;
  };
  const auto life = r.life(r.study.at);
  std::vector<Check> by_slices;
  if (r.has_equivalent_load())
    by_slices.push_back({"load for 1e6 revolutions by slices", r.loads.dynamic * std::pow(life.life / 1e6, 0.3),
                         "P (L10r/1e6)^0.3: the solved loads of the rollers in place of the standard's"});
  one(row::rating::C, r.C, b.dynamic_rating, r.by_formula.dynamic, "ISO 281", by_slices);
  Parameter *C0 = one(
      row::rating::C0, r.C0, b.static_rating, r.by_formula.static_rating, "ISO 76",
      {{"Hertz pressure 4000 MPa under the heaviest roller", from_hertz, "five times the mean load of a roller"}});
  if (std::isnan(C0->error_estimate)) {
    C0->error_estimate = ratio_error(from_hertz, r.C0);
    C0->error_lacks.clear();
  }
}

void add_loads_and_safety(RatingResults &out, const RatedBearing &r)
{
  const auto life = r.life(r.study.at);
  out.add(row::rating::P, r.loads.dynamic, "ISO 281, equivalent load, (5.32)",
          {{"from the life by slices, C (L10r/1e6)^-0.3", life.equivalent_load, "every roller's load counted"}},
          ratio_error(life.equivalent_load, r.loads.dynamic));
  const double p =
      bearing::elastic_roller(r.bearing, r.study.at.roller_load.maxCoeff(), r.bearing.roller_diameter / 2)
          .inner_peak_pressure;
  const double S0   = r.C0 / r.loads.statics;
  const double safe = std::pow(4e9 / p, 2);
  out.add(row::rating::S0, S0, "ISO 76, static safety C0/P0, (5.33)",
          {{"(4000 MPa over the heaviest roller's pressure)^2", safe, "solved load of the heaviest roller"},
           {"(yield_pressure over that pressure)^2", std::pow(r.bearing.yield_pressure / p, 2), ""}},
          ratio_error(safe, S0));
}

// A life with the error of C added to its own; it lacks what C lacks.
void add_life(RatingResults &out, const RowOf<1> &row, const double value, const std::string &method,
              std::vector<Check> checks, const double own_error)
{
  const Parameter *C = out.run.results.find(out.name(row::rating::C));
  const double by_C  = life_error_of(C->error_estimate);
  const auto lacks   = C->error_lacks;
  Parameter &p       = out.add(row, value, method, std::move(checks), std::hypot(own_error, by_C));
  if (std::isnan(by_C))
    p.error_lacks = lacks;
}

// L10, where radial or axial load give an equivalent one, and L10r; the error of L10r without that of C is
// returned.
double add_basic_lives(RatingResults &out, const RatedBearing &r)
{
  const auto life   = r.life(r.study.at);
  const auto number = [&](const bearing::AssemblyState &state) { return r.life(state).life; };
  std::vector<Check> checks{{"ISO/TS 16281, rigid rings", number(r.study.standard), ""},
                            {"without the factor of the ends", r.life(r.study.at, false).life, ""}};
  double error = error_of(r.study, number);
  if (r.has_equivalent_load()) {
    const double L10 = bearing::basic_life(r.C, r.loads.dynamic);
    add_life(out, row::rating::L10, L10, "ISO 281, 1e6 (C/P)^(10/3) revolutions, (5.34)",
             {{"ISO/TS 16281 by slices", life.life, "the solved load of every roller"}},
             ratio_error(life.life, L10));
    checks.push_back({"ISO 281", L10, "load of the rollers by a factor"});
    error = std::max(std::isfinite(error) ? error : 0, ratio_error(L10, life.life));
  }
  add_life(out, row::rating::L10r, life.life,
           "ISO/TS 16281 by slices of every roller, revolutions, (5.37); " + model_name(r.bearing), checks, error);
  return error;
}

void add_modified_life(RatingResults &out, const RatedBearing &r, const double error_of_life)
{
  const RollerBearing &b = r.bearing;
  const auto life        = r.life(r.study.at);
  const bool known_oil = std::isfinite(b.viscosity_ratio), known_dirt = std::isfinite(b.contamination);
  const double kappa  = known_oil ? b.viscosity_ratio : usual_viscosity;
  const double dirt   = known_dirt ? b.contamination : usual_contamination;
  const auto modified = [&](const double k, const double e) {
    return r.a_ISO(k, e, life.equivalent_load) * life.life;
  };
  const double value = modified(kappa, dirt);
  double error       = std::isfinite(error_of_life) ? error_of_life : 0;
  if (!known_oil) {
    error +=
        std::max(ratio_error(modified(kappa / 2, dirt), value), ratio_error(modified(2 * kappa, dirt), value));
    out.run.assume(
        fmt::format("bearing.{}.viscosity_ratio is not given: 1 assumed in the modified life, known to a "
                    "factor of two",
                    b.name));
  }
  if (!known_dirt) {
    error += std::max(ratio_error(modified(kappa, 0.2), value), ratio_error(modified(kappa, 0.4), value));
    out.run.assume(
        fmt::format("bearing.{}.contamination is not given: 0.3 assumed in the modified life, 0.2 .. 0.4 "
                    "of typical contamination (ISO 281)",
                    b.name));
  }
  std::vector<Check> checks;
  if (r.has_equivalent_load())
    checks.push_back({"ISO 281, a_ISO L10",
                      r.a_ISO(kappa, dirt, r.loads.dynamic) * bearing::basic_life(r.C, r.loads.dynamic),
                      "load of the rollers by a factor"});
  add_life(out, row::rating::L10mr, value,
           fmt::format("ISO 281, a_ISO L10r revolutions with kappa {:.3g} and e_C {:.3g}, (5.39)", kappa, dirt),
           checks, error);
}

void add_speeds(RatingResults &out, const RatedBearing &r)
{
  const double speed     = r.study.question.speed;
  const RollerBearing &b = r.bearing;
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
    timed.unit = in_time.unit;
    timed.method += fmt::format(", at {:.4g} turns of the shaft in a minute", 60 * speed);
    for (Check &check : timed.checks)
      check.value /= speed;
    out.run.results.add(out.name(in_time), timed);
  };
  hours(row::rating::L10, row::rating::L10_time);
  hours(row::rating::L10r, row::rating::L10r_time);
  hours(row::rating::L10mr, row::rating::L10mr_time);
  const double heaviest = r.study.at.roller_load.maxCoeff();
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
    double low = value, high = value;
    for (const RollerCandidate &c : b.candidates) {
      const double other = member ? c.*member : double(c.rollers_per_row);
      low                = std::min(low, other);
      high               = std::max(high, other);
    }
    Parameter &p = out.add(row, value, "from C and C0 of " + b.designation + ", (5.40), (5.41)",
                           {{"least candidate", low, ""}, {"largest candidate", high, ""}},
                           std::max(high / value - 1, 1 - low / value));
    p.source     = Source::estimated;
    p.at         = {};
  };
  one(row::rating::rollers_per_row, "rollers_per_row", b.rollers_per_row, nullptr);
  one(row::rating::roller_diameter, "roller_diameter", b.roller_diameter, &RollerCandidate::roller_diameter);
  one(row::rating::roller_length, "roller_length", b.roller_length, &RollerCandidate::roller_length);
  one(row::rating::cup_angle, "cup_angle", b.cup_angle, &RollerCandidate::cup_angle);
  double low = 1, high = 1;
  for (const RollerCandidate &c : b.candidates) {
    low  = std::min(low, c.stiffness);
    high = std::max(high, c.stiffness);
  }
  Parameter &p =
      out.add(row::rating::stiffness_spread, stiffness_spread(b.candidates),
              fmt::format("largest distance of the radial stiffness with {} other sets of rollers, (5.30); "
                          "part of the errors of the stiffnesses",
                          b.candidates.size() - 1),
              {{"softest set over the one taken", low, ""}, {"stiffest set over the one taken", high, ""}});
  p.source = Source::estimated;
  p.at     = {};
}
}  // namespace

void add_rating_results(RunContext &run, const BearingStudy &s, const std::vector<std::string> &inputs)
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
  RatingResults out{run, s, joined(inputs, rating_keys(b))};
  const RatedBearing rated(s);
  add_estimates(out, b);
  add_basic_ratings(out, rated);
  if (rated.has_equivalent_load())
    add_loads_and_safety(out, rated);
  else
    run.assume(
        fmt::format("bearing.{}: neither radial nor axial load, therefore no equivalent load, no S0 and no L10; "
                    "the life by slices uses the load of every roller",
                    b.name));
  add_modified_life(out, rated, add_basic_lives(out, rated));
  add_speeds(out, rated);
}
}  // namespace mill
