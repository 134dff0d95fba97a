#pragma once
#include <string>
#include <vector>

namespace mill::meshes {
inline constexpr int line_type = 1, quad_type = 3, hex_type = 5;  ///< Gmsh's numbers of element types

/// Gmsh is one global state: this scope opens it and closes it, silent and with one model.  Whoever calls holds
/// rand_access(), as write_mesh() does.
class GmshScope {
public:
  GmshScope();
  ~GmshScope();
  GmshScope(const GmshScope &)            = delete;
  GmshScope &operator=(const GmshScope &) = delete;
};

/// Layers of one element each on top of one another, as geo::extrude takes them.
struct StackedLayers {
  double length = 0;            ///< m
  std::vector<int> elements;    ///< 1 for each layer
  std::vector<double> heights;  ///< -, upper end of each layer over the length
};
StackedLayers stacked(const std::vector<double> &layers);

/// Writes the current model's mesh (Gmsh 4.1, text); returns what Gmsh says why not, or "".
std::string write_model(const std::string &path);
}  // namespace mill::meshes
