#pragma once
#include "core/model/roll.h"
#include "core/records/component.h"
#include "core/records/stand_model.h"
#include "reduce/chain/timoshenko_beam.h"
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mill::reduce {
/// A roll as the stand sees it, made from a beam or from a component.  Whole roll, n unknowns.
/// Along the barrel the mean displacement of a section is barrel_rows(z) q: interpolated between the nodes of a
/// beam, Legendre polynomials of a component.
struct RollBody {
  std::string name;          ///< "upper backup roll"
  Eigen::MatrixXd M;         ///< (n, n) kg, without bearings and chocks
  Eigen::MatrixXd K;         ///< (n, n) N/m
  Eigen::MatrixXd residual;  ///< (n, n) kg s2, of modes left out; empty: none are left out
  double half_barrel = 0;    ///< m
  Eigen::VectorXd nodes;     ///< (k) m, nodes of a beam, unknown i at node i; empty: Legendre coefficients first
  int n_barrel = 0;          ///< -, number of Legendre coefficients; 0 for a beam
  Eigen::VectorXd seat;      ///< (n) -, displacement of the bearing seats
  std::vector<StandUnknown> unknowns;  ///< (n)
  Eigen::VectorXd axis_z;              ///< (k) m, stations of the axis
  Eigen::MatrixXd axis;                ///< (k, n) -
};

/// Roll of stepped Timoshenko beams: barrel, neck to the bearing centre, overhang to the end of the roll, each
/// with `elements` elements.  A barrel longer than `common_half_barrel` gets a node there, so that facing rolls
/// have nodes face to face.
/// @param scale  -, factor on the sections' stiffness (1: as drawn)
/// @throws InputError  a dimension not positive, a bearing centre inside the barrel or outside the roll
RollBody beam_roll(const std::string &name, const Roll &roll, const Material &steel, int elements,
                   double common_half_barrel, double scale = 1);

/// Interface displacements, then amplitudes of the mass-normalised modes.
std::vector<StandUnknown> component_unknowns(const Component &component);

/// Roll of a component with barrel functions and an interface displacement "seat".
/// @throws InputError  the component has none of these, or matrices of unlike size
RollBody component_roll(const std::string &name, const Component &component);

/// (points, n): mean displacement of the barrel's sections at z (m, 0 <= z <= half_barrel).
Eigen::MatrixXd barrel_rows(const RollBody &roll, const Eigen::VectorXd &z);

/// (n): displacement of the axis at z (m), linear between the stations.
Eigen::VectorXd axis_row(const RollBody &roll, double z);

/// Sections at which two barrels, or a barrel and the strip, act on each other, with the part of the whole length
/// (both halves) that belongs to each.
struct LinePoints {
  Eigen::VectorXd z;      ///< (p) m
  Eigen::VectorXd share;  ///< (p) -, sum 1
};

/// Points over 0 <= z <= half_length for an even distribution.  Two beams: their nodes, each with the integral of
/// its hat function.  Otherwise Gauss points, exact for products of the barrel functions.
LinePoints line_points(const RollBody &a, const RollBody &b, double half_length);
}  // namespace mill::reduce
