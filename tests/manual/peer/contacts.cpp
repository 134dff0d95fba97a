#include "tests/manual/peer/contacts.h"
#include "fem/contact/active_set.h"
#include "fem/roll/contact_study.h"
#include "meshes/roll/contact_mesh_size.h"
#include "tests/manual/check/units.h"
#include "tests/manual/contact/line_sections.h"
#include "tests/manual/contact/meshed.h"
#include "tests/manual/contact/roll_models.h"
#include "tests/manual/peer/calculix.h"
#include "tests/manual/peer/checks.h"
#include "tests/manual/peer/models.h"
#include <cmath>

namespace mill::verify {
namespace {

struct Pressed {
  double force;  // N, on the part that is meshed
  int nodes;
};

// How fine the peer's meshes of rolls are.
struct PeerSize {
  int n;          // elements on the half width
  double growth;  // from one element to the next, away from the contact
};

// Two cylinders one above the other, half of each from its middle to the contact: the middle plane of the lower
// one at rest, that of the upper one comes down.  x = 0 and z = 0 are planes of symmetry.
struct Cylinders {
  double lower, upper;    // m, radii
  double half_width;      // m, what the meshes are made for
  std::vector<double> z;  // m, lines along the axes
  bool plane_strain;      // or free ends
};

Pressed press(const Cylinders &c, const double approach, const PeerSize &size)
{
  const double distance = c.lower + c.upper;
  peer::Mesh mesh       = peer::disc_quarter({c.lower, c.half_width, size.n, size.growth}, c.z);
  peer::append(mesh,
               peer::turned_over(peer::disc_quarter({c.upper, c.half_width, size.n, size.growth}, c.z), distance));
  peer::Deck deck(mesh, steel);
  deck.hold(peer::plane(mesh, 0), 1);
  deck.hold(c.plane_strain ? peer::nodes_where(mesh, [](const Eigen::Vector3d &) { return true; })
                           : peer::plane(mesh, 2),
            3);
  deck.hold(peer::plane(mesh, 1), 2);
  const auto surface = [&](const double radius, const double middle) {
    return peer::faces_where(mesh, [=](const Eigen::Vector3d &x) {
      return std::abs(std::hypot(x[0], x[1] - middle) - radius) < 1e-9 && x[0] < 4 * c.half_width;
    });
  };
  // A penalty of 500 moduli per mm deflects by 1e-4 of the approach.
  deck.touch(surface(c.upper, distance), surface(c.lower, 0), 500 * steel.youngs_modulus / 1e-3);
  return {-deck.force_to_move(peer::plane(mesh, 1, distance), 2, -approach), int(mesh.nodes.size())};
}

// 1000 N/mm by Johnson's formula in plane strain.
constexpr double approach = 35.931e-6, patch_half_width = 1.2991e-3, upper_radius = 0.2, lower_radius = 0.65;
}  // namespace

// ---- peer-line ------------------------------------------------------------------------------------------------

std::vector<Check> peer_line()
{
  const double thickness = 1e-3;
  const Cylinders pair{lower_radius, upper_radius, patch_half_width, {0, thickness}, true};
  const Pressed coarse = press(pair, approach, {2, 1.7}), fine = press(pair, approach, {4, 1.3});
  const double per_width = 2e-3 / thickness;  // both halves, N/mm
  std::vector<Check> checks;
  peer::add(checks,
            {"line load at 35.931 um", "N/mm", per_width * coarse.force, per_width * fine.force,
             line_load_at(upper_radius, lower_radius, steel, patch_half_width, approach) / 1e3},
            {coarse.nodes, fine.nodes}, 3e-3);
  return checks;
}

// ---- peer-roll-pair -------------------------------------------------------------------------------------------

namespace {
constexpr double half_length = 0.25;

// Distances from the free end grow with the cube.
std::vector<double> barrel_lines(const int n)
{
  std::vector<double> z = peer::even(n);
  for (double &line : z)
    line = half_length * (1 - std::pow(1 - line, 3));
  return z;
}

// N, by the product's condensed rolls, quadratic elements on the half width as asked.
double force_of_pair(const int per_half_width)
{
  const auto size  = meshes::roll_contact_size(1.5 * patch_half_width, per_half_width);
  const auto model = [&](const std::string &name, const double radius) {
    RollGeometry cylinder;
    cylinder.radius      = radius;
    cylinder.half_length = half_length;
    return roll_model(name, cylinder, size, steel, {}).roll;
  };
  const auto lower = model("lower", lower_radius), upper = model("upper", upper_radius);
  const auto pair = fem::make_pair("pair", lower, fem::held_by_mirror(lower), upper, fem::held_by_mirror(upper),
                                   Eigen::VectorXd::Zero(upper.grid.n_z));
  contact::ActiveSet solver(pair.problem);
  return pair.multiplicity * solver.solve(prescribed(approach)).resultant[0];
}
}  // namespace

std::vector<Check> peer_roll_pair()
{
  const auto eighth = [](const int layers) {
    return Cylinders{lower_radius, upper_radius, patch_half_width, barrel_lines(layers), false};
  };
  const Pressed coarse = press(eighth(3), approach, {2, 2.9}), fine = press(eighth(6), approach, {2, 1.7});
  // In plane strain the same two sections are 0.49 % and 0.015 % too stiff; the layers change it by 0.02 % only.
  const double order = 5;
  const double ours  = force_of_pair(6);
  std::vector<Check> checks;
  peer::add(checks, {"force at 35.931 um", "kN", 4e-3 * coarse.force, 4e-3 * fine.force, 1e-3 * ours},
            {coarse.nodes, fine.nodes, order}, 3e-3);
  checks.push_back(reported("force at 35.931 um: ours with elements twice as large, compared with ours", "kN",
                            1e-3 * force_of_pair(3), 1e-3 * ours));
  return checks;
}
}  // namespace mill::verify
