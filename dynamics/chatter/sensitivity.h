#pragma once
#include "core/model/dynamics_settings.h"
#include "core/records/chatter_record.h"
#include "dynamics/chatter/speed.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modal_model.h"
#include "reduce/bite/linear/linear_sensitivity.h"
#include <array>
#include <functional>
#include <string>
#include <vector>

// What moves friction and critical speed, and by how much.  theory.md 27
namespace mill::dynamics {
/// What a number of the stand's structure is.
enum class NumberKind { mass, spring, damper, all_dampers, frequency, damping_ratio };

/// One number of the stand's structure: how its matrices move with the logarithm of the number, exactly, and the
/// structure with the number changed.
struct StructureNumber {
  NumberKind kind = NumberKind::spring;
  std::string key, name, unit;                   ///< "stand.masses[4]", "lower backup roll, mass", "kg"
  double value = 0;                              ///< SI
  Eigen::MatrixXd M_by, C_by, K_by;              ///< (n, n) p dM/dp, p dC/dp, p dK/dp; empty: zero
  std::function<StandStructure(double)> scaled;  ///< the structure with the number times a factor
};

/// Masses, springs and dampers one by one, and all dampers together, of six_mass_structure; zeros are left out.
/// Keys stand.masses[i], stand.stiffnesses[i], stand.dampings[i], stand.dampings.
std::vector<StructureNumber> six_mass_numbers(const std::array<double, 6> &mass,
                                              const std::array<double, 6> &stiffness,
                                              const std::array<double, 6> &damping);

/// M1..M6, K1..K7 without K4 and the modal damping of a lumped model as structure_of(mill_model(model, settings))
/// with force_meaning "measured".  The modal damping follows masses and springs, (27.8); oil films and the
/// frequency at which they are taken stay, (27.15). Keys M1, K1, dynamics.modal_damping.
std::vector<StructureNumber> chain_numbers(const LumpedModel &model, const DynamicsSettings &settings);

/// Frequency of every mode and the damping of all, of structure_of(modes).  Keys stand.modes[i], and
/// dynamics.modal_damping.
std::vector<StructureNumber> modal_numbers(const ModalModel &modes);

/// What is asked.
struct SensitivityRequest {
  Linearisation scheme = Linearisation::sequential;
  SpeedRange range;            ///< of the search for the critical speed
  double working_speed = 0;    ///< m/s, friction and growth rate are taken there; > 0
  double change        = 0.1;  ///< -, of the finite changes; 0: none
  int threads          = 2;    ///< that share the finite changes
};

/// Answer, inputs by falling |slope of the critical speed| (of the growth rate without a critical speed).
struct SensitivityTable {
  double working_speed  = 0;          ///< m/s
  double friction       = not_given;  ///< -, at the working speed
  double force          = not_given;  ///< N
  double growth         = not_given;  ///< 1/s
  double critical_speed = not_given;  ///< m/s; nan: none
  double frequency      = not_given;  ///< Hz, of the critical mode
  /// m/s, with friction held: of the stand under Coulomb friction of the working point; nan: none.
  double critical_speed_at_held_friction = not_given;  ///< m/s
  double growth_by_log_speed             = not_given;  ///< 1/s, d(growth rate)/d ln v at the critical speed
  std::string verdict;                                 ///< what the search found, in words
  std::vector<ChatterSensitivity> inputs;
};

/// Exact slopes by every number of the bite, of the structure and of the strip between the stands, and finite
/// changes by full recomputation.
/// Also inputs that go together: both tensions, friction as a whole, both distances, all dampers.
/// @param numbers  of the structure in `stand`; may be empty
/// @throws InputError, SolverError  no steady bite at the working speed
/// Cost: two searches of some 10 ms and 0.6 ms for the slopes; two searches per input for the finite changes, some
/// 1 s of one core for six masses.
SensitivityTable chatter_sensitivities(const ChatterStandModel &stand, const std::vector<StructureNumber> &numbers,
                                       const bite::RollBite &bite, const SensitivityRequest &request);

/// One eigenvalue of a real matrix and what its derivatives need: (27.5): left and right eigenvector of the
/// balanced matrix, back in the units of A.
struct EigenvalueSlope {
  std::complex<double> value;  ///< 1/s
  Eigen::VectorXcd left;       ///< (s) scaled so that left^H right = 1
  Eigen::VectorXcd right;      ///< (s)
  /// y^H dA x / (y^H x), 1/s per unit of the parameter.
  std::complex<double> by(const Eigen::MatrixXd &A_by) const;
};
/// @param near  1/s, the eigenvalue next to it is taken
/// @throws SolverError  a double eigenvalue, which has no derivative
EigenvalueSlope slope_of_eigenvalue(const Eigen::MatrixXd &A, std::complex<double> near);

/// Derivative of chatter_matrix along coefficients, which enter linearly.
Eigen::MatrixXd chatter_matrix_by(const ChatterStandModel &stand, const bite::LinearCoefficients &by);

/// Derivative of chatter_matrix by a number of the structure.
Eigen::MatrixXd chatter_matrix_by(const ChatterStandModel &stand, const bite::LinearCoefficients &coefficients,
                                  const StructureNumber &number);
}  // namespace mill::dynamics
