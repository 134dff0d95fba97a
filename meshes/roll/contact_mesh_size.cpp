#include "meshes/roll/contact_mesh_size.h"
#include <cmath>

namespace mill::meshes {
namespace {
// A slab's contact has the Hertz width; its patch is a little wider.
constexpr double slab_reach = 1.2;
// The box is deeper than the largest shear stress, which lies 0.78 half widths below the surface.
constexpr double box_depth = 1.2;

int depth_elements_for(const double first, const double growth, const double depth)
{
  return patch_elements_for(first, growth, depth);
}
}  // namespace

RollMeshSize roll_contact_size(const double half_width, const int per_half_width, const double reach)
{
  RollMeshSize size;
  size.section.first_element  = half_width / per_half_width;
  size.section.growth         = 1;
  size.section.patch_elements = patch_elements_for(size.section.first_element, 1, reach * half_width);
  size.section.depth_growth   = 1.25;
  size.section.depth_elements = depth_elements_for(size.section.first_element, 1.25, box_depth * half_width);
  size.end_layer              = 3 * size.section.first_element;  // the end zone of a contact is about b long
  return size;
}

RollMeshSize coarsened(const RollMeshSize &fine)
{
  RollMeshSize size       = fine;
  const double half_width = patch_half_width(fine.section);
  const double depth      = fine.section.first_element *
                       (std::pow(fine.section.depth_growth, fine.section.depth_elements) - 1) /
                       (fine.section.depth_growth - 1);
  size.section.first_element = 2 * fine.section.first_element;
  size.section.growth        = std::pow(fine.section.growth, 2);
  size.section.patch_elements =
      patch_elements_for(size.section.first_element, size.section.growth, half_width * (1 - 1e-9));
  size.section.depth_growth = std::pow(fine.section.depth_growth, 2);
  size.section.depth_elements =
      depth_elements_for(size.section.first_element, size.section.depth_growth, 0.8 * depth);
  size.section.far_growth      = std::pow(fine.section.far_growth, 2);
  size.section.sector_elements = (fine.section.sector_elements + 1) / 2;
  size.end_layer               = 2 * fine.end_layer;
  size.layer_growth            = std::pow(fine.layer_growth, 2);
  size.largest_layer           = 2 * fine.largest_layer;
  return size;
}

RollMeshSize slab_contact_size(const double smallest, const double largest, const int per_half_width)
{
  RollMeshSize size;
  // Elements of half the wanted size at the line, growing so that one at distance b measures b / per_half_width.
  size.section.first_element = 0.5 * smallest / per_half_width;
  size.section.growth        = 1 + 0.5 / per_half_width;
  size.section.patch_elements =
      patch_elements_for(size.section.first_element, size.section.growth, slab_reach * largest);
  size.section.depth_growth   = 1.15;
  size.section.depth_elements = depth_elements_for(size.section.first_element, 1.15, box_depth * largest);
  return size;
}
}  // namespace mill::meshes
