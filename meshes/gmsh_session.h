#pragma once

namespace mill::meshes
{
/// Gmsh is one global state: a session owns it from construction to destruction.  Silent; one model.
class GmshSession {
public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession &) = delete;
  GmshSession &operator=(const GmshSession &) = delete;
};
} // namespace mill::meshes
