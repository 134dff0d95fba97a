#pragma once
#include "core/model/ring_sections.h"
#include <Eigen/Core>
#include <vector>

namespace mill::meshes {
struct RingGridSize {
  int on_raceway        = 8;    ///< elements on a contact line, thinner towards its ends
  int on_land           = 1;    ///< on the straight raceway beyond each end
  int in_wall           = 4;    ///< through the ring, thinnest under the raceway
  double beyond_growth  = 1.6;  ///< -, of neighbouring elements through neck or housing
  double beyond_element = 0;    ///< m, largest there and between the rows; 0: a quarter of the contact line
  int in_reference      = 5;    ///< through a raceway on its rigid back
};

/// Product grid of a ring's meridian section: columns along the axis, layers outwards; some cells are missing.
struct RingGrid {
  int n_columns = 0, n_layers = 0;      ///< nodes
  std::vector<Eigen::Vector2d> points;  ///< (layer * n_columns + column) m, (r, z)
  std::vector<char> kept;               ///< (layer * (n_columns - 1) + column) 1: there is a cell
  int seat_layer = 0;                   ///< layer on bore or outside diameter
  int point(const int column, const int layer) const
  {
    return layer * n_columns + column;
  }
};

/// Cone on its solid neck, both as long as the bearing is wide: layers from the axis to the raceways.
RingGrid cone_grid(const RingSection &cone, const RingGridSize &size);
/// Cup in a round housing of its own length: layers from the raceways to the radius at which the housing is held.
RingGrid cup_grid(const RingSection &cup, const Housing &housing, const RingGridSize &size);
/// The first raceway as if its hand were +1, on a back parallel to it at the section's depth.
RingGrid raceway_grid(const RingSection &section, const RingGridSize &size);
}  // namespace mill::meshes
