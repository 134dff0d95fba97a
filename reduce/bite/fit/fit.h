#pragma once
#include "reduce/bite/fit/fit_model.h"
#include <optional>
#include <string>
#include <vector>

// Friction and flow stress from measured force, forward slip and torque of one or more passes.  theory.md 31
namespace mill::bite {
/// What was measured of a pass.
struct MeasuredPass {
  std::string name;
  RollBite bite;                                                   ///< as the case says it, before the fit
  PerMeasured<double> value{not_given, not_given, not_given};      ///< N, -, N m; nan: not to be used
  PerMeasured<double> deviation{not_given, not_given, not_given};  ///< standard deviations, same units
  /// How another model differs from the slab at the fitted point: value = factor * slab + shift.  (31.7)
  PerMeasured<double> factor{1, 1, 1};
  PerMeasured<double> shift{0, 0, 0};
};

struct FitProblem {
  std::vector<MeasuredPass> passes;
  Arc arc = Arc::hitchcock;  ///< of the slab: rigid or hitchcock
  std::vector<FitUnknown> unknowns;
};

/// One measured value of a fit.
struct FitDatum {
  std::size_t pass = 0;
  Measured kind    = Measured::force;
};
/// Those that are given, pass by pass.
std::vector<FitDatum> data_of(const FitProblem &problem);

/// A state of the fit.
struct FitPoint {
  Eigen::VectorXd x;         ///< (n) logarithms of the factors
  Eigen::VectorXd residual;  ///< (m) (predicted - measured) / standard deviation, in the order of data_of
  Eigen::MatrixXd slope;     ///< (m, n) its derivatives
  double misfit = 0;         ///< sum of squares
  bool at_edge  = false;     ///< the minimum lies where no such pass exists any more: next to skidding, or a bound
};

/// Residuals at x; nothing where a pass does not exist there.  @param slopes  false: no derivatives
std::optional<FitPoint> fit_point(const FitProblem &problem, const Eigen::VectorXd &x, bool slopes = true);

/// A start at which every pass exists: x = 0, else other friction, else other flow stress.
/// @throws InputError  there is none; what the pass says about x = 0
FitPoint feasible_start(const FitProblem &problem);

/// Least squares by Gauss and Newton's steps, shortened by Levenberg and Marquardt's rule.  (31.2)
/// @param held  (n) numbers that keep their value
/// @throws SolverError  the steps do not settle
/// Cost: 5 to 10 evaluations of all passes.
FitPoint least_misfit(const FitProblem &problem, const FitPoint &start, const std::vector<bool> &held);
FitPoint least_misfit(const FitProblem &problem, const FitPoint &start);

/// A direction among the unknowns and how well the data know it.
struct FitDirection {
  Eigen::VectorXd unit;  ///< (n) of logarithms of the factors, length one, largest component positive
  double deviation = 0;  ///< -, standard deviation along it; infinite where no datum moves
};
/// From the singular values of the weighted slopes, the worst known first.  (31.5)
std::vector<FitDirection> directions_of(const FitPoint &point);

/// Standard deviations and correlations, (31.5); infinite and nan where the slopes are singular.
Eigen::MatrixXd covariance_of(const FitPoint &point);

/// 95 % interval of one unknown.
struct FitInterval {
  double low = 0, high = 0;  ///< logarithms of the factor
  bool low_open  = false;    ///< no pass exists beyond it, or the bound of the search: the data do not end it
  bool high_open = false;
};
/// From the profile of the misfit: all other unknowns follow.  (31.5)
/// @param i  of the unknown
/// Cost: some 20 fits.
FitInterval profile_interval(const FitProblem &problem, const FitPoint &best, std::size_t i);

/// Edge of the region that holds two unknowns together with 95 %, the others following.  (31.6)
/// @return (n, 2) logarithms of both factors, once around; points where no pass exists beyond end there
Eigen::MatrixXd confidence_region(const FitProblem &problem, const FitPoint &best, std::size_t i, std::size_t j,
                                  int n);

/// Misfit that measured values alone exceed in one of a hundred cases.
/// @param freedom  data less unknowns, > 0
double largest_likely_misfit(int freedom);
}  // namespace mill::bite
