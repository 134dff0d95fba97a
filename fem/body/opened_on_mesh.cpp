#include "core/process/own_library.h"
#include "fem/body/on_mesh.h"

namespace mill::fem {
const OnMesh &found_on_mesh()
{
  return *reinterpret_cast<const OnMesh *(*)()>(function_of_own_library(finite_elements, "millstand_on_mesh"))();
}
}  // namespace mill::fem
