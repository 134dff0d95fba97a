#include "reduce/bearing/ring_sections.h"
#include "core/base/errors.h"
#include "reduce/bearing/geometry.h"
#include "reduce/bearing/roller_law.h"
#include <algorithm>
#include <cmath>
#include <sstream>

namespace mill::bearing {
namespace {
constexpr double mm = 1e-3;

template <class... Parts> [[noreturn]] void refuse(const RollerBearing &bearing, const Parts &...parts)
{
  std::ostringstream text;
  text.precision(5);
  text << "bearing." << bearing.name << ": ";
  (text << ... << parts);
  throw InputError(text.str());
}

void require_given(const RollerBearing &b)
{
  const auto need = [&](const char *key, const double value) {
    if (!(std::isfinite(value) && value > 0))
      refuse(b, "elastic rings need ", key);
  };
  need("bore", b.bore);
  need("outside_diameter", b.outside_diameter);
  need("width", b.width);
  need("roller_diameter", b.roller_diameter);
  need("roller_length", b.roller_length);
  if (b.chock == ChockForm::rigid)
    return;
  need("chock_width", b.chock_width);
  need("chock_height", b.chock_height);
  need("chock_length", b.chock_length);
  if (b.chock == ChockForm::block)
    need("chock_support_width", b.chock_support_width);
}

std::vector<int> hands(const RollerBearing &b)
{
  std::vector<int> out;
  for (int r = 0; r < b.rows; ++r)
    out.push_back(b.arrangement.empty() || b.arrangement[std::size_t(r) % b.arrangement.size()] == '+' ? 1 : -1);
  return out;
}

RingSection section(const RollerBearing &b, const bool inner)
{
  RingSection s;
  s.inner             = inner;
  s.length            = b.roller_length;
  s.seat_radius       = 0.5 * (inner ? b.bore : b.outside_diameter);
  s.half_width        = 0.5 * b.width;
  const double axis   = b.cup_angle - 0.5 * b.roller_cone_angle;  // of the roller
  const double angle  = inner ? b.cup_angle - b.roller_cone_angle : b.cup_angle;
  const double side   = inner ? -1 : 1;
  const auto z        = row_positions(b);
  const auto row_hand = hands(b);
  for (int r = 0; r < b.rows; ++r) {
    RacewayLine line;
    line.hand   = row_hand[std::size_t(r)];
    line.middle = Eigen::Vector2d(0.5 * pitch_diameter(b), z[r]) +
                  side * 0.5 * b.roller_diameter * Eigen::Vector2d(std::cos(axis), line.hand * std::sin(axis));
    line.normal = {std::cos(angle), line.hand * std::sin(angle)};
    line.along  = {-line.normal[1], line.normal[0]};
    s.raceways.push_back(line);
  }
  return s;
}

const char *ring_name(const RingSection &s)
{
  return s.inner ? "cone" : "cup";
}

// Rows next to each other within the width, and raceways within the ring.
void require_inside(const RollerBearing &b, const RingSection &s)
{
  const double half = 0.5 * s.length * s.raceways[0].along[1];
  for (std::size_t r = 0; r + 1 < s.raceways.size(); ++r) {
    const double pitch = s.raceways[r + 1].middle[1] - s.raceways[r].middle[1];
    if (pitch <= 2 * half)
      refuse(b, "rows ", r + 1, " and ", r + 2, " overlap on the ", ring_name(s), ": the raceways are ",
             2 * half / mm, " mm long along the axis and ", pitch / mm,
             " mm apart; shorter rollers or a wider bearing");
  }
  const double last = std::max(s.raceways.back().middle[1], -s.raceways.front().middle[1]) + half;
  if (last >= s.half_width)
    refuse(b, "the outer row's raceway on the ", ring_name(s), " ends ", last / mm,
           " mm from the middle, the bearing already at ", s.half_width / mm, " mm");
  const double rise = 0.5 * s.length * std::abs(s.raceways[0].along[0]), r = s.raceways[0].middle[0];
  const double wall = s.inner ? r - rise - s.seat_radius : s.seat_radius - r - rise;
  if (wall <= 0)
    refuse(b, "the raceway of the ", ring_name(s), " reaches diameter ", 2 * (s.inner ? r - rise : r + rise) / mm,
           " mm, ", s.inner ? "inside the bore of " : "outside the outside diameter of ", 2 * s.seat_radius / mm,
           " mm; check roller_diameter, pitch_diameter, roller_length and cup_angle");
  // Thinner than a tenth of the roller it is not a ring any more, and no mesh follows it.
  if (wall < 0.1 * b.roller_diameter)
    refuse(b, "the ", ring_name(s), " has only ", wall / mm,
           " mm left at the thin end of a raceway, less than a tenth "
           "of the roller diameter of ",
           b.roller_diameter / mm, " mm; check roller_diameter, pitch_diameter, roller_length and cup_angle");
}

// Straight raceway that there is room for beyond the lines' ends, m.
double room_beyond(const RingSection &s)
{
  const Eigen::Vector2d along = s.raceways[0].along;
  const double half           = 0.5 * s.length * along[1];
  double room = s.half_width - half - std::max(s.raceways.back().middle[1], -s.raceways.front().middle[1]);
  for (std::size_t r = 0; r + 1 < s.raceways.size(); ++r)
    room = std::min(room, 0.5 * (s.raceways[r + 1].middle[1] - s.raceways[r].middle[1]) - half);
  room /= along[1];
  if (const double slope = std::abs(along[0]); slope > 0) {
    const double wall = std::abs(s.seat_radius - s.raceways[0].middle[0]) - 0.5 * s.length * slope;
    room              = std::min(room, wall / slope);
  }
  return room;
}

Housing housing(const RollerBearing &b)
{
  Housing h;
  const double od = b.outside_diameter;
  if (b.chock == ChockForm::rigid) {
    h.kind        = ChockForm::rigid;
    h.radius      = 0.5 * od;
    h.half_length = 0.5 * b.width;
    return h;
  }
  h.kind          = b.chock;
  h.radius        = 0.5 * std::min(b.chock_width, b.chock_height);
  h.half_length   = 0.5 * b.chock_length;
  h.width         = b.chock_width;
  h.height        = b.chock_height;
  h.support_width = b.chock_support_width;
  h.support_gap   = std::isnan(b.chock_support_gap) ? 0 : b.chock_support_gap;
  if (2 * h.radius <= 1.02 * od)
    refuse(b, "a chock of ", b.chock_width / mm, " x ", b.chock_height / mm,
           " mm leaves no wall around an outside diameter of ", od / mm, " mm");
  if (h.kind == ChockForm::block && h.support_width > h.width)
    refuse(b, "chock_support_width = ", h.support_width / mm, " mm is more than the chock_width of ", h.width / mm,
           " mm");
  if (h.kind == ChockForm::block && !(h.support_gap >= 0 && h.support_gap < h.support_width))
    refuse(b, "chock_support_gap = ", h.support_gap / mm, " mm leaves nothing of the chock_support_width of ",
           h.support_width / mm, " mm");
  return h;
}
}  // namespace

double ring_wall(const RingSection &s)
{
  const RacewayLine &line = s.raceways.at(0);
  return std::abs(s.seat_radius - line.middle[0]) / line.normal[0];
}

RingSections ring_sections(const RollerBearing &b, const RacewayDatum &datum)
{
  require_given(b);
  RingSections out;
  out.cone     = section(b, true);
  out.cup      = section(b, false);
  out.housing  = housing(b);
  out.material = {b.youngs_modulus, b.poisson_ratio, 0};
  require_inside(b, out.cone);
  require_inside(b, out.cup);
  out.cone.depth    = std::isfinite(datum.depth_inner) ? datum.depth_inner : ring_wall(out.cone);
  out.cup.depth     = std::isfinite(datum.depth_outer) ? datum.depth_outer : ring_wall(out.cup);
  const double room = std::min(room_beyond(out.cone), room_beyond(out.cup));
  const double land = std::isfinite(datum.land) ? datum.land : std::min(0.1 * b.roller_length, 0.5 * room);
  if (!(land > 0 && land <= 0.9 * room))
    refuse(b, "a land of ", land / mm, " mm beyond the rollers' ends does not fit: there is room for ", room / mm,
           " mm between the rows and on the rings");
  if (!(out.cone.depth > 0 && out.cup.depth > 0))
    refuse(b, "the depth to which the raceways are counted must be positive");
  out.cone.land = out.cup.land = land;
  return out;
}

RacewayDatum law_datum(const RollerBearing &b)
{
  const RingWalls walls = ring_walls(b);
  return {walls.inner, walls.outer, not_given};
}

RollerSetup roller_setup(RollerBearing b, const double largest_load)
{
  b.chock = ChockForm::rigid;
  RollerSetup s;
  s.diameter       = b.roller_diameter;
  s.length         = std::isnan(b.roller_total_length) ? b.roller_length : b.roller_total_length;
  s.contact_length = b.roller_length;
  s.inner_radius   = (pitch_diameter(b) - b.roller_diameter) / 2;
  s.outer_radius   = (pitch_diameter(b) + b.roller_diameter) / 2;
  s.inner_depth    = law_datum(b).depth_inner;
  s.outer_depth    = law_datum(b).depth_outer;
  s.land           = ring_sections(b, law_datum(b)).cone.land;
  s.material       = {b.youngs_modulus, b.poisson_ratio, 7850};
  s.largest_load   = largest_load;
  return s;
}
}  // namespace mill::bearing
