#pragma once
#include "fem/body/elastic_body.h"
#include <memory>
#include <string>
#include <vector>

namespace mill::fem {
/// How a meshed part of a body is held, and which rigid motions that leaves.  Unknowns as in ElasticBody.
struct PartSupport {
  std::vector<char> held;  ///< (3N) 1: held by a symmetry plane or by the ground, or pinned for a rigid motion
  Eigen::MatrixXd rigid;   ///< (3N, r) the rigid motions, as they are without the pins; r = 0: the body is held
  std::vector<std::string> rigid_names;  ///< (r) "along y"
  int copies = 1;                        ///< parts that make the whole body: 8 when an eighth is meshed
};

/// Displacements by which a body is joined to others, each a weighted mean over a volume or a face: q = W^T u.
/// Their reaction is that body force or pressure.
struct PartInterface {
  std::vector<std::string> names;  ///< (i) "barrel P0", "seat"
  Eigen::MatrixXd weights;         ///< (3N, i) -, W; zero where symmetry holds
};

/// A meshed part, factorised with its pins, and its mass.  theory.md 21.2
///
/// All vectors have 3N rows.  Stiffness, mass and loads are those of the part that is meshed; the caller counts
/// the whole body multiplies by copies().  The body must outlive the model.
class PartModel {
public:
  /// Cost: one factorisation.
  /// @throws InputError   a rigid motion is neither held nor named in `support`: names part and direction
  /// @throws SolverError  the stiffness is not positive definite
  PartModel(std::string name, const ElasticBody &body, PartSupport support);
  ~PartModel();
  PartModel(PartModel &&) noexcept;

  const std::string &name() const;
  const ElasticBody &body() const;
  const PartSupport &support() const;
  int copies() const;
  int n_unknowns() const;       ///< that are not held
  double mass() const;          ///< kg, of the whole body
  double time_unit() const;     ///< s, sqrt(mass of the part / stiffness_unit): makes eigenvalues of order one
  double factor_bytes() const;  ///< bytes

  /// (3N, k) m: G F, displacement under loads F (3N, k) in N, with the pins; loads on held unknowns have no
  /// effect.
  Eigen::MatrixXd solve(const Eigen::MatrixXd &F) const;
  /// (3N, k) kg: M U.
  Eigen::MatrixXd mass_times(const Eigen::MatrixXd &U) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self;
};

/// Displacement of a part whose interface is prescribed or loaded: u = G (f + W l) + R c with W^T u = q and
/// R^T (f + W l) = 0, (21.4); exact in spite of the pins, because the loads balance.
class BorderedPart {
public:
  /// @throws InputError  the interface does not hold a rigid motion of the part: names part and direction
  BorderedPart(const PartModel &part, const PartInterface &interface);

  Eigen::MatrixXd constraint_modes;  ///< (3N, i) u for f = 0, q = unit vectors
  Eigen::MatrixXd reactions;         ///< (i, i) N/m, l of those: stiffness of the part on its interface
  /// (3N, k) m: T F, displacement under loads F (3N, k) in N with the interface at rest, (21.5).
  Eigen::MatrixXd held_solve(const Eigen::MatrixXd &F) const;

private:
  const PartModel *part;
  const PartInterface *interface;
  Eigen::MatrixXd GW, border_inverse;
};

/// Highest frequency a mesh of quadratic elements shows, Hz: there the frequency of a bending wave is too high by
/// the 0.42 % of a shear wave that is four elements long.  Elements that are long against a thin bar are too stiff
/// in bending, so that the wave must be longer.  (21.11), (21.12)
/// @param element  m, longest element along the wave
/// @param radius   m, of the bar that bends; of another section: twice its radius of gyration
double mesh_reach(double element, double radius, const Material &material);
}  // namespace mill::fem
