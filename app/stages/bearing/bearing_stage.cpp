#include "app/stages/bearing/bearing_stage.h"
#include "app/run/output_dir.h"
#include "app/stages/bearing/bearing_across.h"
#include "app/stages/bearing/bearing_files.h"
#include "app/stages/bearing/bearing_published.h"
#include "app/stages/bearing/bearing_ratings.h"
#include "app/stages/bearing/bearing_results.h"
#include "app/stages/bearing/oil_film_results.h"
#include "core/case/bearing_inputs.h"
#include "core/model/case.h"
#include "core/model/contact_settings.h"
#include "core/model/four_high.h"
#include "core/model/roll.h"
#include "core/model/seat_load.h"
#include "core/records/rows_of_bearing.h"
#include "dynamics/response/mill_model.h"
#include "reduce/stand/lumped_stand.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace mill {
namespace {
/// One of the four places of a bearing in the stand.
struct Seat {
  const char *name;     // of the result
  const char *section;  // of the case
  const Roll *roll;
  const ContactSettings *contact;
  bool backup, lower;
};

std::array<Seat, 4> seats_of(const FourHigh &s)
{
  return {{{"Kzc1", "backup_roll", &s.backup_roll, &s.upper_contact, true, false},
           {"Kzc2", "work_roll", &s.work_roll, &s.upper_contact, false, false},
           {"Kzc3", "work_roll", &s.work_roll, &s.lower_contact, false, true},
           {"Kzc4", "backup_roll", &s.backup_roll, &s.lower_contact, true, true}}};
}

SeatLoad load_of(const FourHigh &stand, const Seat &seat, const double F)
{
  return seat_load(stand, seat.backup, *seat.contact, F);
}

// Where the load of a seat comes from.
std::string source_of(const SeatLoad &load, const Seat &seat)
{
  if (load.given)
    return std::string(seat.section) + ".bearing_load";
  const std::string sideways =
      load.across > 0 ? fmt::format(" and {:.4g} kN across from the rolls' offset", load.across / 1e3) : "";
  if (seat.backup)
    return "half the rolling force" + std::string(load.bending > 0 ? ", bending added" : "") + sideways;
  if (load.bending > 0)
    return "the bending force of its chock" + sideways;
  return "a twentieth of the rolling force for balance and bending" + sideways;
}

// So many values over a range of so much around one, evenly spaced in the logarithm.
// @param below  share of the logarithm of the range below it
std::vector<double> spread_around(const double value, const double range, const double below)
{
  constexpr int n = 20;
  std::vector<double> values;
  for (int i = 0; i < n; ++i)
    values.push_back(value * std::pow(range, double(i) / (n - 1) - below));
  return values;
}

std::vector<double> around(const double load)
{
  return spread_around(load, 100, 0.6);
}

std::vector<double> around_speed(const double speed)
{
  return spread_around(speed, 16, 0.5);
}

/// The oil film of a seat under one pass; nullptr: the seat has a roller bearing.
const OilFilmBearing *film_of(const FourHigh &stand, const Seat &seat)
{
  return oil_film_of(stand.oil_films, seat.roll->bearing);
}

OilFilmQuestion film_question(const FourHigh &stand, const Seat &seat, const double load, const std::size_t pass)
{
  OilFilmQuestion q;
  q.bearing        = *film_of(stand, seat);
  q.surface_radius = seat.roll->barrel_diameter / 2;  // which rolls on the work roll without slip
  q.load           = {load, stand.passes[pass].speed / q.surface_radius, {0, 0}};
  q.speed_key      = fmt::format("pass.{}.speed", pass);
  if (pass == 0) {
    q.loads  = around(load);
    q.speeds = around_speed(q.load.speed);
  }
  return q;
}

/// Oil films of the backup rolls: stiffness along and across into `out`, the other results once, for the first
/// pass.
class FilmSeats {
public:
  FilmSeats(RunContext &context, const FourHigh &four_high) : run(context), stand(four_high) {}
  void solve(const Seat &seat, const std::size_t i, const std::size_t pass, const SeatLoad &load,
             StandBearings &out)
  {
    const auto key = std::pair(pass, load.value);  // the lower half has the same bearings
    if (!done.count(key))
      done[key] = study_oil_film(run, film_question(stand, seat, load.value, pass));
    const OilFilmStudy &study = done.at(key);
    const KeyList inputs      = seat_keys(*run.keys, i, pass);
    out.Kzc[i]                = film_stiffness(study, inputs);
    out.Kzc_across[i]         = film_stiffness(study, inputs, true);
    if (seat.backup)
      out.film_damper[i == 0 ? 0 : 1] = 2 * study.numbers.solution.at.damping(0, 0);
    if (pass > 0)
      return;
    run.results.add(row::bearing::tangent.of(seat.name), out.Kzc[i]);
    run.results.add(row::bearing::tangent_across.of(seat.name), out.Kzc_across[i]);
    if (warned)
      return;
    warned = true;
    add_oil_film_results(run, study, inputs, seat_keys(*run.keys, i, pass, {BearingAsks::least_speed}));
    write_oil_film(run, study);
    note_oil_film(run, study, true);
  }

private:
  RunContext &run;
  const FourHigh &stand;
  std::map<std::pair<std::size_t, double>, OilFilmStudy> done;
  bool warned = false;
};

Parameter both(Parameter bearing)
{
  bearing.value *= 2;
  bearing.method += ", two bearings";
  for (Check &check : bearing.checks)
    check.value *= 2;
  return bearing;
}

// Ratings and life are added once for a bearing that both rolls have, so that they state the keys of both seats.
KeyList rating_inputs(const RunContext &run, const FourHigh &stand, const std::string &bearing,
                      const ResultRow &row)
{
  KeyList inputs;
  const auto seats = seats_of(stand);
  for (const std::size_t i : {0u, 1u})
    if (seats[i].roll->bearing == bearing && !stand.given.count(seats[i].name))
      inputs = joined(std::move(inputs), seat_keys(*run.keys, i, 0, reading_of_bearing(row)));
  return inputs;
}

void report_seat(RunContext &run, const FourHigh &stand, const Seat &seat, const SeatLoad &load,
                 const BearingStudy &study, const KeysOfRow &inputs, const KeyList &of_closing_angle)
{
  add_bearing_results(run, seat.name, study, inputs, of_closing_angle);
  if (seat.lower)
    return;  // it has the same bearings as the upper half
  add_published_results(run, seat.name, study, inputs);
  add_rating_results(run, study,
                     [&](const ResultRow &row) { return rating_inputs(run, stand, seat.roll->bearing, row); });
  write_bearing(run, study);
  note_bearing(run, seat.name, study);
  const auto &bending = seat.roll->bending_force;
  if (!seat.backup && bending[0] != bending[1])
    run.assume(fmt::format(
        "work_roll.bending_force differs between the chocks: {} is that of a bearing under the mean", seat.name));
  if (load.assumed)
    run.assume(std::string(seat.section) + ".bearing_load is not given: " + source_of(load, seat));
}

// Where a bearing carries half the rolling force and nothing else.
bool follows_half_the_force(const FourHigh &stand, const Seat &seat)
{
  const SeatLoad load = load_of(stand, seat, 1);
  return seat.backup && !load.given && load.across == 0 && load.bending == 0;
}

// Both bearings of a roll over the rolling force.
reduce::LoadDeflection over_the_force(const BearingStudy &study)
{
  const auto n = Eigen::Index(study.curve.states.size());
  reduce::LoadDeflection both{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto &state  = study.curve.states[std::size_t(i)];
    both.load[i]       = 2 * study.question.loads[std::size_t(i)];
    both.deflection[i] = state.motion[0];
    both.tangent[i]    = 2 * bearing::radial_tangent(state, study.loading);
  }
  return both;
}
}  // namespace

