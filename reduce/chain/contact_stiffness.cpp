#include "reduce/chain/contact_stiffness.h"
#include "core/base/errors.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <vector>

namespace mill::reduce {
namespace {
constexpr int n_needed      = 5;      // three unknowns, two left over to judge the fit
constexpr int n_local       = 7;      // taken when there are as many
constexpr double edge_match = 1e-12;  // a working load equal to an end of the sweep but for rounding is inside

std::string kilonewton(const double load)
{
  std::ostringstream text;
  text.precision(5);
  text << load / 1e3 << " kN";
  return text.str();
}

void require_samples(const ContactCurve &curve)
{
  const auto n = curve.load.size();
  if (n < n_needed || curve.approach.size() != n)
    throw InputError("contact " + curve.name + ": the load-approach curve has " + std::to_string(n) +
                     " samples; at least " + std::to_string(n_needed) + " are needed, see contact." + curve.name +
                     ".samples");
  for (Eigen::Index i = 0; i < n; ++i)
    if (!(curve.load[i] > 0 && curve.approach[i] > 0) || (i > 0 && !(curve.load[i] > curve.load[i - 1])))
      throw InputError("contact " + curve.name +
                       ": loads and approaches must be positive and the loads increasing; sample " +
                       std::to_string(i + 1) + " is not");
}

void require_inside(const ContactCurve &curve, const double load)
{
  const double low = curve.load[0], high = curve.load[curve.load.size() - 1];
  if (!(load >= low * (1 - edge_match) && load <= high * (1 + edge_match)))
    throw InputError("contact " + curve.name + ": the working load " + kilonewton(load) +
                     " is outside the computed curve, " + kilonewton(low) + " .. " + kilonewton(high) +
                     "; widen contact." + curve.name + ".loads");
}

/// Indices of all samples, those nearest to the working load in ln F first and in order.
std::vector<Eigen::Index> by_distance(const ContactCurve &curve, const double load)
{
  std::vector<Eigen::Index> index(std::size_t(curve.load.size()));
  std::iota(index.begin(), index.end(), Eigen::Index(0));
  const auto distance = [&](Eigen::Index i) { return std::abs(std::log(curve.load[i] / load)); };
  std::stable_sort(index.begin(), index.end(),
                   [&](Eigen::Index i, Eigen::Index k) { return distance(i) < distance(k); });
  return index;
}

struct LogFit {
  double c0;     ///< m/N, approach/F at the working load
  double c1;     ///< m/N, slope of approach/F over ln F there
  double c2;     ///< m/N, quadratic term
  double error;  ///< -
};

/// Weighted least squares of  approach/F = c0 + c1 u + c2 u^2,  u = ln(F / working load), (3.6).  The weights fall
/// from one at the working load to zero at the first sample left out, so that the result does not jump when the
/// load moves past a midpoint.
LogFit fit_line_contact(const ContactCurve &curve, const double load)
{
  const auto samples = by_distance(curve, load);
  const auto n       = std::min<Eigen::Index>(n_local, Eigen::Index(samples.size()));
  const bool all     = n == Eigen::Index(samples.size());
  const double reach =
      std::abs(std::log(curve.load[samples[std::size_t(all ? n - 1 : n)]] / load)) * (all ? 1.25 : 1);
  Eigen::MatrixXd form(n, 3);
  Eigen::VectorXd ratio(n), weight(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double F = curve.load[samples[std::size_t(i)]], u = std::log(F / load);
    form.row(i) << 1, u, u * u;
    ratio[i]  = curve.approach[samples[std::size_t(i)]] / F;
    weight[i] = std::pow(1 - std::pow(std::abs(u) / reach, 3), 1.5);  // square root of the tricube weight
  }
  const Eigen::MatrixXd weighted = weight.asDiagonal() * form;
  const Eigen::VectorXd c = weighted.colPivHouseholderQr().solve(Eigen::VectorXd(weight.cwiseProduct(ratio)));
  return {c[0], c[1], c[2], ((form * c - ratio).array() / ratio.array()).abs().maxCoeff()};
}
}  // namespace

ContactStiffness contact_stiffness(const ContactCurve &curve, const double working_load, const double worst_fit)
{
  require_samples(curve);
  require_inside(curve, working_load);
  const LogFit fit = fit_line_contact(curve, working_load);
  if (!(fit.error <= worst_fit)) {
    std::ostringstream stood;
    stood << "largest deviation of the fit " << fit.error << ", wanted " << worst_fit;
    throw SolverError(
        {"contact " + curve.name + ": the curve is not that of a line contact near " + kilonewton(working_load),
         stood.str(), "edge contact, contact nodes lost, or samples too far apart for a crowned roll",
         "raise contact." + curve.name + ".samples or narrow contact." + curve.name + ".loads",
         "the computed load-approach curve"});
  }
  return {1 / (fit.c0 + fit.c1),  // tangent, (3.7): d(approach)/dF = c0 + c1 at u = 0
          1 / fit.c0,             // secant
          -(fit.c1 + 2 * fit.c2) / (working_load * std::pow(fit.c0 + fit.c1, 3)),  // (3.7a)
          working_load, fit.error};
}
}  // namespace mill::reduce
