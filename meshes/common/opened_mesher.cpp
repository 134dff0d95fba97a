#include "core/process/own_library.h"
#include "meshes/common/mesher.h"

namespace mill::meshes {
const Mesher &mesher()
{
  static const auto opened =
      reinterpret_cast<const Mesher *(*)()>(function_of_own_library(finite_elements, "millstand_mesher"));
  return *opened();
}
}  // namespace mill::meshes
