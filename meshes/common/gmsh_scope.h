#pragma once
#include <mutex>
#include <string>

namespace mill::meshes {
inline constexpr int line_type = 1, quad_type = 3, hex_type = 5;  ///< Gmsh's numbers of element types

std::string library_version();  ///< of Gmsh, "4.8.4"

/// Gmsh is one global state: this scope owns it from construction to destruction, and other threads wait for it.
/// Silent; one model.
class GmshScope {
public:
  GmshScope();
  ~GmshScope();
  GmshScope(const GmshScope &)            = delete;
  GmshScope &operator=(const GmshScope &) = delete;

private:
  std::unique_lock<std::mutex> alone;
};
}  // namespace mill::meshes
