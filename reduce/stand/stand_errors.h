#pragma once
#include "reduce/chain/chain_keys.h"
#include "reduce/stand/stand_assembly.h"
#include "reduce/stand/stand_comparison.h"
#include <functional>
#include <vector>

namespace mill {
struct FourHigh;
}
namespace mill::reduce {
/// How far the frequencies of a stand may be off for its springs and masses.
struct FrequencyErrors {
  Eigen::VectorXd error;    ///< (m) -, relative; NaN: a spring or mass that the mode follows states no error
  std::vector<Keys> lacks;  ///< (m) which
};

/// Puts the stand together again from other numbers.
using StandBuilder = std::function<StandModel(const FourHigh &stand, const StandSprings &springs)>;

/// Sum over every spring and mass x that the model takes from the frame or from the chain of |d ln f / d ln x|
/// e_x, by Rayleigh's quotient of the mode's own shape in the model with x moved by 1e-4.  theory.md (22.9a)
/// @param modes    of build(stand, springs)
/// @param chain    whose springs and masses state their errors
/// Cost: the stand is put together some thirty times.
FrequencyErrors frequency_errors(const StandWithModes &modes, const FourHigh &stand, const StandSprings &springs,
                                 const LumpedStand &chain, const StandBuilder &build);

/// Error of each connection of a stand from the inputs of frequency_errors(): sum of |d ln k / d ln x| e_x; NaN
/// where one of them states none.
/// @param model  of build(stand, springs)
void set_connection_errors(StandModel &model, const FourHigh &stand, const StandSprings &springs,
                           const LumpedStand &chain, const StandBuilder &build);

/// What an input that may be off does to the modes of a stand.
struct ModalSensitivity {
  std::string name;    ///< "K3", "frame.oil_column_stiffness"
  double error;        ///< -, relative; NaN: it states none
  Keys lacks;          ///< which key would state it
  Eigen::MatrixXd dK;  ///< (m, m) 1/s2, V^T (dK/d ln x) V over the m modes
  Eigen::MatrixXd dM;  ///< (m, m) -, the same of the mass
};

/// One for every input of frequency_errors() that the modes feel.
std::vector<ModalSensitivity> modal_sensitivities(const StandWithModes &modes, const FourHigh &stand,
                                                  const StandSprings &springs, const LumpedStand &chain,
                                                  const StandBuilder &build);

/// How far the shares of the modes in the gap's compliance may be off: sum over the inputs x of
/// |d ln gamma / d ln x| e_x.  theory.md (22.25)
/// Modes that `modes` leaves out have no part in the change of a shape.  A share of zero has no relative error.
/// Cost O(m^2) for each input.
FrequencyErrors gap_share_errors(const StandWithModes &modes, const std::vector<ModalSensitivity> &inputs);

/// The same of the six masses by themselves: K1..K7 and M1..M6 with the errors that they state.
/// @param modes  of chain_stand(chain)
std::vector<ModalSensitivity> modal_sensitivities(const StandWithModes &modes, const LumpedModel &chain);
}  // namespace mill::reduce
