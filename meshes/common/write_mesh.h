#pragma once
#include <functional>
#include <string>

namespace mill::meshes {
/// Lets `write` put a mesh (Gmsh 4.1, text) next to `path`, makes sure that all of it is there, and renames: Gmsh
/// itself does not look whether what it writes arrives.  Gmsh is one global state; here one thread has it at a
/// time.
/// @param write  writes the file of that name; returns what kept it from it, or ""
/// @throws SystemError  a full disk or a folder that cannot be written; nothing is left behind
void write_mesh(const std::string &path, const std::function<std::string(const std::string &aside)> &write);

/// What a mesh on disk lacks, or "": nodes and elements are counted against what the file announces, and the last
/// section must be closed.
std::string missing_of_mesh(const std::string &text);
}  // namespace mill::meshes
