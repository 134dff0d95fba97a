#pragma once
#include "core/model/surface.h"
#include "core/numerics/sparse.h"
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

namespace mill::fem {
/// What acts on a body besides its contact: nodal loads on free unknowns, motions of held ones.
struct LoadCase {
  Eigen::VectorXd force;         ///< (unknowns) N; empty: none; what falls on a held unknown goes into the support
  Eigen::VectorXd displacement;  ///< (unknowns) m, of the held unknowns, others ignored; empty: they stay
};

struct SurfaceOptions {
  /// (d) outward, in the body's coordinates: the direction in which every node is pressed; empty: its own normal.
  /// Bodies that do not conform flatten to their common tangent plane, and press along its normal wherever they
  /// touch; the undeformed normals of a disc would be wrong there by x / R.  Conforming bodies need their own.
  Eigen::VectorXd direction;
  bool tangential = false;  ///< keep the tangential displacements too, for friction
  double memory   = 0;      ///< bytes the factor may take, 0: do not check
};

/// An elastic body reduced to one of its surfaces: displacements of the surface nodes along their true normals.
/// The kept unknowns come last in one sparse factorisation, whose trailing block gives the flexibility; the factor
/// stays, so that loads elsewhere and whole fields cost one substitution each.  theory.md 12
///
/// A body with free rigid motions is held at as few unknowns as stop them: these supports carry nothing once the
/// loads balance, and the motion itself is a driven mode of the contact (BodyPair).
class CondensedSurface {
public:
  /// @param stiffness   upper triangle, unknown components * node + direction
  /// @param components  2 (x, y or r, z) or 3
  /// @param held        (unknowns) 1: held; on a plane of symmetry the normal of a node is turned into the plane
  /// @throws InputError   a node of the surface is held along its normal; sizes that do not fit
  /// @throws SolverError  rigid motions left, or predicted memory too large
  /// Cost: the factorisation, and n^3 for the n kept unknowns.
  CondensedSurface(const SymmetricSparse &stiffness, int components, std::vector<char> held, Surface surface,
                   const SurfaceOptions &options = {});
  ~CondensedSurface();
  CondensedSurface(CondensedSurface &&) noexcept;

  const Surface &surface() const;
  /// (n, d) unit direction of each kept unknown: the outward normals (or the one direction) of all nodes, then, if
  /// kept, their first and (in space) second tangents.  A tangent that is held has the direction zero and no
  /// flexibility.
  const Eigen::MatrixXd &directions() const;
  /// (n, n) m/N, symmetric: displacement along the directions by forces along them.
  const Eigen::MatrixXd &flexibility() const;

  /// (n) m: displacement of the kept unknowns under a load case.
  Eigen::VectorXd response(const LoadCase &load) const;
  /// (unknowns) m: the whole field under forces on the kept unknowns and a load case.
  /// @param forces  (n) N, along the directions: a contact presses against the normals, so its forces are negative
  Eigen::VectorXd displacement(const Eigen::VectorXd &forces, const LoadCase &load = {}) const;
  /// (unknowns) N: what the supports exert on the held unknowns in that state; 0 elsewhere.
  /// @param field  of displacement() for the same load
  Eigen::VectorXd reactions(const Eigen::VectorXd &field, const LoadCase &load = {}) const;

  int n_unknowns() const;  ///< free ones
  const FactorCost &cost() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self;
};

/// Nodal forces of a pressure on a surface, against its outward normals, from the surface's own faces.
/// @param pressure  Pa, at a point (d) m
/// @return (n, d) N, by node of the surface (N/m in plane strain)
Eigen::MatrixXd pressure_load(const Surface &surface,
                              const std::function<double(const Eigen::VectorXd &)> &pressure);
/// Puts nodal forces of a surface into a load case of a body.
/// @param n_unknowns  of the body
LoadCase load_on(const Surface &surface, const Eigen::MatrixXd &forces, Eigen::Index n_unknowns);
}  // namespace mill::fem
