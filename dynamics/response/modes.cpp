#include "dynamics/response/modes.h"
#include "core/base/errors.h"
#include "core/records/key_list.h"
#include "dynamics/response/state_space.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

namespace mill::dynamics {
namespace {
double elongation(const Spring &spring, const Eigen::MatrixXd &shape, const Eigen::Index mode)
{
  const auto value_at = [&](const int mass) { return mass == ground ? 0 : shape(mass, mode); };
  return value_at(spring.to) - value_at(spring.from);
}

void largest_component_positive(Eigen::MatrixXd &shape)
{
  for (Eigen::Index k = 0; k < shape.cols(); ++k) {
    Eigen::Index largest = 0;
    shape.col(k).cwiseAbs().maxCoeff(&largest);
    if (shape(largest, k) < 0)
      shape.col(k) *= -1;
  }
}

SolverError no_eigenvalues(const std::string &owner)
{
  return SolverError({"eigenvalues of " + owner + ": no convergence", "after the iterations of a QR algorithm",
                      "a mass, stiffness or damping that is not a number", "check M1..M6, K1..K7 and C", ""});
}

Pole pole_of(const std::complex<double> lambda)
{
  return {std::abs(lambda) / (2 * M_PI), -lambda.real() / std::abs(lambda)};
}

std::vector<Pole> sorted(std::vector<Pole> poles)
{
  std::sort(poles.begin(), poles.end(), [](const Pole &a, const Pole &b) { return a.frequency < b.frequency; });
  return poles;
}
}  // namespace

Modes modes(const MillModel &model)
{
  Modes result;
  const Eigen::Index n = model.M.size();
  if (n == 0)
    return result;
  const Eigen::VectorXd root = model.M.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      Eigen::MatrixXd(root.asDiagonal() * model.K * root.asDiagonal()));  // (6.11)
  if (solver.info() != Eigen::Success)
    throw no_eigenvalues("the undamped lumped model");
  const Eigen::VectorXd squared = solver.eigenvalues().cwiseMax(0);  // rounding may push a free mode below zero
  result.frequency              = squared.cwiseSqrt() / (2 * M_PI);
  result.shape                  = root.asDiagonal() * solver.eigenvectors();
  largest_component_positive(result.shape);

  result.strain_share  = Eigen::MatrixXd::Zero(n, Eigen::Index(model.springs.size()));
  result.kinetic_share = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < model.springs.size(); ++j)
      result.strain_share(i, Eigen::Index(j)) =
          model.springs[j].stiffness * std::pow(elongation(model.springs[j], result.shape, i), 2);
    const double total = result.strain_share.row(i).sum();
    if (total > 0)
      result.strain_share.row(i) /= total;                                                            // (6.12)
    result.kinetic_share.row(i) = model.M.cwiseProduct(result.shape.col(i).cwiseAbs2()).transpose();  // (6.13)
  }
  return result;
}

ModeError mode_error(const Modes &modes, const Eigen::Index mode, const LumpedModel &model)
{
  constexpr double no_share = 1e-5;  // too little to matter even of a spring that is twice as stiff
  ModeError out;
  const auto add = [&](const std::string &name, const Parameter &part, const double share) {
    if (share < no_share)
      return;
    out.error += 0.5 * share * part.error_estimate;
    if (std::isnan(part.error_estimate))
      out.lacks = joined(std::move(out.lacks), part.error_lacks.empty() ? KeyList{name} : part.error_lacks);
  };
  for (int j = 0; j < 7; ++j)
    add("K" + std::to_string(j + 1), model.K[std::size_t(j)], modes.strain_share(mode, j));
  for (int j = 0; j < 6; ++j)
    add("M" + std::to_string(j + 1), model.M[std::size_t(j)], modes.kinetic_share(mode, j));
  return out;
}

std::vector<Pole> poles(const MillModel &model)
{
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(state_space(model).A, false);
  if (solver.info() != Eigen::Success)
    throw no_eigenvalues("the damped lumped model");
  std::vector<Pole> all_poles;
  for (const std::complex<double> lambda : solver.eigenvalues())
    if (lambda.imag() >= 0 && std::abs(lambda) > 0)  // of a pair the one above the axis
      all_poles.push_back(pole_of(lambda));
  return sorted(all_poles);
}

std::vector<Pole> loss_factor_poles(const MillModel &model, const std::string &name, const double eta)
{
  const auto spring = std::find_if(model.springs.begin(), model.springs.end(),
                                   [&](const Spring &candidate) { return candidate.name == name; });
  if (spring == model.springs.end())
    throw InputError("the lumped model has no spring \"" + name + "\"; a loss factor needs one of K1..K7");
  Eigen::VectorXd ends = Eigen::VectorXd::Zero(model.M.size());
  if (spring->from != ground)
    ends[spring->from] = -1;
  if (spring->to != ground)
    ends[spring->to] = 1;
  const Eigen::VectorXd root = model.M.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd loss = eta * spring->stiffness * ends * ends.transpose();
  Eigen::MatrixXcd K         = (root.asDiagonal() * model.K * root.asDiagonal()).cast<std::complex<double>>();
  K += std::complex<double>(0, 1) * (root.asDiagonal() * loss * root.asDiagonal()).cast<std::complex<double>>();
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(K, false);  // (6.15)
  if (solver.info() != Eigen::Success)
    throw no_eigenvalues("the lumped model with a loss factor");
  std::vector<Pole> all_poles;
  for (const std::complex<double> mu : solver.eigenvalues())
    all_poles.push_back({std::sqrt(mu.real()) / (2 * M_PI), mu.imag() / (2 * mu.real())});
  return sorted(all_poles);
}
}  // namespace mill::dynamics
