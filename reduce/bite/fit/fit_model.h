#pragma once
#include "core/model/bite_setup.h"
#include "reduce/bite/bite.h"
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

// What a pass would measure, with its derivatives by the numbers that a fit looks for.  theory.md 31.1
namespace mill::bite {
using Measured                       = PassMeasure;
constexpr std::size_t n_measured     = every<Measured>().size();
template <class T> using PerMeasured = std::array<T, n_measured>;

/// A number that a fit looks for: a factor on what the case says.
struct FitUnknown {
  enum class Role { friction, flow_stress, constant };
  Role role = Role::friction;
  std::string name;                      ///< "friction", "flow_stress", key of the constant
  double Friction::*constant = nullptr;  ///< of the friction law, role constant only
};
/// @throws InputError  no such number
FitUnknown fit_unknown(const std::string &name);

/// Strip with every unknown times its factor.
/// @param log_factors  (n) logarithms of the factors
Strip with_factors(Strip strip, const std::vector<FitUnknown> &unknowns, const Eigen::VectorXd &log_factors);

/// Largest logarithm of a factor that is tried; friction stops at a coefficient or factor of one before.
double largest_log_factor(const Strip &strip, const FitUnknown &unknown);

/// Measured values as Karman's slab predicts them.
struct PredictedPass {
  Eigen::Vector3d value;                        ///< force N over the width, forward slip -, torque N m of one roll
  Eigen::Matrix<double, 3, Eigen::Dynamic> by;  ///< (3, n) per logarithm of a factor; empty where not asked
  double friction = 0;                          ///< -, coefficient, or mean of the factors
};

/// Force, slip and torque of a pass on a rigid roll or on Hitchcock's circle.  The derivatives hold everything
/// that follows: flattened radius, friction of a film, neutral point; (31.4)
/// @param arc  rigid or hitchcock
/// @throws InputError, SolverError  as solve_karman: no such pass
/// Cost: some 1 ms with a flattened arc.
PredictedPass predict_pass(const RollBite &bite, Arc arc, const std::vector<FitUnknown> &unknowns,
                           const Eigen::VectorXd &log_factors, bool derivatives = true);
}  // namespace mill::bite
