#pragma once
#include "core/lumped_model.h"
#include "core/stand.h"
#include "reduce/spring_chain.h"
#include <Eigen/Core>
#include <array>
#include <string>

namespace mill::reduce {
/// What other computations bring to the chain, at one working load.  Whole stand, N/m.
struct ChainInputs {
  Parameter K3;                  ///< upper backup roll on upper work roll, tangent
  Parameter K4;                  ///< bite
  Parameter K5;                  ///< lower work roll on lower backup roll, tangent
  Parameter K_Zy_upper;          ///< both bearings of the upper backup roll together, tangent
  Parameter K_Zy_lower;          ///< both bearings of the lower backup roll together, tangent
  std::array<Parameter, 4> Kzc;  ///< one bearing: upper backup, upper work, lower work, lower backup
  std::string at;                ///< working load, "976.2 kN"
};

/// A displacement along a roll under a bite force of 1 N.
struct RollShape {
  Eigen::VectorXd x;      ///< (n) m, from mid-length
  Eigen::VectorXd value;  ///< (n) m/N
};

/// The lumped model with the shapes and flexibilities it was made of.
struct LumpedStand {
  LumpedModel model;
  Parameter K_ZW;  ///< N/m, backup roll on its bearing centres, by the mass reference of the case
  Parameter K_Zy_upper, K_Zy_lower;  ///< N/m, as used: computed or given
  Flexibilities flexibility;
  RollShape f1_upper, f1_lower;  ///< work roll, mid-length to roll end
  RollShape f2_upper, f2_lower;  ///< backup roll, mid-length to bearing centre
};

/// Masses and springs of the six-mass chain.  theory.md 4
/// A value of the case's [given] replaces the computed one and keeps its source.  A given K3, K5, K_Zy, K_ZW, K1
/// or K7 also enters the shapes and with them the masses; a given K2 or K6 replaces the spring of the chain only,
/// since it does not say which of its parts is meant.
///
/// Every Parameter carries unit, source, method, load and the keys it was made from.  Its error estimate is the
/// sum of |d ln value / d ln input| x error over K3, K5 and K_Zy, by central differences of this very chain; NaN
/// when one of the inputs it depends on states no error, or when it depends on none of them.
///
/// @throws InputError  a spring of the load path, the strip width or a work roll dimension is not positive
/// Cost: ten evaluations of the chain, together some milliseconds.
LumpedStand lumped_stand(const FourHigh &stand, const ChainInputs &inputs);

/// Only the model of lumped_stand().
LumpedModel lumped_model(const FourHigh &stand, const ChainInputs &inputs);
}  // namespace mill::reduce
