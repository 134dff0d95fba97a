#pragma once
#include "core/model/material.h"
#include "core/model/mesh_file.h"
#include "core/model/roller_bearing.h"
#include <Eigen/Core>
#include <vector>

namespace mill {
/// Contact line of one row on a raceway, in a meridian plane: (r, z), z along the axis from the bearing's middle.
struct RacewayLine {
  Eigen::Vector2d middle;  ///< m, at mid-roller
  Eigen::Vector2d normal;  ///< -, (cos angle, hand sin angle), away from the axis
  Eigen::Vector2d along;   ///< -, along the line, towards greater z
  int hand = 1;            ///< +1 or -1: axial direction in which the row presses the cup
};

/// Meridian section of one ring: the raceways of its rows and the straight lines between them on one side, bore or
/// outside diameter on the other.
struct RingSection {
  bool inner = false;                 ///< the cone, on a solid neck; otherwise the cup
  std::vector<RacewayLine> raceways;  ///< ascending z
  double length      = 0;             ///< m, of a contact line
  double land        = 0;             ///< m, by which the raceway goes on straight beyond each end of the line
  double seat_radius = 0;             ///< m, half the bore or half the outside diameter
  double half_width  = 0;             ///< m, of the bearing
  double depth       = 0;             ///< m, the depth of raceway that the law of one roller includes
};

/// What surrounds the cup.
struct Housing {
  ChockForm kind       = ChockForm::block;
  double radius        = 0;  ///< m, at which a round housing is held; also that of a block's short harmonics
  double half_length   = 0;  ///< m, along the axis
  double width         = 0;  ///< m, of the block, across the load
  double height        = 0;  ///< m, of the block, along the load
  double support_width = 0;  ///< m, of the face that carries the block, centred on the load line
  double support_gap   = 0;  ///< m, middle part of that width which carries nothing: a block on two liners or feet
};

/// Everything that yields behind the rollers.
struct RingSections {
  RingSection cone, cup;
  Housing housing;
  Material material;
};

/// Meshes of the ring sections.  Meridian sections (r, z) of quadrilaterals with the groups raceway.0, raceway.1,
/// ... and, as far as they have them, axis, held; the block of hexahedra with contact (inner surface), support,
/// barrel (round only), symmetry.y, symmetry.z.
struct RingMeshes {
  MeshFile cone;              ///< with the neck
  MeshFile cup;               ///< with a round housing, or held on its outside diameter
  MeshFile cone_raceway;      ///< one raceway of hand +1 on a rigid back
  MeshFile cup_raceway;       ///< the same of the cup
  MeshFile chock;             ///< path empty: none
  MeshFile chock_section;     ///< the cup in its round housing with the lines of the block's mesh
  bool chock_halved = false;  ///< only z >= 0 is meshed, the other half is its mirror image
};

template <class Io> void each_member(Io &&io, const RacewayLine &record)
{
  const auto &[middle, normal, along, hand] = record;
  io("middle", middle);
  io("normal", normal);
  io("along", along);
  io("hand", hand);
}

template <class Io> void each_member(Io &&io, const RingSection &record)
{
  const auto &[inner, raceways, length, land, seat_radius, half_width, depth] = record;
  io("inner", inner);
  io("raceways", raceways);
  io("length", length);
  io("land", land);
  io("seat_radius", seat_radius);
  io("half_width", half_width);
  io("depth", depth);
}

template <class Io> void each_member(Io &&io, const Housing &record)
{
  const auto &[kind, radius, half_length, width, height, support_width, support_gap] = record;
  io("kind", kind);
  io("radius", radius);
  io("half_length", half_length);
  io("width", width);
  io("height", height);
  io("support_width", support_width);
  io("support_gap", support_gap);
}

template <class Io> void each_member(Io &&io, const RingSections &record)
{
  const auto &[cone, cup, housing, material] = record;
  io("cone", cone);
  io("cup", cup);
  io("housing", housing);
  io("material", at_rest(material));
}
}  // namespace mill
