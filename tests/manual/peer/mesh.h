#pragma once
#include <Eigen/Core>
#include <array>
#include <functional>
#include <map>
#include <vector>

// Meshes for the peer: blocks of twenty-node hexahedra, made here from the drawing and from nothing else, so that
// a fault of the product's meshes cannot be in both.
namespace mill::verify::peer {
/// Twenty nodes per element in the order of CalculiX (C3D20): corners of the bottom, of the top, middles of the
/// bottom's edges, of the top's, of the upright ones.
struct Mesh {
  std::vector<Eigen::Vector3d> nodes;            ///< m
  std::vector<std::array<int, 20>> elements;     ///< positions in nodes
  std::map<std::array<long, 3>, int> positions;  ///< of a node by its rounded place, which joins blocks
};

/// A face of a mesh: element and face 1..6 in the numbering of CalculiX.
struct Face {
  int element = 0, face = 1;
};

/// Node weights: integral of each shape function.
using Weights = std::map<int, double>;

/// Lines 0 .. 1 of n elements of equal size.
std::vector<double> even(int n);

/// Lines 0 .. 1: `n` elements of the size `first` at 1, growing by `growth` towards 0.
std::vector<double> towards_end(double first, int n, double growth);

/// Adds a block: its elements lie between the lines u, v, w of the unit cube, which `place` maps to space (m).
/// Nodes at equal places are one node, middle nodes lie where `place` puts them, and a map that mirrors is turned.
void add_block(Mesh &mesh, const std::vector<double> &u, const std::vector<double> &v,
               const std::vector<double> &w, const std::function<Eigen::Vector3d(double, double, double)> &place);

/// Adds a body that shares no node with the others.
void append(Mesh &mesh, const Mesh &body);

/// Positions of the nodes that satisfy the condition.
std::vector<int> nodes_where(const Mesh &mesh, const std::function<bool(const Eigen::Vector3d &)> &condition);

/// Faces all of whose eight nodes satisfy the condition.
std::vector<Face> faces_where(const Mesh &mesh, const std::function<bool(const Eigen::Vector3d &)> &condition);

/// Integrals of the shape functions over faces (m2), and of a density times them over the body (m3 of the
/// density); nodes of elements in which the density is zero do not appear.
Weights over_faces(const Mesh &mesh, const std::vector<Face> &faces);
Weights over_body(const Mesh &mesh, const std::function<double(const Eigen::Vector3d &)> &density);

/// Sum of the weights: area or volume.
double total(const Weights &weights);
}  // namespace mill::verify::peer