void add_films(LumpedModel &chain, const FourHigh &stand, const std::array<double, 2> &damper,
               const reduce::ChainInputs &inputs)
{
  const auto given  = [&](const char *name) { return stand.given.count(name) > 0; };
  const double K[2] = {inputs.K_Zy_upper.value, inputs.K_Zy_lower.value};
  for (const std::size_t half : {0u, 1u})
    if (!given("K_Zy") && !given(half == 0 ? "K2" : "K6"))
      chain.film[half] = {K[half], damper[half]};
  dynamics::take_films(chain, stand.dynamics, [&](const double upper, const double lower) {
    reduce::ChainInputs moving     = inputs;
    moving.K_Zy_upper.value        = upper > 0 ? upper : inputs.K_Zy_upper.value;
    moving.K_Zy_lower.value        = lower > 0 ? lower : inputs.K_Zy_lower.value;
    const reduce::LumpedStand made = reduce::lumped_stand(stand, moving, reduce::StatedErrors::none);
    std::array<double, 6> masses{};
    for (std::size_t i = 0; i < masses.size(); ++i)
      masses[i] = made.model.M[i].value;
    return masses;
  });
}

std::vector<StandBearings> solve_bearings(RunContext &run, const FourHigh &stand,
                                          const std::vector<double> &forces)
{
  const auto seats = seats_of(stand);
  // One mesh per bearing, for the heaviest load that any pass puts on it.
  std::map<std::string, BearingParts> parts;
  std::map<std::string, double> largest;
  const auto question = [&](const Seat &seat, const double load, const bool curve) {
    BearingQuestion q;
    q.bearing = bearing_of(stand.bearings, seat.roll->bearing);
    q.radial  = load;
    q.speed   = stand.passes[0].speed / (M_PI * seat.roll->barrel_diameter);  // rolling on each other, no slip
    if (curve)
      q.loads = around(load);
    if (!seat.backup) {
      q.published       = stand.published;
      q.published_total = seat.name;
    }
    return q;
  };
  const auto is_given = [&](const Seat &seat) { return stand.given.count(seat.name) > 0; };
  for (const Seat &seat : seats)
    for (const double F : forces) {
      if (is_given(seat) || film_of(stand, seat))
        continue;
      double &bound = largest[seat.roll->bearing];
      const auto q  = question(seat, load_of(stand, seat, F).value, true);
      bound         = std::max(bound, bearing::largest_roller_load(q.bearing, q));
    }
  std::vector<IndependentStage> made;
  for (const auto &[name, bound] : largest)
    made.push_back([&stand, &part = parts[name], of = name, most = bound](RunContext &part_run) {
      const RollerBearing &b = bearing_of(stand.bearings, of);
      part                   = bearing_parts(part_run, b, most, supports_across(b));
    });
  run_side_by_side(run, std::move(made));
  std::vector<StandBearings> out(forces.size());
  FilmSeats films(run, stand);
  for (std::size_t p = 0; p < forces.size(); ++p) {
    std::map<std::string, BearingStudy> done;  // same bearing, same load
    std::map<std::string, Parameter> across;
    for (std::size_t i = 0; i < seats.size(); ++i) {
      const Seat &seat = seats[i];
      if (is_given(seat)) {
        out[p].Kzc[i] = stand.given.at(seat.name).parameter;
        continue;
      }
      const SeatLoad load = load_of(stand, seat, forces[p]);
      if (film_of(stand, seat)) {
        films.solve(seat, i, p, load, out[p]);
        continue;
      }
      const auto key = seat.roll->bearing + fmt::format(" {} {}", load.value, seat.backup);
      if (!done.count(key))
        done[key] = study_bearing(run, parts.at(seat.roll->bearing), question(seat, load.value, p == 0));
      const BearingStudy &study = done.at(key);
      const KeysOfRow inputs    = [&, i, p](const ResultRow &row) {
        return seat_keys(*run.keys, i, p, reading_of_bearing(row));
      };
      out[p].Kzc[i] = tangent_of(study, inputs(row::bearing::tangent));
      if (!across.count(key))
        across[key] = bearing_across(run, study);
      out[p].Kzc_across[i]        = across.at(key);
      out[p].Kzc_across[i].inputs = inputs(row::bearing::tangent_across);
      if (p == 0)
        report_seat(run, stand, seat, load, study, inputs, seat_closing_angle_keys(*run.keys, i));
      if (p == 0 && follows_half_the_force(stand, seat))
        out[p].backup_deflection[i == 0 ? 0 : 1] = over_the_force(study);
    }
    for (const auto &[key, study] : done)
      study.readings->keep(run);
    out[p].K_Zy_upper = both(out[p].Kzc[0]);
    out[p].K_Zy_lower = both(out[p].Kzc[3]);
  }
  return out;
}
}  // namespace mill
