#include "app/study/study_statistics.h"
#include "app/study/constant_result.h"
#include "app/study/store/row_files.h"
#include "core/base/errors.h"
#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <unordered_map>

namespace mill {
namespace {
constexpr double outside = 0.025;  // of an interval, to each side

// Distribution-free interval of a quantile between two order statistics.
// Source: W. J. Conover, Practical Nonparametric Statistics (1999), section 3.2.
Estimated quantile(const std::vector<double> &sorted, const double q)
{
  const double n = double(sorted.size());
  const boost::math::binomial law(n, q);
  const auto at_rank = [&](const double rank) { return sorted[std::size_t(std::clamp(rank, 0.0, n - 1))]; };
  const double place = q * (n - 1), whole = std::floor(place);
  const double value = at_rank(whole) + (place - whole) * (at_rank(whole + 1) - at_rank(whole));
  return {value, at_rank(boost::math::quantile(law, outside) - 1),
          at_rank(boost::math::quantile(boost::math::complement(law, outside)))};
}

// Kurtosis enters, since results are not normal: var(s^2) = (m4 - (n-3)/(n-1) s^4) / n.
Estimated deviation(const std::vector<double> &values, const double mean, const double sd)
{
  const double n = double(values.size());
  double m4      = 0;
  for (const double v : values)
    m4 += std::pow(v - mean, 4) / n;
  const double var_of_variance = std::max(0.0, (m4 - (n - 3) / (n - 1) * std::pow(sd, 4)) / n);
  const double half            = 1.96 * std::sqrt(var_of_variance) / (2 * sd);
  return {sd, sd - half, sd + half};
}

void add_histogram(ResultStatistics &s, const std::vector<double> &sorted)
{
  const double low = sorted.front(), high = sorted.back();
  if (is_constant(sorted))
    return;
  const auto bins = std::size_t(std::clamp(std::cbrt(double(sorted.size())) * 2, 5.0, 40.0));
  s.bin_shares.assign(bins, 0);
  for (std::size_t b = 0; b <= bins; ++b)
    s.bin_edges.push_back(low + (high - low) * double(b) / double(bins));
  for (const double v : sorted)
    s.bin_shares[std::min(bins - 1, std::size_t((v - low) / (high - low) * double(bins)))] +=
        1 / double(sorted.size());
}

// Squared standardised regression coefficients: exact shares of the variance for a linear result of independent
// inputs.
void add_shares(ResultStatistics &s, const std::vector<const DesignRow *> &rows, const std::vector<double> &values)
{
  const auto n = Eigen::Index(values.size()), d = Eigen::Index(rows.front()->numbers.size());
  if (n < 2 * (d + 1) || is_constant(values))
    return;
  Eigen::MatrixXd x(n, d);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    y[i] = values[std::size_t(i)];
    for (Eigen::Index k = 0; k < d; ++k)
      x(i, k) = rows[std::size_t(i)]->numbers[std::size_t(k)];
  }
  y.array() -= y.mean();
  x.rowwise() -= x.colwise().mean().eval();
  const Eigen::VectorXd size = x.colwise().norm();
  for (Eigen::Index k = 0; k < d; ++k)
    if (size[k] > 0)
      x.col(k) /= size[k];
  const double total           = y.norm();
  const Eigen::VectorXd slopes = x.colPivHouseholderQr().solve(y) / total;
  s.explained                  = 1 - (y / total - x * slopes).squaredNorm();
  for (Eigen::Index k = 0; k < d; ++k)
    s.shares.push_back(slopes[k] * slopes[k]);
}
}  // namespace

StudyRows study_rows(const Study &study)
{
  StudyRows rows;
  rows.design.reserve(std::size_t(study.rows));
  std::unordered_map<std::int64_t, std::vector<std::size_t>> places;
  read_design_by_row(study, [&](DesignRow &&row) {
    places[row.key].push_back(rows.design.size());
    rows.design.push_back(std::move(row));
  });
  rows.results.resize(rows.design.size());
  rows.failures.resize(rows.design.size());
  const ReadRows read = read_rows(merged_file(study.folder), 0, [&](FinishedRow &&row) {
    for (const std::size_t place : places[row.key]) {
      ++rows.finished;
      rows.failed += !row.failure.empty();
      rows.results[place]  = row.results;
      rows.failures[place] = row.failure;
    }
  });
  if (!read.fault.empty())
    throw InputError(read.fault);
  return rows;
}

ResultStatistics statistics_of(const Study &study, const StudyRows &rows, const std::size_t place,
                               const long sample_rows)
{
  std::vector<const DesignRow *> used;
  std::vector<double> values;
  const std::size_t end = sample_rows > 0 ? std::size_t(sample_rows) : rows.design.size();
  for (std::size_t i = 0; i < std::min(end, rows.design.size()); ++i)
    if (!rows.results[i].empty()) {
      used.push_back(&rows.design[i]);
      values.push_back(rows.results[i][place]);
    }
  if (values.size() < 3)
    throw InputError("fewer than three rows of " + study.folder + " have results; run 'millstand study run " +
                     study.folder + "'");
  ResultStatistics s;
  s.n            = long(values.size());
  const double n = double(s.n);
  const Eigen::Map<const Eigen::VectorXd> all(values.data(), Eigen::Index(values.size()));
  const double mean = all.mean(), sd = std::sqrt((all.array() - mean).square().sum() / (n - 1));
  const double t = boost::math::quantile(boost::math::complement(boost::math::students_t(n - 1), outside));
  s.mean         = {mean, mean - t * sd / std::sqrt(n), mean + t * sd / std::sqrt(n)};
  s.sd           = deviation(values, mean, sd);
  add_shares(s, used, values);
  std::sort(values.begin(), values.end());
  s.q025   = quantile(values, 0.025);
  s.median = quantile(values, 0.5);
  s.q975   = quantile(values, 0.975);
  add_histogram(s, values);
  return s;
}

double mean_of(const Spread &s)
{
  switch (s.kind) {
  case Spread::Kind::uniform:
    return 0.5 * (s.low + s.high);
  case Spread::Kind::normal:
    return s.mean;
  case Spread::Kind::truncated:
  case Spread::Kind::tolerance: {
    const boost::math::normal law;
    const double a = (s.low - s.mean) / s.sd, b = (s.high - s.mean) / s.sd;
    return s.mean + s.sd * (pdf(law, a) - pdf(law, b)) / (cdf(law, b) - cdf(law, a));
  }
  case Spread::Kind::triangular:
    return (s.low + s.mean + s.high) / 3;
  case Spread::Kind::none:
    break;
  }
  return not_given;
}

double deviation_of(const Spread &s)
{
  const auto truncated = [&] {
    const boost::math::normal law;
    const double a = (s.low - s.mean) / s.sd, b = (s.high - s.mean) / s.sd;
    const double inside = cdf(law, b) - cdf(law, a), first = (pdf(law, a) - pdf(law, b)) / inside;
    return s.sd * std::sqrt(1 + (a * pdf(law, a) - b * pdf(law, b)) / inside - first * first);
  };
  switch (s.kind) {
  case Spread::Kind::uniform:
    return (s.high - s.low) / std::sqrt(12.0);
  case Spread::Kind::normal:
    return s.sd;
  case Spread::Kind::truncated:
  case Spread::Kind::tolerance:
    return truncated();
  case Spread::Kind::triangular:
    return std::sqrt(
        (s.low * s.low + s.mean * s.mean + s.high * s.high - s.low * s.mean - s.low * s.high - s.mean * s.high) /
        18);
  case Spread::Kind::none:
    break;
  }
  return not_given;
}
}  // namespace mill
