#pragma once
#include "core/model/housing.h"
#include "meshes/roll/roll.h"
#include "tests/manual/peer/mesh.h"
#include <functional>
#include <vector>

// What the peer solves: the drawings of the product's cases, meshed in blocks.
namespace mill::verify::peer {
/// An eighth of a roll with necks, x, y, z >= 0, z along the axis from mid-length: `n` elements on the half of the
/// neck's radius that is not a square, and on average as long along the axis; crowded at the shoulder (distances
/// from it grow with the square); middle nodes on the true circles.
Mesh roll_eighth(const RollGeometry &roll, int n);

/// Section of a disc or plain cylinder, crowded at the contact: elements of half_width / n on one and a half half
/// widths, from there to the middle each `growth` times as large.
struct DiscSection {
  double radius;      ///< m
  double half_width;  ///< m, of the contact
  int n;              ///< elements on it
  double growth;      ///< -
};

/// A quarter, x, y >= 0, between the lines z (m), crowded at (0, radius).
Mesh disc_quarter(const DiscSection &section, const std::vector<double> &z);

/// A half, x >= 0, between the lines z (m), crowded at (0, radius) and (0, -radius).
Mesh disc_half(const DiscSection &section, const std::vector<double> &z);

/// A quarter, x, z >= 0, of the piece of a raceway between its surface and a concentric back, cut off radially;
/// the contact point is the origin, y points out of the piece.
struct RacewayBlock {
  double radius;                    ///< m, > 0 convex, < 0 concave
  std::vector<double> x, depth, z;  ///< m, mesh lines from 0: across on the surface, below it, along the axis
};
Mesh raceway_quarter(const RacewayBlock &block);

/// Lines from 0 to `length` (m): `n` elements of the size `first` at 0, growing by `growth` from there.
std::vector<double> growing_lines(double length, double first, int n, double growth);

/// The body with every node moved to where `place` says, which turns nothing inside out.
Mesh moved(Mesh body, const std::function<Eigen::Vector3d(const Eigen::Vector3d &)> &place);

/// The same body upside down with its middle at the height y.
Mesh turned_over(Mesh body, double y);

/// A quarter of a housing, x >= 0 across the window from its middle, y up from the window's bottom, z >= 0 over
/// half of the thickness: `n` elements through beams and posts, two more lines for the pads, fillets as arcs.
Mesh housing_quarter(const MillHousing &housing, int n);
}  // namespace mill::verify::peer
