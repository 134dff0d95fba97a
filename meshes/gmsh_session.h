#pragma once
#include <string>

namespace mill::meshes {
std::string library_version();  ///< of Gmsh, "4.8.4"

/// Gmsh is one global state: a session owns it from construction to destruction.  Silent; one model.
class GmshSession {
public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession &)            = delete;
  GmshSession &operator=(const GmshSession &) = delete;
};
}  // namespace mill::meshes
