#include "core/base/parameter.h"
#include "tests/manual/bearing/roller_models.h"
#include "tests/manual/check/units.h"
#include "tests/manual/peer/calculix.h"
#include "tests/manual/peer/checks.h"
#include "tests/manual/peer/contacts.h"
#include "tests/manual/peer/models.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::verify {
namespace {
using Eigen::Vector3d;

// How fine the peer's mesh is.
struct RollerPeerSize {
  int n;          // elements on the half width
  double growth;  // from one element to the next, away from the contact
  int layers;     // along half of the roller
  int land;       // elements along the raceway beyond it
};

// One of the three bodies in its place, and the faces of it that may touch: of the roller below and above, of a
// raceway the same set twice.
struct Part {
  peer::Mesh mesh;
  std::vector<peer::Face> below, above;
};

// The roller between the inner raceway below and the outer one above, its middle the origin; x = 0 and z = 0 are
// planes of symmetry.  Each contact overlaps by `overlap` from the start: the roller, which nothing else holds, is
// held by its contacts.
class RollerMesh {
public:
  RollerMesh(const RollerSetup &setup, const double overlap, const double half_width, const RollerPeerSize &size)
      : s(completed(setup)), R(0.5 * setup.diameter), b(half_width), size_(size),
        inner_middle(overlap - R - s.inner_radius), outer_middle(R - overlap - s.outer_radius)
  {
    const Part roller = roller_part();
    const Part inner  = raceway(
         s.inner_radius, s.inner_depth,
         [&](peer::Mesh body) {
          return peer::moved(std::move(body), [&](const Vector3d &x) {
            return Vector3d(x[0], x[1] + inner_middle + s.inner_radius, x[2]);
          });
        },
         inner_middle);
    const Part outer = raceway(
        -s.outer_radius, s.outer_depth,
        [&](peer::Mesh body) { return peer::turned_over(std::move(body), outer_middle + s.outer_radius); },
        outer_middle);
    for (const Part *part : {&roller, &inner, &outer}) {
      const int first = int(mesh.elements.size());
      peer::append(mesh, part->mesh);
      faces.push_back({shifted(part->below, first), shifted(part->above, first)});
    }
  }

  // N, on the quarter, when the backs have come together by what overlaps and by `motion` (m) more.
  double force(const double motion) const
  {
    peer::Deck deck(mesh, s.material);
    deck.hold(peer::plane(mesh, 0), 1);
    deck.hold(peer::plane(mesh, 2), 3);
    const auto cone = back(inner_middle, s.inner_radius - s.inner_depth),
               cup  = back(outer_middle, s.outer_radius + s.outer_depth);
    for (const int direction : {1, 2, 3})
      deck.hold(cone, direction);
    for (const int direction : {1, 3})
      deck.hold(cup, direction);
    // The pressure of rollers is three times that of rolls, the approach a third: 5000 moduli per mm deflect by
    // 4e-4 of it.
    const double penalty = 5000 * s.material.youngs_modulus / 1e-3;
    deck.touch(faces[0].below, faces[1].below, penalty);
    deck.touch(faces[0].above, faces[2].below, penalty);
    return -deck.force_to_move(cup, 2, -motion);
  }

  int nodes() const
  {
    return int(mesh.nodes.size());
  }

private:
  struct Faces {
    std::vector<peer::Face> below, above;
  };

  static std::vector<peer::Face> shifted(std::vector<peer::Face> faces, const int first)
  {
    for (peer::Face &face : faces)
      face.element += first;
    return faces;
  }
  std::vector<double> along() const
  {
    std::vector<double> z = peer::even(size_.layers);
    for (double &line : z)
      line = 0.5 * s.length * (1 - (1 - line) * (1 - line));  // crowded where the crown ends the contact
    return z;
  }
  Part roller_part() const
  {
    const double deepest = 50 * um;  // of the crown, which is infinite at the end and touches no deeper than 10 um
    Part part;
    part.mesh =
        peer::moved(peer::disc_half({R, b, size_.n, size_.growth}, along()), [&](const Vector3d &x) -> Vector3d {
          const double scale = 1 - std::min(demo_roller_drop(x[2]), deepest) / R;
          return {scale * x[0], scale * x[1], x[2]};
        });
    const auto surface = [&](const int side) {
      return peer::faces_where(part.mesh, [&](const Vector3d &x) {
        return x[0] < 4 * b && side * x[1] > 0 && std::hypot(x[0], x[1]) > R - 1.1 * deepest;
      });
    };
    part.below = surface(-1);
    part.above = surface(1);
    return part;
  }
  template <class Place>
  Part raceway(const double radius, const double depth, const Place &place, const double middle) const
  {
    std::vector<double> z = along();
    for (const double beyond : peer::even(size_.land))
      if (beyond > 0)
        z.push_back(0.5 * s.length + beyond * s.land);
    const double first = b / size_.n;
    Part part;
    part.mesh =
        place(peer::raceway_quarter({radius, peer::growing_lines(4 * depth, first, 3 * size_.n / 2, size_.growth),
                                     peer::growing_lines(depth, first, 1, size_.growth), z}));
    part.below = peer::faces_where(part.mesh, [&](const Vector3d &x) {
      return x[0] < 4 * b && std::abs(std::hypot(x[0], x[1] - middle) - std::abs(radius)) < 1e-9;
    });
    return part;
  }
  std::vector<int> back(const double middle, const double radius) const
  {
    return peer::nodes_where(
        mesh, [=](const Vector3d &x) { return std::abs(std::hypot(x[0], x[1] - middle) - radius) < 1e-9; });
  }

  RollerSetup s;
  double R, b;
  RollerPeerSize size_;
  double inner_middle, outer_middle;  // m, height of the raceways' axis
  peer::Mesh mesh;
  std::vector<Faces> faces;  // of roller, inner, outer
};
}  // namespace

std::vector<Check> peer_roller()
{
  const double approach = 20 * um, half_width = 0.18e-3;  // by Hertz under 7 kN
  double force[2];
  int nodes[2];
  for (const int i : {0, 1}) {
    const RollerMesh mesh(demo_roller(), 0.25 * approach, half_width,
                          i ? RollerPeerSize{1, 1.7, 8, 1} : RollerPeerSize{1, 2.9, 4, 1});
    force[i] = 4 * mesh.force(0.5 * approach);
    nodes[i] = mesh.nodes();
  }
  const auto ours = [&](const RollerSetup &setup) {
    const fem::CondensedRoller condensed_roller = condensed(setup);
    return fem::RollerContact(condensed_roller, demo_roller_drop).solve(approach).load / kN;
  };
  // In plane strain the sections are 1.5 % and 0.1 % too stiff, order 3.8.
  const double order = 4;
  const double fine  = ours(fine_demo_roller());
  std::vector<Check> checks;
  peer::add(checks, {"load at 20 um", "kN", force[0] / kN, force[1] / kN, fine}, {nodes[0], nodes[1], order},
            5e-3);
  checks.push_back(reported("load at 20 um: ours on the mesh of bearings, compared with ours", "kN",
                            ours(demo_roller()), fine));
  return checks;
}
}  // namespace mill::verify
