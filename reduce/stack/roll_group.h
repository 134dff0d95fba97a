#pragma once
#include "core/model/stack.h"
#include "reduce/stack/beam_element.h"
#include "reduce/stack/block_tridiagonal.h"
#include "reduce/stack/line_law.h"
#include "reduce/stack/stations.h"
#include <Eigen/SparseCore>
#include <functional>
#include <vector>

namespace mill::reduce {
/// Factors of some unknowns of a group.
struct UnknownRow {
  std::vector<Eigen::Index> unknown;
  std::vector<double> factor;
  void add(Eigen::Index i, double f);
  double dot(const Eigen::VectorXd &u) const;
  void add_to(Eigen::Ref<Eigen::VectorXd> f, double times) const;
};

/// The contact of two rolls in one element: its approach at each Gauss point is row . u - gap.
struct ContactElement {
  std::size_t contact = 0;                                  ///< place in Stack::contacts
  std::vector<Eigen::Index> unknown;                        ///< (k) of both rolls
  Eigen::Matrix<double, Eigen::Dynamic, UnitGauss::n> row;  ///< (k, points)
  Eigen::Array<double, UnitGauss::n, 1> z, weight, gap, load, tangent, approach;
};

/// Rolls that touch each other, as beams: one half of a stack, in equilibrium under the line load of the strip.
class RollGroup {
public:
  RollGroup(const Stack &stack, const Stations &stations, std::vector<std::size_t> rolls, bool both_planes);

  bool holds(std::size_t roll) const;
  Eigen::Index size() const
  {
    return forces.size();
  }
  /// Deflection of a roll along x or y at its stations.
  Eigen::VectorXd deflection(std::size_t roll, std::size_t axis) const;
  /// Integral of `factor` times the deflection along y from z1 to z2 (m, mill frame).
  UnknownRow integral(std::size_t roll, double z1, double z2, double factor) const;
  /// Deflection at z (m, mill frame) along an axis; empty where the roll does not move along it.
  UnknownRow deflection_at(std::size_t roll, double z, std::size_t axis) const;
  /// Unit force at a place of a roll's own frame.
  Eigen::VectorXd force_at(const StackLoad &load, std::size_t roll) const;
  /// Forces per unit of a radius departure of a roll, at the last update().
  Eigen::VectorXd force_of_radius(std::size_t roll, const std::function<double(double)> &departure) const;
  /// Stations of a roll, m.
  Eigen::VectorXd places(std::size_t roll) const;

  void update();                              ///< loads and tangents of the contacts at u
  Eigen::VectorXd out_of_balance() const;     ///< N, N m, without the strip
  bool factorise(double least_tangent);       ///< at the last update(); false where a roll is not held
  bool factorise_touching(double line_load);  ///< all contacts closed, tangents at this line load
  double largest_force(const Eigen::VectorXd &residual) const;  ///< moments left out
  /// N, to which out_of_balance() is known: a short element is so stiff that the last digit of a deflection is
  /// felt.
  double rounding() const;
  Eigen::SparseMatrix<double> mass_matrix() const;

  /// Planes in which the rolls move: 1 for y, 0 for x.
  const std::vector<std::size_t> &planes() const
  {
    return axes;
  }
  /// A roll in one plane by itself: deflection and rotation station by station, chocks with their mass, without
  /// what holds it.
  struct FreeBeam {
    Eigen::MatrixXd stiffness, mass;
  };
  FreeBeam free_beam(std::size_t roll) const;
  /// Place of each unknown of free_beam() among those of the group.
  std::vector<Eigen::Index> unknowns(std::size_t roll, std::size_t axis) const;

  Eigen::VectorXd u;                     ///< unknowns, m and rad
  std::vector<ContactElement> contacts;  ///< all elements that may touch
  BlockTridiagonal stiffness;            ///< factorised

private:
  struct Beam {
    std::size_t roll;
    int first, last;  // stations
    std::vector<BeamElement> elements;
    std::vector<Eigen::Index> unknown;  // of each station: the first of its 2 or 4
  };
  std::size_t local(std::size_t roll) const;
  Eigen::Index unknown_of(const Beam &beam, int station, std::size_t axis) const;
  void make_beams();
  void make_contacts();
  void assemble();
  std::vector<Eigen::Index> number_unknowns();

  const Stack &stack;
  const Stations &stations;
  std::vector<std::size_t> axes;  // 1: y; 0: x
  std::vector<Beam> beams;
  std::vector<LineLaw> laws;  // as Stack::contacts
  Eigen::SparseMatrix<double> beams_alone;
  Eigen::VectorXd forces;
};
}  // namespace mill::reduce
