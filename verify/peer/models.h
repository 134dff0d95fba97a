#pragma once
#include "core/model/stand.h"
#include "meshes/roll/roll.h"
#include "verify/peer/mesh.h"

// What the peer solves: the drawings of the product's cases, meshed in blocks.
namespace mill::verify::peer {
/// An eighth of a roll with necks, x, y, z >= 0, z along the axis from mid-length: `n` elements on the half of the
/// neck's radius that is not a square, and on average as long along the axis; crowded at the shoulder (distances
/// from it grow with the square); middle nodes on the true circles.
Mesh roll_eighth(const RollGeometry &roll, int n);

/// A quarter of a disc or plain cylinder, x, y >= 0, between the lines z (m), crowded at (0, radius): elements of
/// half_width / n on one and a half half widths, from there to the middle each `growth` times as large.
Mesh disc_quarter(double radius, const std::vector<double> &z, double half_width, int n, double growth);

/// The same body upside down with its middle at the height y.
Mesh turned_over(Mesh body, double y);

/// A quarter of a housing, x >= 0 across the window from its middle, y up from the window's bottom, z >= 0 over
/// half of the thickness: `n` elements through beams and posts, two more lines for the pads, fillets as arcs.
Mesh housing_quarter(const MillHousing &housing, int n);
}  // namespace mill::verify::peer
