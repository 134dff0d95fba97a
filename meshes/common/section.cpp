#include "meshes/common/section.h"

namespace mill::meshes {
int patch_elements_for(const double first_element, const double growth, const double half_width)
{
  int n = 3;
  while (sum_of(first_element, growth, n) < half_width)
    n += 3;
  return n;
}

double plain_contact_half_width(const double radius)
{
  return radius * std::sqrt(0.5);
}
}  // namespace mill::meshes
