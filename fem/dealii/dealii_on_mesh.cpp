#include "core/base/vector_alignment.h"
#include "fem/dealii/dealii_bodies.h"

namespace mill::fem {
// For a program that is linked with deal.II; one that opens it has that of fem/body/opened_on_mesh.cpp.
const OnMesh &found_on_mesh()
{
  return *millstand_on_mesh();
}
}  // namespace mill::fem

/// By which a program tells whether a library is of its own build.
extern "C" __attribute__((visibility("default"))) const char *const millstand_build;
const char *const millstand_build = MILLSTAND_BUILD;
extern "C" __attribute__((visibility("default"))) const int millstand_vector_alignment;
const int millstand_vector_alignment = mill::vector_alignment;

extern "C" __attribute__((visibility("default"))) const mill::fem::OnMesh *millstand_on_mesh()
{
  using namespace mill::fem;
  static const OnMesh all{dealii_use_threads, dealii_solid, dealii_section};
  return &all;
}
