#include "dynamics/cluster/stack_of_case.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace mill::cluster {
namespace {
using Point = Eigen::Vector2d;

constexpr double closed = 2e-6;  // m: a contact that closes to this is touching

std::pair<std::string, std::string> rolls_of(const ClusterContact &contact)
{
  const auto dash = contact.pair.find('-');
  return {contact.pair.substr(0, dash), contact.pair.substr(dash + 1)};
}

std::size_t index_of(const ClusterStand &stand, const std::string &name)
{
  return std::size_t(
      std::find_if(stand.rolls.begin(), stand.rolls.end(), [&](const ClusterRoll &r) { return r.name == name; }) -
      stand.rolls.begin());
}

// What is known of a roll from its contact with another one that has its place.
struct Neighbour {
  Point centre;
  double distance;
  std::optional<double> direction;  // from the neighbour to the roll
};

std::vector<Neighbour> neighbours_of(const ClusterStand &stand, const std::size_t roll,
                                     const std::vector<std::optional<Point>> &places)
{
  std::vector<Neighbour> neighbours;
  for (const ClusterContact &c : stand.contacts) {
    const auto [first, second] = rolls_of(c);
    const std::size_t a = index_of(stand, first), b = index_of(stand, second);
    const std::size_t other = a == roll ? b : a;
    if ((a != roll && b != roll) || !places[other])
      continue;
    Neighbour n{*places[other], 0.5 * (stand.rolls[a].barrel_diameter + stand.rolls[b].barrel_diameter), {}};
    if (!std::isnan(c.direction))
      n.direction = c.direction + (b == roll ? 0 : M_PI);
    neighbours.push_back(n);
  }
  return neighbours;
}

// On two circles; nothing where they do not meet.
std::optional<Point> meeting_point(const Neighbour &a, const Neighbour &b, const bool below)
{
  const Point along   = b.centre - a.centre;
  const double L      = along.norm();
  const double s      = (L * L + a.distance * a.distance - b.distance * b.distance) / (2 * L);
  const double square = a.distance * a.distance - s * s;
  if (L == 0 || square < 0)
    return {};
  Point across(-along.y() / L, along.x() / L);
  if ((across.y() > 0) == below)
    across = -across;
  return a.centre + s * along / L + std::sqrt(square) * across;
}

std::optional<Point> place_from(const std::vector<Neighbour> &neighbours, const bool below)
{
  for (const Neighbour &n : neighbours)
    if (n.direction)
      return n.centre + n.distance * Point(std::cos(*n.direction), std::sin(*n.direction));
  if (neighbours.size() < 2)
    return {};
  return meeting_point(neighbours[0], neighbours[1], below);
}

double in_mm(const double length)
{
  return 1e3 * length;
}

void check_contact(const ClusterStand &stand, const ClusterContact &c, const std::vector<Point> &places,
                   std::vector<Problem> &problems)
{
  const auto [first, second] = rolls_of(c);
  const std::size_t a = index_of(stand, first), b = index_of(stand, second);
  const double distance = (places[b] - places[a]).norm(),
               wanted   = 0.5 * (stand.rolls[a].barrel_diameter + stand.rolls[b].barrel_diameter);
  if (std::abs(distance - wanted) > closed)
    problems.push_back(
        {c.place,
         fmt::format("contact {} does not close: the axes are {:.4f} mm apart, the radii make {:.4f} mm; "
                     "the rolls {} by {:.4f} mm; move one of them, or leave its position to the contacts",
                     c.pair, in_mm(distance), in_mm(wanted), distance > wanted ? "stand apart" : "overlap",
                     in_mm(std::abs(distance - wanted))),
         {stand.rolls[a].place, stand.rolls[b].place}});
}

void check_overlaps(const ClusterStand &stand, const std::vector<Point> &places, std::vector<Problem> &problems)
{
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = a + 1; b < places.size(); ++b) {
      const bool touching =
          std::any_of(stand.contacts.begin(), stand.contacts.end(), [&](const ClusterContact &c) {
            const auto [first, second] = rolls_of(c);
            const std::size_t i = index_of(stand, first), k = index_of(stand, second);
            return (i == a && k == b) || (i == b && k == a);
          });
      const double distance = (places[b] - places[a]).norm(),
                   radii    = 0.5 * (stand.rolls[a].barrel_diameter + stand.rolls[b].barrel_diameter);
      if (!touching && distance < radii - closed)
        problems.push_back(
            {stand.rolls[b].place,
             fmt::format("rolls {} and {} overlap by {:.4f} mm and have no [[contact]]; move one of them, "
                         "or say that they touch",
                         stand.rolls[a].name, stand.rolls[b].name, in_mm(radii - distance)),
             {stand.rolls[a].place}});
    }
}
}  // namespace

std::vector<Eigen::Vector2d> placed_rolls(const ClusterStand &written)
{
  const ClusterStand stand = written_out(written);
  std::vector<std::optional<Point>> places(stand.rolls.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    if (const auto &p = stand.rolls[i].position; !std::isnan(p[0]))
      places[i] = Point(p[0], p[1]);
  for (bool progress = true; progress;) {
    progress = false;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (!places[i])
        if (const auto place =
                place_from(neighbours_of(stand, i, places), stand.rolls[i].side == PositionSide::below)) {
          places[i] = place;
          progress  = true;
        }
  }
  std::vector<Problem> problems;
  std::vector<Point> all;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) {
      const auto near = neighbours_of(stand, i, places);
      problems.push_back(
          {stand.rolls[i].place,
           near.size() >= 2
               ? fmt::format(
                     "roll {} cannot touch both rolls it leans on: their axes are {:.4f} mm apart, it reaches "
                     "{:.4f} mm",
                     stand.rolls[i].name, in_mm((near[1].centre - near[0].centre).norm()),
                     in_mm(near[0].distance + near[1].distance))
               : fmt::format(
                     "roll {} has no place; give its position, a contact with a direction, or contacts with two "
                     "rolls that have their place",
                     stand.rolls[i].name),
           {}});
    } else {
      all.push_back(*places[i]);
    }
  }
  if (problems.empty()) {
    for (const ClusterContact &c : stand.contacts)
      check_contact(stand, c, all, problems);
    check_overlaps(stand, all, problems);
  }
  if (!problems.empty())
    throw InputError(std::move(problems));
  return all;
}
}  // namespace mill::cluster
