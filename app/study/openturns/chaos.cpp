#include "app/study/openturns/chaos.h"
#include "app/study/constant_result.h"
#include "core/base/errors.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <openturns/ComposedDistribution.hxx>
#include <openturns/CorrectedLeaveOneOut.hxx>
#include <openturns/FixedStrategy.hxx>
#include <openturns/FunctionalChaosAlgorithm.hxx>
#include <openturns/FunctionalChaosSobolIndices.hxx>
#include <openturns/LARS.hxx>
#include <openturns/LeastSquaresMetaModelSelectionFactory.hxx>
#include <openturns/LeastSquaresStrategy.hxx>
#include <openturns/LinearEnumerateFunction.hxx>
#include <openturns/OrthogonalProductPolynomialFactory.hxx>
#include <openturns/StandardDistributionPolynomialFactory.hxx>
#include <random>

namespace mill {
namespace {
constexpr int most_degree = 10, resamples = 200, map_points = 21;
constexpr double most_deviations = 8;  // beyond them 1e-15 of a normal law
constexpr int most_worse         = 3;  // degrees in sequence; functions of even powers gain at every second degree
constexpr OT::UnsignedInteger most_candidates = 170;  // degree 8 of three inputs; least angles take time for more

// Inputs in the units of the law for which OpenTURNS makes the polynomials orthonormal: about the mean in
// deviations for a normal one, from -1 to 1 for one with ends.  Polynomials of a diameter of 420 mm with a
// tolerance of 0.5 mm keep their digits so.
struct Scale {
  double middle = 0, length = 1;
};

// Ends that a truncated normal never comes near would leave it no width between -1 and 1.
Spread without_far_ends(Spread s)
{
  const double far = most_deviations * s.sd;
  if (s.kind == Spread::Kind::truncated && s.high > s.mean - far && s.low < s.mean + far) {
    s.low  = std::max(s.low, s.mean - far);
    s.high = std::min(s.high, s.mean + far);
  }
  return s;
}

Scale scale_of(const Spread &s)
{
  return s.kind == Spread::Kind::normal ? Scale{s.mean, s.sd}
                                        : Scale{0.5 * (s.low + s.high), 0.5 * (s.high - s.low)};
}

Spread scaled(Spread s)
{
  const Scale scale = scale_of(s);
  for (double *place : {&s.mean, &s.low, &s.high})
    *place = (*place - scale.middle) / scale.length;
  s.sd /= scale.length;
  return s;
}

// Fitted terms with what the indices need: values of the terms at the rows and degree of each term by input.
struct Terms {
  Eigen::MatrixXd values;                 // (rows, terms)
  std::vector<std::vector<bool>> of_key;  // (terms)(keys)
  std::vector<std::size_t> number;        // of the basis
  int degree = 0;
};

double leave_one_out(const Eigen::MatrixXd &values, const Eigen::VectorXd &y)
{
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(values);
  const Eigen::MatrixXd q    = qr.householderQ() * Eigen::MatrixXd::Identity(values.rows(), values.cols());
  const Eigen::VectorXd rest = y - q * (q.transpose() * y), open = 1 - q.rowwise().squaredNorm().array();
  const double all = (y.array() - y.mean()).square().sum();
  return (rest.array() / open.array().max(1e-12)).square().sum() / all;
}

struct Indices {
  std::vector<double> first, total;
};

// Shares of the squared coefficients.  (52.8)
Indices indices_of(const Terms &terms, const Eigen::VectorXd &coefficients)
{
  const std::size_t keys = terms.of_key.front().size();
  Indices indices{std::vector<double>(keys, 0), std::vector<double>(keys, 0)};
  double variance = 0;
  for (std::size_t t = 0; t < terms.of_key.size(); ++t) {
    const auto n       = std::count(terms.of_key[t].begin(), terms.of_key[t].end(), true);
    const double share = coefficients[Eigen::Index(t)] * coefficients[Eigen::Index(t)];
    variance += n > 0 ? share : 0;
    for (std::size_t k = 0; k < keys; ++k) {
      indices.first[k] += terms.of_key[t][k] && n == 1 ? share : 0;
      indices.total[k] += terms.of_key[t][k] ? share : 0;
    }
  }
  for (auto *list : {&indices.first, &indices.total})
    for (double &index : *list)
      index = variance > 0 ? index / variance : 0;
  return indices;
}

// 95 % of the indices when rows are drawn with repetition and the same terms are fitted to them.
void add_intervals(ChaosFit &fit, const Terms &terms, const Eigen::VectorXd &y, const int seed)
{
  const auto n           = std::size_t(y.size());
  const std::size_t keys = fit.first.size();
  std::mt19937 random{std::mt19937::result_type(seed)};
  std::vector<Indices> all;
  for (int r = 0; r < resamples; ++r) {
    Eigen::MatrixXd values(y.size(), terms.values.cols());
    Eigen::VectorXd drawn(y.size());
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      const auto from = Eigen::Index(random() % n);
      values.row(i)   = terms.values.row(from);
      drawn[i]        = y[from];
    }
    all.push_back(indices_of(terms, values.colPivHouseholderQr().solve(drawn)));
  }
  const auto quantile_of = [&](const std::vector<double> Indices::*list, const std::size_t k, const double q) {
    std::vector<double> sorted;
    for (const Indices &one : all)
      sorted.push_back((one.*list)[k]);
    std::sort(sorted.begin(), sorted.end());
    return sorted[std::size_t(q * (resamples - 1))];
  };
  for (std::size_t k = 0; k < keys; ++k) {
    fit.first_low.push_back(quantile_of(&Indices::first, k, 0.025));
    fit.first_high.push_back(quantile_of(&Indices::first, k, 0.975));
    fit.total_low.push_back(quantile_of(&Indices::total, k, 0.025));
    fit.total_high.push_back(quantile_of(&Indices::total, k, 0.975));
  }
}

// One result on its rows.
class Chaos {
public:
  Chaos(const std::vector<Spread> &spreads, const int fit_seed) : seed(fit_seed)
  {
    OT::OrthogonalProductPolynomialFactory::PolynomialFamilyCollection families;
    OT::ComposedDistribution::DistributionCollection marginals;
    for (const Spread &asked : spreads) {
      const Spread spread = without_far_ends(asked);
      scales.push_back(scale_of(spread));
      marginals.add(distribution_of(scaled(spread)));
      families.add(OT::StandardDistributionPolynomialFactory(marginals[marginals.getSize() - 1]));
    }
    numbering = OT::LinearEnumerateFunction(spreads.size());
    basis     = OT::OrthogonalProductPolynomialFactory(families, numbering);
    inputs    = OT::ComposedDistribution(marginals);
  }

