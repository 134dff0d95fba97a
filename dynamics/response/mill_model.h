#pragma once
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"
#include "core/model/material.h"
#include "core/model/roll_kind.h"
#include <Eigen/Core>
#include <array>
#include <functional>
#include <string>
#include <vector>

namespace mill::dynamics {
constexpr double standard_gravity = 9.80665;  ///< m/s2, the g of every acceleration in g

/// Places of the masses in the vertical chain.
enum Mass { upper_frame, upper_backup_roll, upper_work_roll, lower_work_roll, lower_backup_roll, lower_frame };

constexpr int ground = -1;

/// One linear spring between two masses, or between a mass and the ground.
struct Spring {
  std::string name;   ///< "K3"
  int from;           ///< index of a mass, or ground
  int to;             ///< index of a mass, or ground
  double stiffness;   ///< N/m
  double damper = 0;  ///< N s/m, in parallel with it
};

/// A chain of n masses ready to be analysed:  M y'' + C y' + K y = b F(t).  theory.md (6.1)
/// Displacements count from the static state under the mean force, y up, F pushes the work rolls apart.
struct MillModel {
  std::vector<std::string> labels;  ///< (n) what moves: "upper work roll"
  std::vector<Spring> springs;      ///< in the order K1..K7; a spring of zero stiffness is listed too
  Eigen::VectorXd M;                ///< (n) kg
  Eigen::MatrixXd K;                ///< (n, n) N/m
  Eigen::MatrixXd C;                ///< (n, n) N s/m
  Eigen::VectorXd b;                ///< (n) -, force on each mass per unit of bite force
  Eigen::VectorXd load_cell;        ///< (n) N/m, load-cell force = load_cell . y (6.8)
  double load_cell_share = 1;       ///< -, part of the mean bite force that the load cell shows (6.8)
  std::vector<RollPlace> rolls;     ///< (n) which roll a mass is of, of a horizontal model; else empty
};

/// The vertical chain M1..M6 with the springs and dampers that belong to the meaning of the force.
///
/// @param model     M1..M6 > 0 kg, K1..K7 >= 0 N/m, C N s/m (NaN: none)
/// @param settings  force_meaning  measured:    F is the whole bite force, so K4 = C = 0
///                                 disturbance: F is the part that gap motion does not cause; K4 and C stay
///                                 published:   F acts in parallel with K4 and C, its mean included
///                  frame          open:   K1 and K7 stand on the ground
///                                 closed: K1 joins M1 to M6, K7 stands on the ground
///                  modal_damping  ratio of critical of every mode, added to C (6.4)
/// K2 and K6 have the oil films of the backup rolls at the chain's film_frequency: spring and damper, (29.18);
/// masses are its moving_mass where it has them.
/// Cost: one eigenproblem of a 6 x 6 matrix.  theory.md (6.1) to (6.5)
/// Source: chain and published numbers: preprint doi 10.21203/rs.3.rs-1441429/v1.
MillModel mill_model(const LumpedModel &model, const DynamicsSettings &settings);

/// M1..M6 (kg) of a chain whose backup rolls stand on bearings of these stiffnesses, N/m: upper and lower, both
/// bearings of a roll.
using MassesOnBearings = std::function<std::array<double, 6>(double upper, double lower)>;

/// The frequency at which oil films are taken, that of the gap mode of the rolling chain whose films are taken
/// there, and the masses of its shapes with films of |k + i w b|.  Nothing where the chain has no oil film.
/// theory.md (29.18)
/// @param settings  their force_meaning is not used: K4 and C are between the work rolls
void take_films(LumpedModel &model, DynamicsSettings settings, const MassesOnBearings &masses);

/// What the lumped record does not hold about the horizontal motion.
struct ChockSeats {
  std::array<double, 2> stiffness  = {not_given,
                                      not_given};  ///< N/m, Kx upper and lower work roll, both sides; NaN: rigid
  std::array<double, 2> chock_mass = {0, 0};       ///< kg, both chocks of the upper and of the lower work roll
  int bearings_per_roll            = 2;            ///< the two ends of a roll, in parallel
};

/// Horizontal motion of the rolls on their bearings, work rolls in series with the seats of their chocks.  A
/// bearing yields as it does across its load (Kzc_across), or as along it (Kzc) where nothing else is known.
/// Unknowns are the rolls 2..5 and, for a seat that yields under a chock with mass, that chock pair.  A roll whose
/// Kzc is unknown (NaN) is left out.  A clearance of the chock in its window would make Kx one-sided; a linear
/// model cannot show that.  b and C are zero: without an offset of the work rolls the bite does not push sideways.
/// theory.md (6.9), (6.10)
MillModel horizontal_model(const LumpedModel &model, const ChockSeats &seats);

/// Displacement of every mass per newton of bite force.  (n) m/N
/// @throws SolverError  a part of the chain is not held to the ground
Eigen::VectorXd static_displacement(const MillModel &model);

/// Stiffness of the stand without the bite: series of K1, K2, K3, K5, K6, K7.  N/m  theory.md (6.6)
double mill_modulus(const LumpedModel &model);
}  // namespace mill::dynamics
