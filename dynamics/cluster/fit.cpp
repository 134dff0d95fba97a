#include "dynamics/cluster/fit.h"
#include "core/case/cluster_variants.h"
#include "core/numerics/eigen_instances.h"
#include "core/numerics/quantiles.h"
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mill::cluster {
namespace {
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool is_angle(const std::string &key)
{
  const auto ends = [&](const std::string &ending) {
    return key.size() > ending.size() && key.compare(key.size() - ending.size(), ending.size(), ending) == 0;
  };
  return ends(".direction") || ends(".half_angle");
}

// The stack as a function of what is sought: logarithms, angles as they are.
struct Model {
  ClusterStand stand;
  const ClusterPass &pass;
  double force;
  const ComputedLaws &computed;
  std::vector<std::string> keys;
  std::vector<std::size_t> modes;  // indices of [[mode]] that are fitted

  Eigen::VectorXd start()
  {
    Eigen::VectorXd p(Eigen::Index(keys.size()));
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const double value = *number_of(stand, keys[i]);
      p[Eigen::Index(i)] = is_angle(keys[i]) ? value : std::log(value);
    }
    return p;
  }

  double value(const std::size_t i, const Eigen::VectorXd &p) const
  {
    return is_angle(keys[i]) ? p[Eigen::Index(i)] : std::exp(p[Eigen::Index(i)]);
  }

  // Hz, of every [[mode]].
  Eigen::VectorXd frequencies(const Eigen::VectorXd &p)
  {
    for (std::size_t i = 0; i < keys.size(); ++i)
      *number_of(stand, keys[i]) = value(i, p);
    const PassState state = pass_state(stand, pass, force, computed);
    Eigen::VectorXd f(Eigen::Index(stand.modes.size()));
    for (std::size_t i = 0; i < stand.modes.size(); ++i)
      f[Eigen::Index(i)] = state.identity[i] < 0 ? nan : state.modes[std::size_t(state.identity[i])].frequency;
    return f;
  }

  Eigen::VectorXd errors(const Eigen::VectorXd &f) const
  {
    Eigen::VectorXd r(Eigen::Index(modes.size()));
    for (std::size_t i = 0; i < modes.size(); ++i)
      r[Eigen::Index(i)] = f[Eigen::Index(modes[i])] / stand.modes[modes[i]].frequency - 1;
    return r;
  }

  Eigen::MatrixXd slopes(const Eigen::VectorXd &p)
  {
    Eigen::MatrixXd J(Eigen::Index(modes.size()), p.size());
    for (Eigen::Index k = 0; k < p.size(); ++k) {
      const double h       = 1e-5;
      Eigen::VectorXd plus = p, minus = p;
      plus[k] += h;
      minus[k] -= h;
      J.col(k) = (errors(frequencies(plus)) - errors(frequencies(minus))) / (2 * h);
    }
    return J;
  }
};

std::vector<std::size_t> fitted_indices(const ClusterStand &stand, const ClusterVariant &variant)
{
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < stand.modes.size(); ++i) {
    const bool named = variant.modes.empty() || std::find(variant.modes.begin(), variant.modes.end(),
                                                          stand.modes[i].name) != variant.modes.end();
    if (named && !std::isnan(stand.modes[i].frequency))
      which.push_back(i);
  }
  return which;
}

// Steps of Levenberg and Marquardt until the numbers stand still.
Eigen::VectorXd search(Model &model, Eigen::VectorXd p, StackFit &fit)
{
  Eigen::VectorXd r = model.errors(model.frequencies(p));
  double damping    = 1e-4;
  for (; fit.steps < 100 && !fit.converged; ++fit.steps) {
    const Eigen::MatrixXd J = model.slopes(p), A = J.transpose() * J;
    for (int tries = 0; tries < 12; ++tries) {
      Eigen::MatrixXd damped = A;
      damped.diagonal() += damping * (A.diagonal().array() + 1e-12 * A.trace()).matrix();
      const Eigen::VectorXd change = damped.ldlt().solve(J.transpose() * r);
      const Eigen::VectorXd tried  = p - change.cwiseMax(-0.5).cwiseMin(0.5);
      Eigen::VectorXd after;
      try {
        after = model.errors(model.frequencies(tried));
      } catch (const SolverError &) {  // no equilibrium there: a shorter step
      } catch (const InputError &) {   // rolls that overlap
      }
      const bool better = after.size() == r.size() && after.squaredNorm() <= r.squaredNorm();
      if (better) {
        fit.converged = change.cwiseAbs().maxCoeff() < 1e-9;
        p             = tried;
        r             = after;
        damping       = std::max(1e-12, damping / 10);
        break;
      }
      fit.converged = change.cwiseAbs().maxCoeff() < 1e-9;
      if (fit.converged)
        break;
      damping *= 10;
    }
  }
  return p;
}

