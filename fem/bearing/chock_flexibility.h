#pragma once
#include "core/model/ring_sections.h"
#include "fem/body/elastic_body.h"
#include "reduce/bearing/ring_flexibility.h"
#include <Eigen/Core>
#include <functional>
#include <string>

namespace mill::fem {
/// The cup in its block, harmonic by harmonic: indices as in bearing::RingFlexibility.
struct ChockFlexibility {
  int harmonics = 0;
  Eigen::MatrixXd cosine;  ///< (n rows modes)^2 m/N
  Eigen::MatrixXd sine;    ///< ((n-1) rows modes)^2 m/N
  int n_unknowns = 0;      ///< of one symmetry case, free ones
};

/// Flexibility of the cup's contact lines in the block of mesh_chock, which is held on its support (or, round, on
/// its barrel): both parities about the load line and, if only half is meshed, about the mid-plane.  theory.md 15
/// @param mesh       of meshes::mesh_chock for this cup
/// @param harmonics  n >= 1; 2 to 3 quadratic elements per wave are wanted
/// @param threads  parities that are factorised side by side
/// Cost: one factorisation per symmetry case.
ChockFlexibility chock_flexibility(const RingSection &cup, const MeshFile &mesh, bool halved,
                                   const Material &material, int harmonics, int modes, int threads = 1);

/// Displacement and stress of the meshed half of the block under roller loads, for a picture.
/// @param load  (rows, Z) N, normal loads of the rollers at azimuths 2 pi j / Z from the support; what is not
/// symmetric
///              about the load line and (half block) about the mid-plane is left out
void write_chock_vtu(const std::string &path, const RingSection &cup, const MeshFile &mesh, bool halved,
                     const Material &material, const Eigen::MatrixXd &load);
}  // namespace mill::fem
