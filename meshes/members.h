#pragma once
#include "meshes/housing/housing.h"
#include "meshes/roll/roll.h"

// Member lists of mesh sizes; see core/base/each_member.h.
namespace mill::meshes {
template <class Io> void each_member(Io &&io, const SectionSize &record)
{
  const auto &[first_element, growth, patch_elements, depth_elements, depth_growth, far_growth, sector_elements] =
      record;
  io("first_element", first_element);
  io("growth", growth);
  io("patch_elements", patch_elements);
  io("depth_elements", depth_elements);
  io("depth_growth", depth_growth);
  io("far_growth", far_growth);
  io("sector_elements", sector_elements);
}

template <class Io> void each_member(Io &&io, const RollMeshSize &record)
{
  const auto &[section, end_layer, layer_growth, largest_layer, plain_elements, break_at] = record;
  io("section", section);
  io("end_layer", end_layer);
  io("layer_growth", layer_growth);
  io("largest_layer", largest_layer);
  io("plain_elements", plain_elements);
  io("break_at", break_at);
}

template <class Io> void each_member(Io &&io, const HousingMeshSize &record)
{
  const auto &[through, stretch, longest] = record;
  io("through", through);
  io("stretch", stretch);
  io("longest", longest);
}
}  // namespace mill::meshes
