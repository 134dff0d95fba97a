#include "core/case/roller_bearing_inputs.h"
#include "core/model/bearing_ratings.h"
#include "core/records/record_text.h"
#include "core/records/rows_of_bearing.h"
#include <cmath>
#include <map>
#include <optional>

namespace mill {
namespace {
std::string word_or_none(const std::optional<BearingType> &type)
{
  return type ? word_of(*type) : "";
}

// Sets the members that are not read back to those of a bearing that does not give them.
struct Unread {
  RollerBearing &bearing;
  RollerBearing none = {};
  template <class... Members> void operator()(const bool unread, const Members... members)
  {
    if (unread)
      ((bearing.*members = none.*members), ...);
  }
};

}  // namespace

BearingReading reading_of_bearing(const ResultRow &row)
{
  static const std::map<const ResultRow *, BearingReading> others{
      {&row::bearing::tangent_across, {BearingAsks::across}},
      {&row::bearing::tilting, {BearingAsks::tilting}},
      {&row::bearing::row_share, {BearingAsks::row_share}},
      {&row::bearing::row_axial, {BearingAsks::row_axial}},
      {&row::bearing::rib_max, {BearingAsks::rib}},
      {&row::bearing::load_that_fits_tangent, {BearingAsks::fitted_load}},
      {&row::bearing::load_that_fits_secant, {BearingAsks::fitted_load}},
      {&row::rating::C, {BearingAsks::dynamic_rating}},
      {&row::rating::C0, {BearingAsks::static_rating}},
      {&row::rating::P, {BearingAsks::equivalent_load}},
      {&row::rating::S0, {BearingAsks::safety}},
      {&row::rating::L10, {BearingAsks::basic_life}},
      {&row::rating::L10r, {BearingAsks::life_by_slices}},
      {&row::rating::L10mr, {BearingAsks::modified_life}},
      {&row::rating::L10_time, {BearingAsks::basic_life, true}},
      {&row::rating::L10r_time, {BearingAsks::life_by_slices, true}},
      {&row::rating::L10mr_time, {BearingAsks::modified_life, true}},
      {&row::rating::cage_speed, {BearingAsks::cage_speed}},
      {&row::rating::centrifugal_force, {BearingAsks::centrifugal_force}},
      {&row::rating::rollers_per_row, {BearingAsks::estimate}},
      {&row::rating::roller_diameter, {BearingAsks::estimate}},
      {&row::rating::roller_length, {BearingAsks::estimate}},
      {&row::rating::cup_angle, {BearingAsks::estimate}},
      {&row::rating::stiffness_spread, {BearingAsks::estimate}}};
  const auto it = others.find(&row);
  return it == others.end() ? BearingReading() : it->second;
}

LoadForm form_of(const BearingLoad &load)
{
  return {load.tilt != 0 || std::isfinite(load.moment), load.axial != 0 || std::isfinite(load.axial_displacement),
          std::isfinite(load.speed) && load.speed != 0};
}

namespace {
// As the closed form takes it: between rigid rings, laminae in the place of finite elements.
RollerBearing of_closed_form(RollerBearing bearing)
{
  if (bearing.roller_law == OneRollerLaw::fe)
    bearing.roller_law = OneRollerLaw::iso;
  bearing.rings = RingBodies::rigid;
  return bearing;
}

RollerBearing as_solved(const RollerBearing &bearing, const BearingReading &reading)
{
  return reading.closed_form ? of_closed_form(bearing) : bearing;
}

// Parts of a bearing that one result under one form of load reads.
struct PartsRead {
  bool fe, elastic, drawn;       // the model
  bool tapered, three, rounded;  // the rollers
  bool arms, rib, slices, hands;
  bool sized, pitch, rings;  // sizes of the rollers, of their circle, of the rings
};

// A thrust of rollers at their cage's speed needs both diameters.
bool rollers_turn(const RollerBearing &b, const LoadForm &form)
{
  return form.turns && std::isfinite(b.roller_diameter) && std::isfinite(pitch_diameter(b));
}

PartsRead parts_of(const RollerBearing &b, const BearingAsks asks, const LoadForm &form)
{
  using A = BearingAsks;
  PartsRead p{};
  p.fe                 = b.roller_law == OneRollerLaw::fe;
  p.elastic            = b.rings == RingBodies::elastic;
  p.drawn              = p.fe || p.elastic;
  p.tapered            = b.type == BearingType::four_row_tapered;
  p.three              = b.profile == RollerProfile::three_parameter;
  p.rounded            = b.profile == RollerProfile::log || b.profile == RollerProfile::lundberg || p.three;
  p.arms               = form.tilts || asks == A::tilting;
  const bool by_slices = asks == A::life_by_slices || asks == A::modified_life, turn = rollers_turn(b, form);
  // What the cone carries is less than the load of the cup by what the rib takes.
  p.rib    = p.tapered && (asks == A::rib || by_slices || turn);
  p.slices = p.drawn || p.arms || by_slices || b.profile != RollerProfile::none;
  p.hands  = p.tapered && (p.drawn || p.arms || form.pushes || asks == A::row_axial);
  p.rings  = p.drawn || b.roller_law == OneRollerLaw::elastic;
  p.sized  = p.rings || p.rounded || turn;
  p.pitch  = p.sized || (p.arms && p.tapered);
  return p;
}
}  // namespace

BearingInputs inputs_of_bearing(const RollerBearing &as_given, const BearingReading &reading, const LoadForm &form)
{
  using B                   = RollerBearing;
  const RollerBearing given = as_solved(as_given, reading);
  const PartsRead read      = parts_of(given, reading.asks, form);
  BearingInputs inputs{word_or_none(given.type), given, given.designation, given.catalogue};
  if (!given.estimated.empty())
    inputs.ratings = {given.dynamic_rating, given.static_rating};
  Unread unread{inputs.bearing};
  // Raceway pressures are compared with the yield pressure afterwards.
  unread(true, &B::yield_pressure);
  unread(!read.rib, &B::rib_angle);
  unread(!read.slices, &B::slices);
  unread(given.profile != RollerProfile::table, &B::profile_table);
  unread(!(given.profile == RollerProfile::crown || read.three), &B::crown_drop);
  unread(!read.three, &B::profile_share);
  unread(!read.rounded, &B::profile_load);
  unread(!std::isnan(given.end_play) || !std::isnan(given.preload), &B::radial_clearance);
  unread(!read.fe && !rollers_turn(given, form), &B::roller_total_length);
  unread(!(read.drawn && read.tapered) && !read.rib, &B::roller_cone_angle);
  unread(!read.sized && given.profile != RollerProfile::iso, &B::roller_diameter);
  unread(!read.rings && !read.rounded, &B::youngs_modulus, &B::poisson_ratio);
  // Without a pitch diameter these two give it.
  unread(!read.rings && !(read.pitch && std::isnan(given.pitch_diameter)), &B::bore, &B::outside_diameter);
  unread(!read.pitch, &B::pitch_diameter);
  unread(!read.tapered, &B::cup_angle, &B::end_play, &B::preload);
  unread(!read.drawn && !(read.arms && given.rows > 1), &B::width);
  unread(!read.hands, &B::arrangement);
  unread(!read.elastic, &B::chock);
  unread(!read.elastic || given.chock == ChockForm::rigid, &B::chock_width, &B::chock_height, &B::chock_length);
  unread(!read.elastic || given.chock != ChockForm::block, &B::chock_support_width, &B::chock_support_gap);
  return inputs;
}

std::string text_of_source(const RollerBearing &b)
{
  std::array<double, 2> ratings = {not_given, not_given};
  if (!b.estimated.empty())
    ratings = {b.dynamic_rating, b.static_rating};
  return record_text(b.designation, b.catalogue, ratings);
}

namespace {
std::string text_of_equilibrium(const LoadedTexts &on, const BearingReading &reading)
{
  std::string text =
      on.name + on.radial + on.beside + on.cage + record_text(inputs_of_bearing(on.bearing, reading, on.form));
  if (rollers_turn(on.bearing, on.form))
    text += on.speed;
  if (as_solved(on.bearing, reading).roller_law == OneRollerLaw::fe)
    text += on.mesh;
  return text;
}

// Rows between rigid rings share a radial load evenly while nothing tilts or pushes them.
std::string text_of_share(const LoadedTexts &on, const BearingReading &reading)
{
  if (on.form.tilts || on.form.pushes || as_solved(on.bearing, reading).rings == RingBodies::elastic)
    return text_of_equilibrium(on, reading);
  return on.name + on.beside + record_text(on.bearing.rows);
}

// A rating of the maker, else that by the formulas of the standards.
std::string text_of_rating(const RollerBearing &b, const double given, double Ratings::*by_formula)
{
  double rating = given;
  if (std::isnan(rating))
    try {
      rating = ratings(b).*by_formula;
    } catch (const InputError &) {  // there is none without rollers
    }
  return record_text(rating) + text_of_source(b);
}

std::string text_of_C(const RollerBearing &b)
{
  return text_of_rating(b, b.dynamic_rating, &Ratings::dynamic);
}

std::string text_of_C0(const RollerBearing &b)
{
  return text_of_rating(b, b.static_rating, &Ratings::static_rating);
}

// Whether the rows push the rings along the axis where these keep their axial place.
bool pushes_back(const LoadedTexts &on)
{
  const RollerBearing &b = on.bearing;
  int hands              = 0;
  for (int row = 0; row < b.rows && !b.arrangement.empty(); ++row)
    hands += b.arrangement[std::size_t(row) % b.arrangement.size()] == '+' ? 1 : -1;
  return on.form.tilts || on.form.pushes || hands != 0;
}

// Radial and axial force that the rating formulas take.
std::string text_of_loads(const LoadedTexts &on)
{
  const RollerBearing &b = on.bearing;
  if (b.type != BearingType::four_row_tapered)
    return on.name + on.radial;
  const std::string factors = record_text(b.cup_angle, b.arrangement, b.rows);
  if (!on.axial.empty())
    return on.name + on.radial + on.axial + factors;
  if (pushes_back(on))
    return text_of_equilibrium(on, {BearingAsks::row_axial}) + factors;
  return on.name + on.radial + on.beside + record_text(b.arrangement);
}

std::string text_of_cage(const LoadedTexts &on)
{
  const RollerBearing &b = on.bearing;
  const bool tapered     = b.type == BearingType::four_row_tapered;
  return on.name + on.speed + record_text(b.roller_diameter, pitch_diameter(b), tapered ? b.cup_angle : 0) +
         text_of_source(b);
}

std::string text_of_centrifugal_force(const LoadedTexts &on)
{
  const RollerBearing &b = on.bearing;
  return text_of_cage(on) +
         record_text(std::isnan(b.roller_total_length) ? b.roller_length : b.roller_total_length);
}

std::string text_of_life_by_slices(const LoadedTexts &on, const BearingReading &reading)
{
  const RollerBearing &b = on.bearing;
  return text_of_equilibrium(on, reading) + text_of_C(b) + record_text(b.roller_diameter, pitch_diameter(b));
}

std::string text_of_modified_life(const LoadedTexts &on, const BearingReading &reading)
{
  const RollerBearing &b = on.bearing;
  return text_of_life_by_slices(on, reading) + text_of_C0(b) + record_text(b.viscosity_ratio, b.contamination);
}

std::string text_of_estimate(const LoadedTexts &on)
{
  const RollerBearing &b = on.bearing;
  return on.name + record_text(inputs_of_bearing(b), b.dynamic_rating, b.static_rating, b.roller_diameter,
                               b.pitch_diameter, b.bore, b.outside_diameter);
}

std::string text_without_time(const LoadedTexts &on, const BearingReading &reading)
{
  const RollerBearing &b = on.bearing;
  switch (reading.asks) {
  case BearingAsks::row_share:
    return text_of_share(on, reading);
  case BearingAsks::dynamic_rating:
    return on.name + text_of_C(b);
  case BearingAsks::static_rating:
    return on.name + text_of_C0(b);
  case BearingAsks::equivalent_load:
    return text_of_loads(on);
  case BearingAsks::safety:
    return text_of_loads(on) + text_of_C0(b);
  case BearingAsks::basic_life:
    return text_of_loads(on) + text_of_C(b);
  case BearingAsks::life_by_slices:
    return text_of_life_by_slices(on, reading);
  case BearingAsks::modified_life:
    return text_of_modified_life(on, reading);
  case BearingAsks::cage_speed:
    return text_of_cage(on);
  case BearingAsks::centrifugal_force:
    return text_of_centrifugal_force(on);
  case BearingAsks::estimate:
    return text_of_estimate(on);
  case BearingAsks::along:
  case BearingAsks::across:
  case BearingAsks::tilting:
  case BearingAsks::row_axial:
  case BearingAsks::rib:
  case BearingAsks::fitted_load:
  case BearingAsks::motion:
  case BearingAsks::least_speed:
    break;
  }
  return text_of_equilibrium(on, reading);
}

}  // namespace

std::string text_of_loaded_bearing(const LoadedTexts &on, const BearingReading &reading)
{
  return text_without_time(on, reading) + (reading.in_time ? on.speed : "");
}

}  // namespace mill
