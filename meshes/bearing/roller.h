#pragma once
#include "core/model/roller_setup.h"
#include <string>

namespace mill::meshes {
/// Meshes an eighth of the roller and quarters of both raceways, files folder/name.*.msh.
/// @throws InputError   as completed(setup)
/// @throws SolverError  a mesh that failed its checks
RollerMeshes mesh_roller(const RollerSetup &setup, const std::string &folder, const std::string &name = "roller");

/// Removes the files of such meshes.
void remove_meshes(const RollerMeshes &meshes);
}  // namespace mill::meshes
