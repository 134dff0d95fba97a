#pragma once
#include "fem/body/on_mesh.h"

// The functions of OnMesh, and the one name by which a library that holds them is asked for it.
namespace mill::fem {
void dealii_use_threads(int n);
SolidOnMesh dealii_solid(const MeshFile &mesh, const Material &material, int degree);
SectionOnMesh dealii_section(const MeshFile &mesh, const Material &material, int degree, Section section,
                             const std::vector<Circle> &circles);
}  // namespace mill::fem

extern "C" const mill::fem::OnMesh *millstand_on_mesh();
