#pragma once
#include "core/model/roll.h"
#include "core/process/progress.h"
#include "fem/body/component_modes.h"
#include <memory>
#include <string>

namespace mill::fem {
/// How a roll is reduced.
struct RollComponentOptions {
  int n_barrel           = 6;     ///< Legendre functions of the barrel's mean section displacement: P0, P2, ..
  double frequency_limit = 1000;  ///< Hz
  int n_modes            = -1;    ///< fixed-interface modes; -1: by the limit
  bool surface           = true;  ///< with displacement and stress on the outside
};

/// A roll as a component, and what it came from.
struct RollComponent {
  Component component;
  int n_unknowns      = 0;  ///< of the eighth
  double mesh_mass    = 0;  ///< kg, of the whole roll as meshed; component.mass is that of the drawing
  double factor_bytes = 0;  ///< bytes
};

/// Order with the element size of energies of a roll with a sharp shoulder: twice the exponent of the displacement
/// at a re-entrant corner of 270 degrees, 0.5445 (M. L. Williams, J. Appl. Mech. 19 (1952) 526).
constexpr double shoulder_order = 2 * 0.5445;

/// Eighth of a roll that moves up and down: u_y even about x, y and z = 0, free along y.  theory.md 21.4
PartSupport roll_support(const ElasticBody &body);

/// Legendre coefficients of the barrel's mean section displacement, and the mean displacement of the neck around
/// the bearing centre ("seat", cosine-squared window as that of the bearing load in condensed_roll).
PartInterface roll_interface(const ElasticBody &body, const RollGeometry &geometry, int n_barrel);

/// Mean displacement along y of the sections of a meshed roll.
struct SectionMeans {
  Eigen::VectorXd z;     ///< (k) m, the mesh's own stations from mid-length to the end
  Eigen::MatrixXd rows;  ///< (3N, k): mean = rows^T u
};
SectionMeans section_means(const ElasticBody &body, const RollGeometry &geometry);

/// Highest frequency the roll's mesh shows, Hz: the least of barrel, neck and section, (21.12).
double roll_reach(const ElasticBody &body, const RollGeometry &geometry, const Material &material);

/// Component of a meshed roll.
/// @param name  "work roll"
/// @throws as component_modes
RollComponent roll_component(const std::string &name, const ElasticBody &body, const RollGeometry &geometry,
                             const Material &material, const RollComponentOptions &options,
                             ComponentBasis *basis = nullptr);
}  // namespace mill::fem