// 95 % intervals from the errors that are left, where there are more frequencies than numbers.  (38.25)
void add_intervals(Model &model, const Eigen::VectorXd &p, const Eigen::VectorXd &r, StackFit &fit)
{
  const Eigen::MatrixXd J = model.slopes(p), A = J.transpose() * J;
  const int spare = int(J.rows() - J.cols());
  for (Eigen::Index k = 0; k < p.size(); ++k)
    if (A(k, k) < 1e-14)
      fit.undetermined = model.keys[std::size_t(k)];
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(A);
  if (fit.undetermined.empty() && lu.rcond() < 1e-13)
    fit.undetermined = model.keys.back();
  if (!fit.undetermined.empty())
    return;
  const Eigen::MatrixXd inverse   = lu.inverse();
  const Eigen::VectorXd deviation = inverse.diagonal().cwiseSqrt();
  fit.correlation = deviation.cwiseInverse().asDiagonal() * inverse * deviation.cwiseInverse().asDiagonal();
  if (spare < 1)
    return;
  const double s = std::sqrt(r.squaredNorm() / spare);
  for (std::size_t i = 0; i < fit.numbers.size(); ++i) {
    const double width      = student_above(0.025, spare) * s * deviation[Eigen::Index(i)];
    fit.numbers[i].interval = is_angle(model.keys[i]) ? width : width * fit.numbers[i].value;
  }
}

double rms_of(const std::vector<MatchedFrequency> &all, const bool fitted)
{
  double sum = 0;
  int n      = 0;
  for (const MatchedFrequency &f : all)
    if (f.fitted == fitted) {
      sum += std::pow(f.computed / f.wanted - 1, 2);
      ++n;
    }
  return n > 0 ? std::sqrt(sum / n) : nan;
}
}  // namespace

StackFit fit_variant(const ClusterStand &stand, const ClusterVariant &variant, const ClusterPass &pass,
                     const double force, const ComputedLaws &computed)
{
  Model model{with_variant(stand, variant),  pass, force, computed, variant.unknowns,
              fitted_indices(stand, variant)};
  StackFit fit;
  fit.variant = variant.name;
  fit.pass    = pass.name;
  try {
    Eigen::VectorXd p = model.start();
    for (std::size_t i = 0; i < model.keys.size(); ++i)
      fit.numbers.push_back({model.keys[i], model.value(i, p), 0, nan});
    fit.converged = model.keys.empty();
    p             = search(model, p, fit);
    for (std::size_t i = 0; i < model.keys.size(); ++i)
      fit.numbers[i].value = model.value(i, p);
    const Eigen::VectorXd f = model.frequencies(p);
    for (std::size_t i = 0; i < model.stand.modes.size(); ++i)
      if (const ClusterMode &mode = model.stand.modes[i]; !std::isnan(mode.frequency))
        fit.frequencies.push_back(
            {mode.name, mode.frequency, f[Eigen::Index(i)],
             !model.keys.empty() && std::count(model.modes.begin(), model.modes.end(), i) > 0});
    fit.rms_fitted    = rms_of(fit.frequencies, true);
    fit.rms_predicted = rms_of(fit.frequencies, false);
    if (!model.keys.empty())
      add_intervals(model, p, model.errors(f), fit);
  } catch (const SolverError &e) {
    fit.refused = e.report.what;
  } catch (const InputError &e) {
    fit.refused = e.problems.front().message;
  }
  return fit;
}
}  // namespace mill::cluster
