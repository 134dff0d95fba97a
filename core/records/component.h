#pragma once
#include "core/base/each_member.h"
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mill {
/// Outside of an eighth of a meshed roll (x, y, z >= 0), with what each coordinate of its component does there.
/// Moved along y the displacement along y is even about all three planes; about y = 0 those along x and z are odd.
struct ComponentSurface {
  Eigen::MatrixXd position;      ///< (s, 3) m
  Eigen::MatrixXd faces;         ///< (f, 4) numbers of points, corners in turn
  Eigen::MatrixXd displacement;  ///< (3 s, n) x, y, z of each point in turn
  Eigen::MatrixXd stress;        ///< (6 s, n) Pa per unit: xx yy zz xy xz yz of each point in turn
};

template <class Io, class R, if_record<R, ComponentSurface> = 0> void each_member(Io &&io, R &record)
{
  auto &[position, faces, displacement, stress] = record;
  io("position", position);
  io("faces", faces);
  io("displacement", displacement);
  io("stress", stress);
}

/// A body reduced to its interface and to its modes with that interface held (Craig and Bampton 1968).
/// Coordinates, in this order: n_i interface displacements, then n_m modal amplitudes.  theory.md 21
///
/// Everything refers to the whole body (all symmetric parts of it), so that q^T M q / 2 is its kinetic energy.
struct Component {
  std::string name;                    ///< "work roll", "backup roll", "housing"
  std::string source;                  ///< how it was made: "finite elements, 12 345 unknowns of an eighth"
  std::vector<std::string> interface;  ///< (n_i) "barrel P0", "barrel P2", .., "seat"; "screw", "seat"
  /// The first n_barrel interface coordinates are Legendre coefficients c_j of the mean displacement of the
  /// barrel's sections:  u(z) = sum_j c_j P_2j(z / half_barrel).  0: no barrel.
  int n_barrel       = 0;
  double half_barrel = 0;           ///< m
  Eigen::MatrixXd M;                ///< (n, n) kg
  Eigen::MatrixXd K;                ///< (n, n) N/m; no coupling between interface and modes
  Eigen::VectorXd fixed_frequency;  ///< (n_m) Hz, of the modes with the interface held, ascending
  /// (n_i, n_i) kg s2: what the modes that were left out contribute at low frequency.  A mode of the assembly with
  /// interface part q (mass-normalised) and angular frequency w is too high by the share  w^2 q^T residual q / 2.
  Eigen::MatrixXd residual;
  Eigen::VectorXd axis_z;  ///< (k) m, stations along the axis from mid-length to the end; empty: no axis
  Eigen::MatrixXd axis;    ///< (k, n) mean displacement of the section at each station
  double mass  = 0;        ///< kg, of the whole body
  double reach = 0;        ///< Hz, up to which the mesh can follow a wave (theory.md 21)
  /// Elements per radius of the mesh it was made from, which may be more than asked for; 0: not a meshed roll.
  int elements_per_radius = 0;
  ComponentSurface surface;  ///< empty but for a roll by finite elements
  Eigen::Index n_interface() const
  {
    return Eigen::Index(interface.size());
  }
};

template <class Io, class R, if_record<R, Component> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, source, interface, n_barrel, half_barrel, M, K, fixed_frequency, residual, axis_z, axis, mass,
         reach, elements_per_radius, surface] = record;
  io("name", name);
  io("source", source);
  io("interface", interface);
  io("n_barrel", n_barrel);
  io("half_barrel", half_barrel);
  io("M", M);
  io("K", K);
  io("fixed_frequency", fixed_frequency);
  io("residual", residual);
  io("axis_z", axis_z);
  io("axis", axis);
  io("mass", mass);
  io("reach", reach);
  io("elements_per_radius", elements_per_radius);
  io("surface", surface);
}
}  // namespace mill
