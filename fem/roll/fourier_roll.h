#pragma once
#include "core/base/each_member.h"
#include "core/model/mesh_file.h"
#include "core/process/progress.h"
#include "fem/body/section_body.h"
#include <Eigen/Core>
#include <vector>

namespace mill::fem {
/// Answer of a roll to radial loads on the stations of its contact line, harmonic by harmonic, for one symmetry
/// case about mid-length.  A load of 1 N spread over station l, of harmonic m, has the line density cos(m theta) /
/// R around the roll; it moves the surface by  sum over l of surface[m](k, l) cos(m theta)  in the mean over
/// station k.  Both counted towards the axis; the load stands on z > 0 and, with the sign of the symmetry case, on
/// z < 0.
struct HarmonicResponse {
  std::vector<Eigen::MatrixXd> surface;  ///< (n, n) m/N, one per computed order
  Eigen::MatrixXd axis;           ///< (n, n) m/N, order 1: displacement of the axis along the load at theta = 0
  Eigen::VectorXd seat_surface;   ///< (n) m/N, order 1, under 1 N on the bearing seat in the same direction
  Eigen::VectorXd seat_axis;      ///< (n) m/N
  Eigen::MatrixXd point_surface;  ///< (n, p) m/N, order 1, under 1 N across the axis at each of the points
  Eigen::MatrixXd point_axis;     ///< (n, p) m/N
  Eigen::MatrixXd point_point;    ///< (p, p) m/N, of the points themselves
};

template <class Io, class R, if_record<R, HarmonicResponse> = 0> void each_member(Io &&io, R &record)
{
  auto &[surface, axis, seat_surface, seat_axis, point_surface, point_axis, point_point] = record;
  io("surface", surface);
  io("axis", axis);
  io("seat_surface", seat_surface);
  io("seat_axis", seat_axis);
  io("point_surface", point_surface);
  io("point_axis", point_axis);
  io("point_point", point_point);
}

/// A roll of revolution condensed to its contact line by a Fourier series around it.  theory.md 11
/// Order 1 contains the rigid motions: they are pinned on the axis, and the loads on a roll must balance.
struct FourierRoll {
  RollGeometry geometry;
  Material material;
  Eigen::VectorXd edge;    ///< (n + 1) m, ends of the stations from mid-length to the end of the contact
  std::vector<int> order;  ///< computed harmonics: all of the first ones, then a geometric series
  HarmonicResponse even;   ///< the same load on both sides of mid-length
  HarmonicResponse odd;    ///< opposite loads; empty unless asked for
  double half_width = 0;   ///< m, contact that the series was made for
  double seat_lever = 0;   ///< m, from mid-length to the resultant of the load on the bearing seat
  Eigen::VectorXd points;  ///< (p) m, distances from mid-length to the resultants of the forces on points
  int n_unknowns = 0;      ///< of one harmonic and symmetry case
  bool both_sides() const
  {
    return !odd.surface.empty();
  }
};

template <class Io, class R, if_record<R, FourierRoll> = 0> void each_member(Io &&io, R &record)
{
  auto &[geometry, material, edge, order, even, odd, half_width, seat_lever, points, n_unknowns] = record;
  io("geometry", geometry);
  io("material", material);
  io("edge", edge);
  io("order", order);
  io("even", even);
  io("odd", odd);
  io("half_width", half_width);
  io("seat_lever", seat_lever);
  io("points", points);
  io("n_unknowns", n_unknowns);
}

struct FourierOptions {
  int all_orders    = 16;   ///< harmonics up to this one are computed each
  double ratio      = 1.5;  ///< -, of the orders that follow
  double half_width = 0;  ///< m, contact the series must resolve: the last order is at least 2 radius / half_width
  bool both_sides   = false;    ///< the odd symmetry case too, for loads that differ between the two sides
  bool slab         = false;    ///< plane strain: the end is held along z like the plane of symmetry
  Eigen::VectorXd points = {};  ///< m, distances from mid-length of forces on neck or barrel, each all around it
};

/// Condenses a roll.  Cost: one sparse factorisation of about 1e4 unknowns, some 10 ms, per harmonic and symmetry
/// case.
/// @param body    quadratic or linear, axisymmetric, groups as mesh_meridian makes them
/// @param edge    (n + 1) m, increasing from 0 to the end of the group contact
/// @throws SolverError  matrix not positive definite
/// @throws InputError   edges outside the contact, or a half width that is not a part of the radius
FourierRoll fourier_roll(const SectionBody &body, const RollGeometry &geometry, const Material &material,
                         const Eigen::VectorXd &edge, const FourierOptions &options,
                         const Progress &progress = {});

/// Stations that follow a mesh: one per element of the group contact.  Shorter ones would see the difference
/// between corner and middle nodes: a percent of ripple in the line load.
Eigen::VectorXd stations_of(const SectionBody &body);

/// (n) m, centres and lengths of stations with the given edges.
Eigen::VectorXd station_centres(const Eigen::VectorXd &edge);
Eigen::VectorXd station_lengths(const Eigen::VectorXd &edge);
}  // namespace mill::fem
