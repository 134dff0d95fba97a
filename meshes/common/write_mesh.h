#pragma once
#include <string>

namespace mill::meshes {
/// Writes the current model's mesh (Gmsh 4.1, text) beside `path`, makes sure that all of it is there, and
/// renames. Gmsh itself does not look whether what it writes arrives.
/// @throws SystemError  a full disk or a folder that cannot be written; nothing is left behind
void write_mesh(const std::string &path);

/// What a mesh on disk lacks, or "": nodes and elements are counted against what the file announces, and the last
/// section must be closed.
std::string missing_of_mesh(const std::string &text);
}  // namespace mill::meshes
