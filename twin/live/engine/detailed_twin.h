#pragma once
#include "core/model/lumped_model.h"
#include "core/records/stand_model.h"
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace mill::live {
/// A stand in more detail than six masses, whose seven springs follow those of the twin.  theory.md 48.6
struct DetailedTwin {
  StandModel whole;                       ///< as the case has it; what an adopted case is written from
  StandModel stand;                       ///< the same in its lowest modes, 64 unknowns at most, M = 1
  std::array<std::string, 7> connection;  ///< of K1..K7: "K3", "lower chock and K_Zy"; empty: the stand has none
  std::array<double, 7> stiffness{};      ///< N/m, of them in `whole`
  double highest    = 0;                  ///< Hz, modes up to it are stepped
  double watched    = 0;                  ///< Hz, modes up to it are followed in the records
  double gap_damper = 0;                  ///< N s/m
  std::vector<std::string> mode_names;    ///< of the modes that the gap or the sensors see; "": another one
};

/// @param frequency  (k) Hz, ascending, of all modes of `whole`
/// @param shape      (unknowns, k) kg^-1/2, mass-normalised
/// @param limit      Hz, up to which the model is right; modes up to twice of it are stepped
DetailedTwin detailed_twin(StandModel whole, const Eigen::VectorXd &frequency, const Eigen::MatrixXd &shape,
                           double limit, double gap_damper);

/// The values of the seven springs of `chain` from the stand: value, error where it states one.
void take_springs(const DetailedTwin &detailed, LumpedModel &chain);

/// N/m, of the connection of that name, all its springs together; 0: the stand has none.
double stiffness_of_connection(const StandModel &stand, const std::string &name);

/// `stand`, which is one of the two of the twin, with the seven springs as the chain has them.
StandModel with_springs(StandModel stand, const DetailedTwin &detailed, const LumpedModel &chain);
}  // namespace mill::live
