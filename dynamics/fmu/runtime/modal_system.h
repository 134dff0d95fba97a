#pragma once
#include "linear_algebra.h"
#include "model_data.h"
#include <cstddef>
#include <vector>

namespace mill::fmu {
/// What a client may change.
struct Tuning {
  std::vector<double> mass;       ///< (m) kg, of a chain
  std::vector<double> stiffness;  ///< (springs) N/m, of a chain
  double modal_damping = 0;       ///< -
  double gap_damper    = 0;       ///< N s/m
};

/// A model in its n modes with m points:  q'' + (2 zeta w + c b b^T + D^T D) q' + w^2 q = b (F - F_mean).
/// theory.md (35.1)
struct ModalSystem {
  std::vector<double> rad;                   ///< (n) rad/s, ascending
  std::vector<double> bite;                  ///< (n) kg^-1/2, b
  std::vector<double> load_cell;             ///< (n) N/m kg^-1/2
  Matrix point;                              ///< (m, n) kg^-1/2
  Matrix from_points;                        ///< (n, m) kg^1/2, a chain's V^T M; empty where modes are given
  double damping         = 0;                ///< -, zeta
  double gap_damper      = 0;                ///< N s/m, c
  double load_cell_share = 1;                ///< -
  std::vector<std::vector<double>> dampers;  ///< (r) (n) (N s/m)^1/2 kg^-1/2, D, of oil films
};

/// Cost: one eigenproblem of the masses of a chain; of given modes only copies.  theory.md (35.2)
ModalSystem modal_system(const ModelData &model, const Tuning &tuning);

bool same_tuning(const Tuning &a, const Tuning &b);

/// What a model starts with.
Tuning start_of(const ModelData &model);

/// Is every part held?  A mode without stiffness has no equilibrium.
bool is_held(const ModalSystem &system);
}  // namespace mill::fmu