  OT::Point scaled_row(const std::vector<double> &row) const
  {
    OT::Point point(row.size());
    for (std::size_t k = 0; k < row.size(); ++k)
      point[k] = (row[k] - scales[k].middle) / scales[k].length;
    return point;
  }

  // The total degree with the least leave-one-out error.
  ChaosFit fit(const OT::Sample &x, const Eigen::VectorXd &y)
  {
    ChaosFit best;
    best.leave_one_out = std::numeric_limits<double>::infinity();
    const auto limit   = std::min(most_candidates, OT::UnsignedInteger(y.size()));
    int worse          = 0;
    for (int degree = 1; degree <= most_degree && worse < most_worse; ++degree) {
      const auto candidates = numbering.getStrataCumulatedCardinal(OT::UnsignedInteger(degree));
      if (degree > 1 && candidates > limit)
        break;
      const Terms terms  = selected(x, y, candidates);
      const double error = leave_one_out(terms.values, y);
      if (error < 0.99 * best.leave_one_out) {
        best.leave_one_out = error;
        best.degree        = terms.degree;
        kept               = terms;
        worse              = 0;
      } else {
        ++worse;
      }
    }
    coefficients = kept.values.colPivHouseholderQr().solve(y);
    best.terms   = int(kept.number.size());
    best.rows    = y.size();
    for (std::size_t t = 0; t < kept.number.size(); ++t)
      if (std::count(kept.of_key[t].begin(), kept.of_key[t].end(), true) == 0)
        best.mean = coefficients[Eigen::Index(t)];
      else
        best.sd += coefficients[Eigen::Index(t)] * coefficients[Eigen::Index(t)];
    best.sd               = std::sqrt(best.sd);
    const Indices indices = indices_of(kept, coefficients);
    best.first            = indices.first;
    best.total            = indices.total;
    add_intervals(best, kept, y, seed);
    return best;
  }

  double value(const std::vector<double> &row) const
  {
    const OT::Point point = scaled_row(row);
    double sum            = 0;
    for (std::size_t t = 0; t < kept.number.size(); ++t)
      sum += coefficients[Eigen::Index(t)] * basis.build(kept.number[t])(point)[0];
    return sum;
  }

  double number_of(const std::size_t key, const double steps) const
  {
    return scales[key].middle + steps * scales[key].length;
  }

