#include "meshes/bearing/chock.h"
#include "meshes/bearing/ring_grid.h"
#include "meshes/common/cells.h"
#include <algorithm>
#include <cmath>

namespace mill::meshes {
namespace {
// Distance from the axis to the surface of the housing.
double outside(const Housing &h, const double theta)
{
  if (h.kind == ChockForm::round)
    return h.radius;
  const double c = std::abs(std::cos(theta)), s = std::abs(std::sin(theta));
  return std::min(c > 1e-12 ? 0.5 * h.height / c : 1e300, s > 1e-12 ? 0.5 * h.width / s : 1e300);
}

// Angles from 0 to pi, with lines through the end of the support and the corners.
std::vector<double> angles(const Housing &h, const double refinement)
{
  std::vector<double> corners{0};
  if (h.kind == ChockForm::block) {
    if (h.support_gap > 0)
      corners.push_back(std::atan2(h.support_gap, h.height));
    if (h.support_width < h.width * (1 - 1e-6))
      corners.push_back(std::atan2(h.support_width, h.height));
    corners.push_back(std::atan2(h.width, h.height));
    corners.push_back(M_PI - corners.back());
  }
  corners.push_back(M_PI);
  std::vector<double> out{0};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double span = corners[i] - corners[i - 1];
    // More than 20 degrees bend an element's straight outer side below the thin wall of the cup; next to the end
    // of the support 10 are wanted, and a coarser mesh must tell what they are worth.
    const double widest = std::min(M_PI / 9, M_PI / 18 / std::pow(refinement, 3));
    const int fewest    = int(std::ceil(span / widest - 1e-9));
    const int n         = std::max(fewest, int(std::lround(span / (M_PI / 14) * refinement)));
    for (int k = 1; k <= n; ++k)
      out.push_back(corners[i - 1] + span * k / n);
  }
  return out;
}

}  // namespace

RingGridSize chock_grid_size(const RingSection &cup, const double refinement)
{
  RingGridSize size;
  size.on_raceway     = std::max(2, int(std::lround(3 * refinement)));
  size.on_land        = 0;  // too short to matter to the long waves for which the block is there
  size.in_wall        = std::max(1, int(std::lround(2 * refinement)));
  size.beyond_growth  = std::pow(2.5, 1 / refinement);
  size.beyond_element = 0.6 * cup.length / refinement;
  return size;
}
bool mirrored_rows(const RingSection &cup)
{
  const std::size_t n = cup.raceways.size();
  if (n % 2 != 0)
    return false;
  for (std::size_t r = 0; r < n / 2; ++r) {
    const RacewayLine &a = cup.raceways[r], &b = cup.raceways[n - 1 - r];
    if (std::abs(a.middle[1] + b.middle[1]) + std::abs(a.middle[0] - b.middle[0]) > 1e-9 * cup.length ||
        std::abs(a.normal[1] + b.normal[1]) > 1e-9)
      return false;
  }
  return true;
}

MeshFile mesh_chock(const RingSection &cup, const Housing &housing, const double refinement,
                    const std::string &path)
{
  const RingGrid section = cup_grid(cup, housing, chock_grid_size(cup, refinement));
  const auto theta       = angles(housing, refinement);
  const bool halved      = mirrored_rows(cup);
  const int per_angle    = int(section.points.size());
  CellMesh mesh;
  for (const double t : theta)
    for (const Eigen::Vector2d &p : section.points) {
      double r = p[0];
      if (r > cup.seat_radius)
        r = cup.seat_radius +
            (r - cup.seat_radius) / (housing.radius - cup.seat_radius) * (outside(housing, t) - cup.seat_radius);
      const bool at_end = t == theta.back() || t == 0;  // exactly on the plane of symmetry
      mesh.points.push_back({r * std::cos(t), at_end ? 0 : r * std::sin(t), p[1]});
    }
  for (int k = 0; k + 1 < int(theta.size()); ++k)
    for (int j = 0; j + 1 < section.n_layers; ++j)
      for (int i = 0; i + 1 < section.n_columns; ++i) {
        const auto &a = section.points[std::size_t(section.point(i, 0))],
                   &b = section.points[std::size_t(section.point(i + 1, 0))];
        if (!section.kept[std::size_t(j * (section.n_columns - 1) + i)] || (halved && a[1] + b[1] < 0))
          continue;
        // z, then outwards, then around: right-handed.
        std::vector<int> cell;
        for (const int turn : {k, k + 1})
          for (const int corner : {section.point(i, j), section.point(i + 1, j), section.point(i + 1, j + 1),
                                   section.point(i, j + 1)})
            cell.push_back(turn * per_angle + corner);
        mesh.cells.push_back(cell);
      }
  const double half_support = 0.5 * housing.support_width, half_gap = 0.5 * housing.support_gap;
  mesh.group = [&](const std::vector<int> &corners) -> std::string {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    bool inside = true, seat = true, rim = true;
    double lowest = 1e300;
    for (const int c : corners) {
      const auto &p   = mesh.points[std::size_t(c)];
      const int layer = c % per_angle / section.n_columns;
      middle += 0.25 * Eigen::Vector3d(p[0], p[1], p[2]);
      lowest = std::min(lowest, p[0]);
      inside = inside && layer == 0;
      seat   = seat && layer == section.seat_layer;
      rim    = rim && layer == section.n_layers - 1;
    }
    if (inside)
      return "contact";
    if (seat)
      return "neck";
    if (rim && housing.kind == ChockForm::round)
      return "barrel";
    if (rim && lowest > 0.5 * housing.height * (1 - 1e-9) && middle[1] < half_support && middle[1] > half_gap)
      return "support";
    if (std::abs(middle[1]) < 1e-9 * cup.seat_radius)
      return "symmetry.y";
    if (halved && std::abs(middle[2]) < 1e-9 * cup.seat_radius)
      return "symmetry.z";
    return "";
  };
  return write_cells(mesh, path);
}
}  // namespace mill::meshes
