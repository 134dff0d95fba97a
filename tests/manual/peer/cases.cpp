#include "core/model/case.h"
#include "tests/manual/peer/calculix.h"
#include "tests/manual/peer/checks.h"
#include "tests/manual/peer/contacts.h"
#include "tests/manual/peer/models.h"
#include "tests/manual/peer/peer.h"
#include "tests/manual/stand/component_models.h"
#include "tests/manual/stand/component_statics.h"
#include "tests/manual/stand/housing_models.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

// The product's bodies by another finite-element program on meshes of its own.
namespace mill::verify {
namespace {
using peer::add;
using peer::plane;
using peer::Refinement;

// ---- peer-rolls-free, peer-roll-on-seats ----------------------------------------------------------------------

// An eighth bends about its mid-length in the plane of y: nothing crosses x = 0 and z = 0, and y = 0 is the
// neutral plane.
void hold_eighth(peer::Deck &deck, const peer::Mesh &mesh)
{
  deck.hold(plane(mesh, 0), 1);
  deck.hold(plane(mesh, 2), 3);
  deck.hold(plane(mesh, 1), 1);
  deck.hold(plane(mesh, 1), 3);
}

// At the shoulder, a solid corner of 270 degrees, stresses grow as r^(0.5445 - 1), and energies, stiffnesses and
// frequencies converge with h^(2 x 0.5445), h the size of the elements there, which is n^-2 on the peer's meshes.
constexpr double shoulder_order = 4 * 0.5445;

std::vector<Check> rolls_free()
{
  std::vector<Check> checks;
  for (const auto &[name, roll] :
       {std::pair{"work roll", demo_work_roll}, std::pair{"backup roll", demo_backup_roll}}) {
    const RollPart part        = roll_part(name, roll, 4);
    const Eigen::VectorXd ours = fem::free_modes(*part.part, 2).frequency;
    Eigen::VectorXd result[2];
    int nodes[2];
    for (const int i : {0, 1}) {
      const peer::Mesh mesh = peer::roll_eighth(roll, i ? 4 : 2);
      peer::Deck deck(mesh, demo_roll_steel);
      hold_eighth(deck, mesh);
      result[i] = deck.frequencies(3).tail(2);  // without the rigid motion along y
      nodes[i]  = int(mesh.nodes.size());
    }
    for (const int k : {0, 1})
      add(checks,
          {fmt::format("{}, symmetric bending mode {}", name, k + 1), "Hz", result[0][k], result[1][k], ours[k]},
          {nodes[0], nodes[1], shoulder_order}, 3e-3);
  }
  return checks;
}

// Load over deflection of the middle against the seat's mean.  The seat pushes back with a body force of its own
// distribution, so that the roll is in balance; its mean may move, and is taken off.
double stiffness_on_seat(const peer::Mesh &mesh, const RollGeometry &g, const peer::Weights &seat)
{
  peer::Deck deck(mesh, demo_roll_steel);
  hold_eighth(deck, mesh);
  deck.hold(peer::nodes_where(mesh, [](const Eigen::Vector3d &x) { return x.norm() < 1e-9; }), 2);
  auto forces = peer::spread(
      peer::over_body(mesh, [&](const Eigen::Vector3d &x) { return x[2] < g.half_length ? 1. : 0.; }), 1. / 8);
  for (const auto &[node, force] : peer::spread(seat, -1. / 8))
    forces[node] += force;
  const Eigen::MatrixXd u = deck.displacement(forces, 2);
  const auto middle       = peer::over_faces(
            mesh, peer::faces_where(mesh, [](const Eigen::Vector3d &x) { return std::abs(x[2]) < 1e-9; }));
  return 1 / (peer::mean(middle, u, 2) - peer::mean(seat, u, 2));
}

std::vector<Check> roll_on_seats()
{
  const RollGeometry &g = demo_backup_roll;
  const RollPart part   = roll_part("backup roll", g, 4);
  const double width    = std::min(0.5 * g.neck_length, g.half_length + g.neck_length - g.seat_centre);
  double frequency[2], stiffness[2];
  int nodes[2];
  for (const int i : {0, 1}) {
    const peer::Mesh mesh = peer::roll_eighth(g, i ? 4 : 2);
    nodes[i]              = int(mesh.nodes.size());
    const auto seat       = peer::over_body(mesh, [&](const Eigen::Vector3d &x) {
      const double s = (x[2] - g.seat_centre) / width;
      return x[2] > g.half_length && std::abs(s) < 1 ? std::pow(std::cos(0.5 * M_PI * s), 2) : 0;
    });
    peer::Deck deck(mesh, demo_roll_steel);
    hold_eighth(deck, mesh);
    deck.hold_mean(seat, 2);
    frequency[i] = deck.frequencies(1)[0];
    stiffness[i] = stiffness_on_seat(mesh, g, seat);
  }
  const Refinement meshes{nodes[0], nodes[1], shoulder_order};
  std::vector<Check> checks;
  add(checks, {"first frequency, seats at rest", "Hz", frequency[0], frequency[1], seated_frequency(part)}, meshes,
      3e-3);
  add(checks,
      {"bending stiffness K_ZW", "1e10 N/m", stiffness[0] / 1e10, stiffness[1] / 1e10,
       solid_bending_stiffness(part) / 1e10},
      meshes, 5e-3);
  return checks;
}

// ---- peer-housing ---------------------------------------------------------------------------------------------

std::vector<Check> housing_window()
{
  const MillHousing h = demo_housing();
  const auto ours     = solved(h, {4, 1, 0});
  double opening[2];
  int nodes[2];
  for (const int i : {0, 1}) {
    const peer::Mesh mesh = peer::housing_quarter(h, i ? 6 : 3);
    nodes[i]              = int(mesh.nodes.size());
    const auto pad        = [&](const double y, const double side) {
      return peer::over_faces(mesh, peer::faces_where(mesh, [=](const Eigen::Vector3d &x) {
                                return std::abs(x[1] - y) < 1e-9 && x[0] < 0.5 * side + 1e-9 &&
                                       x[2] < 0.5 * side + 1e-9;
                              }));
    };
    const auto screw = pad(h.window_height, h.screw_pad), seat = pad(0, h.seat_pad);
    peer::Deck deck(mesh, h.steel);
    deck.hold(plane(mesh, 0), 1);
    deck.hold(plane(mesh, 2), 3);
    // One node keeps it from floating; the two forces are in balance, so that it carries nothing.
    deck.hold({peer::nodes_where(mesh, [](const Eigen::Vector3d &x) { return x.norm() < 1e-9; }).at(0)}, 2);
    // A quarter of each of two housings: an eighth of the bite force.
    auto forces = peer::spread(screw, 1. / 8);
    for (const auto &[node, force] : peer::spread(seat, -1. / 8))
      forces[node] += force;
    const Eigen::MatrixXd u = deck.displacement(forces, 2);
    opening[i]              = peer::mean(screw, u, 2) - peer::mean(seat, u, 2);
  }
  std::vector<Check> checks;
  add(checks,
      {"stiffness of the window, both housings", "1e10 N/m", 1e-10 / opening[0], 1e-10 / opening[1],
       1e-10 / (ours.u_screw - ours.u_seat)},
      {nodes[0], nodes[1]}, 5e-3);
  return checks;
}
}  // namespace

std::vector<Case> peer_cases()
{
  const char *const program =
      "CalculiX (G. Dhondt), C3D20 elements, SPOOLES and ARPACK; meshes of blocks made for it "
      "from the drawing, not from this program";
  const std::string shoulder =
      "The shoulder is a re-entrant corner, at which stiffness and frequency converge with h^1.09 on any mesh: "
      "two "
      "meshes give the limit to some tenth of their last step, and ours carries the like error. ";
  std::vector<Case> cases;
  const auto add_case = [&](const std::string &name, const std::string &problem, const std::string &reason,
                            std::vector<Check> (*run)()) {
    Case page{name, "benchmark", problem, program, reason, run};
    page.ran_with = peer::program_and_date;
    cases.push_back(std::move(page));
  };
  add_case(
      "peer-rolls-free",
      "Work roll and backup roll of the demo stand, free: symmetric bending modes of an eighth, two meshes of "
      "the peer, the second twice as fine.",
      shoulder + "0.3 %.", rolls_free);
  add_case(
      "peer-roll-on-seats",
      "Backup roll of the demo stand on its bearings: first frequency with the mean of each seat at rest, and "
      "load over deflection under a load spread evenly over the barrel, which the seats carry; the seat's mean "
      "is weighed by cos^2 over the bearing on both sides.",
      shoulder + "0.3 % of the frequency, 0.5 % of the stiffness.", roll_on_seats);
  add_case(
      "peer-housing",
      "Housing of the demo stand (assumed dimensions): opening of the window between the means of the screw's "
      "and the chock's pad under even pressure on both, the feet free.",
      "0.5 %: fillets and the edges of the pads leave errors of second order, by which the peer is "
      "extrapolated; ours has four elements through posts and beams and 0.3 % of its own (housing-mesh-order).",
      housing_window);
  add_case(
      "peer-line",
      "Steel cylinders R 200 and R 650 mm in plane strain, each squeezed between opposite contacts: line load "
      "that belongs to one approach. Contact face to face with a penalty of 500 moduli per mm.",
      "0.3 %: the peer scatters by 0.02 % with the place of the edge of the contact in its elements and deflects "
      "by 0.01 %; ours errs by 0.1 % at most (line-200-650).",
      peer_line);
  add_case(
      "peer-roll-pair",
      "Steel cylinders R 200 and R 650 mm, 500 mm long with free ends, each squeezed between opposite contacts: "
      "force at the approach that belongs to 1000 N/mm in plane strain. An eighth; sections as of peer-line, "
      "elements of half a half width at the contact, growing from there by 2.9 and 1.7, 3 and 6 layers. Contact "
      "face "
      "to face with a penalty of 500 moduli per mm.",
      "0.3 %: the peer is extrapolated with the order of the same two sections in plane strain, which leaves some "
      "0.02 %; ours has 6 elements on the half width and 0.1 % of its own, a third of the step from 3.",
      peer_roll_pair);
  add_case(
      "peer-roller",
      "Roller 21.5 x 33.4 mm of the demo bearing (ISO crown, taper left out) between raceways of radius 144.8 mm "
      "(convex) and 166.3 mm (concave), each 12 mm thick, held at its back and cut off at 48 mm to the sides and "
      "10.75 mm beyond the roller: load when the backs have come together by 20 um. A quarter; the crown is in "
      "the "
      "peer's mesh, in ours in the gap. Elements of one half width at the contacts, growing by 2.9 and 1.7, 4 and "
      "8 "
      "layers along half of the roller. Contact face to face with a penalty of 5000 moduli per mm.",
      "0.5 %: the peer is extrapolated by 0.1 % and deflects by 0.04 % in its penalty; ours steps by 0.3 % with "
      "nodes that join (fe-mesh-order).",
      peer_roller);
  return cases;
}
}  // namespace mill::verify