  OT::Distribution marginal(const std::size_t key) const
  {
    return inputs.getMarginal(key);
  }

private:
  Terms selected(const OT::Sample &x, const Eigen::VectorXd &y, const OT::UnsignedInteger candidates) const
  {
    OT::Sample out(x.getSize(), 1);
    for (OT::UnsignedInteger i = 0; i < x.getSize(); ++i)
      out(i, 0) = y[Eigen::Index(i)];
    OT::FunctionalChaosAlgorithm algorithm(x, out, inputs, OT::FixedStrategy(basis, candidates),
                                           OT::LeastSquaresStrategy(OT::LeastSquaresMetaModelSelectionFactory(
                                               OT::LARS(), OT::CorrectedLeaveOneOut())));
    algorithm.run();
    const OT::Indices numbers = algorithm.getResult().getIndices();
    Terms terms;
    terms.number.assign(numbers.begin(), numbers.end());
    if (std::find(terms.number.begin(), terms.number.end(), 0u) == terms.number.end())
      terms.number.insert(terms.number.begin(), 0);
    terms.values.resize(y.size(), Eigen::Index(terms.number.size()));
    for (std::size_t t = 0; t < terms.number.size(); ++t) {
      const OT::Sample column = basis.build(terms.number[t])(x);
      for (Eigen::Index i = 0; i < y.size(); ++i)
        terms.values(i, Eigen::Index(t)) = column(OT::UnsignedInteger(i), 0);
      const OT::Indices powers = numbering(terms.number[t]);
      terms.of_key.emplace_back();
      int degree = 0;
      for (const OT::UnsignedInteger power : powers) {
        terms.of_key.back().push_back(power > 0);
        degree += int(power);
      }
      terms.degree = std::max(terms.degree, degree);
    }
    return terms;
  }

  int seed;
  std::vector<Scale> scales;
  OT::LinearEnumerateFunction numbering;
  OT::OrthogonalProductPolynomialFactory basis;
  OT::ComposedDistribution inputs;
  Terms kept;
  Eigen::VectorXd coefficients;
};

// Height over the two strongest inputs between their 1 % and 99 % points.
void add_map(ChaosFit &fit, const Chaos &chaos)
{
  const std::size_t keys = fit.total.size();
  if (keys < 2)
    return;
  std::vector<std::size_t> order(keys);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](const std::size_t a, const std::size_t b) { return fit.total[a] > fit.total[b]; });
  fit.map_x = order[0], fit.map_y = order[1];
  const auto axis = [&](const std::size_t key) {
    const OT::Distribution law = chaos.marginal(key);
    const double low = law.computeQuantile(0.01)[0], high = law.computeQuantile(0.99)[0];
    std::vector<double> values;
    for (int i = 0; i < map_points; ++i)
      values.push_back(chaos.number_of(key, low + (high - low) * i / (map_points - 1)));
    return values;
  };
  fit.x = axis(fit.map_x), fit.y = axis(fit.map_y);
  std::vector<double> row;
  for (std::size_t k = 0; k < keys; ++k)
    row.push_back(chaos.number_of(k, chaos.marginal(k).getMean()[0]));
  for (const double y : fit.y) {
    fit.height.emplace_back();
    for (const double x : fit.x) {
      row[fit.map_x] = x, row[fit.map_y] = y;
      fit.height.back().push_back(chaos.value(row));
    }
  }
}
}  // namespace

ChaosFit chaos_fit(const std::vector<Spread> &spreads, const std::vector<std::vector<double>> &rows,
                   const std::vector<double> &result, const long fitted, const int seed)
{
  std::vector<std::size_t> in, out;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::isfinite(result[i]))
      (long(i) < fitted ? in : out).push_back(i);
  const std::size_t least = 2 * (spreads.size() + 1);
  if (in.size() < least)
    throw InputError(fmt::format("only {} of the rows that chaos fits are finished; {} inputs need {} or more",
                                 in.size(), spreads.size(), least));
  Chaos chaos(spreads, seed);
  OT::Sample x(in.size(), spreads.size());
  Eigen::VectorXd y(Eigen::Index(in.size()));
  for (std::size_t i = 0; i < in.size(); ++i) {
    x[i]               = chaos.scaled_row(rows[in[i]]);
    y[Eigen::Index(i)] = result[in[i]];
  }
  if (is_constant({y.begin(), y.end()}))
    return {};
  ChaosFit fit = chaos.fit(x, y);
  Eigen::VectorXd computed(Eigen::Index(out.size())), predicted(Eigen::Index(out.size()));
  for (std::size_t i = 0; i < out.size(); ++i) {
    computed[Eigen::Index(i)]  = result[out[i]];
    predicted[Eigen::Index(i)] = chaos.value(rows[out[i]]);
  }
  fit.held_out_rows = long(out.size());
  if (out.size() > 2)
    fit.held_out = (predicted - computed).squaredNorm() / (computed.array() - computed.mean()).square().sum();
  fit.computed.assign(computed.begin(), computed.end());
  fit.predicted.assign(predicted.begin(), predicted.end());
  add_map(fit, chaos);
  return fit;
}
}  // namespace mill
