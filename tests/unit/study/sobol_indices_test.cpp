#include "app/study/analysis_program.h"
#include "tests/support/near.h"
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

// Indices by the program that holds OpenTURNS, on functions whose indices are exact.
namespace {
using namespace mill;

Study study_of(const std::size_t inputs, const double low, const double high)
{
  Study study;
  for (std::size_t k = 0; k < inputs; ++k) {
    UncertainKey key;
    key.key.name = "x" + std::to_string(k + 1);
    key.spread   = {Spread::Kind::uniform, not_given, not_given, low, high};
    study.keys.push_back(key);
  }
  return study;
}

IndicesOfResult indices(const Study &study, const long n,
                        const std::function<double(const std::vector<double> &)> &f)
{
  const auto rows = draw_rows(study, StudyMethod::sobol, n);
  std::vector<double> results;
  for (const auto &row : rows)
    results.push_back(f(row));
  return indices_of(rows, {results}, n).front();
}

void expect_index(const double value, const double exact, const double low, const double high,
                  const std::string &name)
{
  EXPECT_TRUE(near(value, exact, within_absolute(0.01, "scatter of 2^13 groups of Sobol points"))) << name;
  EXPECT_LE(low, exact) << name << ": the interval holds the exact value";
  EXPECT_GE(high, exact) << name << ": the interval holds the exact value";
}

TEST(SobolIndices, OfIshigamisFunctionAreExact)
{
  const double a = 7, b = 0.1, p4 = std::pow(M_PI, 4), p8 = p4 * p4;
  const double V1 = 0.5 * std::pow(1 + b * p4 / 5, 2), V2 = a * a / 8, V13 = b * b * p8 * (1.0 / 18 - 1.0 / 50);
  const double V = V1 + V2 + V13;
  const auto s   = indices(study_of(3, -M_PI, M_PI), 8192, [&](const std::vector<double> &x) {
    return std::sin(x[0]) + a * std::pow(std::sin(x[1]), 2) + b * std::pow(x[2], 4) * std::sin(x[0]);
  });
  const double first[]{V1 / V, V2 / V, 0}, total[]{(V1 + V13) / V, V2 / V, V13 / V};
  for (std::size_t k = 0; k < 3; ++k) {
    expect_index(s.first[k], first[k], s.first_low[k], s.first_high[k], "S" + std::to_string(k + 1));
    expect_index(s.total[k], total[k], s.total_low[k], s.total_high[k], "T" + std::to_string(k + 1));
  }
  EXPECT_EQ(s.groups, 8192);
}

TEST(SobolIndices, OfSobolsFunctionAreExact)
{
  const std::vector<double> a{0, 1, 4.5, 9, 99, 99, 99, 99};
  double product = 1;
  for (const double ak : a)
    product *= 1 + 1 / (3 * (1 + ak) * (1 + ak));
  const auto s = indices(study_of(8, 0, 1), 8192, [&](const std::vector<double> &x) {
    double y = 1;
    for (std::size_t k = 0; k < a.size(); ++k)
      y *= (std::abs(4 * x[k] - 2) + a[k]) / (1 + a[k]);
    return y;
  });
  for (std::size_t k = 0; k < 4; ++k) {
    const double exact = 1 / (3 * (1 + a[k]) * (1 + a[k])) / (product - 1);
    expect_index(s.first[k], exact, s.first_low[k], s.first_high[k], "S" + std::to_string(k + 1));
  }
}

TEST(SobolIndices, AFailureTakesItsWholeGroupOut)
{
  const Study study = study_of(2, 0, 1);
  const auto rows   = draw_rows(study, StudyMethod::sobol, 256);
  std::vector<double> results;
  for (const auto &row : rows)
    results.push_back(row[0] + 2 * row[1]);
  results[300] = std::nan("");
  const auto s = indices_of(rows, {results}, 256).front();
  EXPECT_EQ(s.groups, 255);
  EXPECT_TRUE(near(s.first[1], 0.8, within_absolute(0.05, "scatter of 255 groups; exact 4/5 for x1 + 2 x2")));
}

// A result without variance has no shares; it must not take them from the others.
TEST(SobolIndices, AResultThatIsTheSameInAllRowsHasNone)
{
  const Study study = study_of(2, 0, 1);
  const auto rows   = draw_rows(study, StudyMethod::sobol, 256);
  std::vector<double> still(rows.size(), 1.8e10), rounded = still, moved;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rounded[i] *= 1 + 1e-15 * rows[i][0];
    moved.push_back(rows[i][0] + 2 * rows[i][1]);
  }
  const auto s = indices_of(rows, {still, moved, rounded}, 256);
  ASSERT_EQ(s.size(), 3u);
  EXPECT_TRUE(s[0].first.empty());
  EXPECT_TRUE(s[2].total.empty()) << "rounding is not a variance";
  EXPECT_TRUE(near(s[1].first[1], 0.8, within_absolute(0.05, "scatter of 256 groups; exact 4/5 for x1 + 2 x2")));
}

TEST(SobolIndices, CorrelatedInputsAreRefused)
{
  Study study        = study_of(2, 0, 1);
  study.correlations = {"x1,x2=0.5"};
  EXPECT_THROW(draw_rows(study, StudyMethod::sobol, 64), InputError);
  const auto rows = draw_rows(study, StudyMethod::monte_carlo, 4000);
  double product  = 0;
  for (const auto &row : rows)
    product += (row[0] - 0.5) * (row[1] - 0.5) * 12 / 4000;
  // Normal copula: correlation of the uniform marginals 6/pi asin(rho/2).
  EXPECT_TRUE(near(product, 6 / M_PI * std::asin(0.25),
                   within_absolute(0.05, "three standard errors of a correlation of 4000 rows")));
  study.correlations = {"x1,x3=0.5"};
  EXPECT_THROW(draw_rows(study, StudyMethod::monte_carlo, 64), InputError);
}

// Places in [0, 1) of uniform inputs, each in the first, second, .. of n strata.
std::vector<std::size_t> rows_of_strata(const std::vector<double> &places)
{
  std::vector<std::size_t> rows(places.size(), 0);
  for (const double place : places)
    ++rows.at(std::size_t(place * double(places.size())));
  return rows;
}

TEST(LatinHypercube, JoinsItsStrataToCorrelatedInputs)
{
  constexpr double r   = 0.9;
  constexpr long n     = 500;
  Study study          = study_of(3, 0, 1);
  study.correlations   = {"x1,x2=0.9"};
  const auto normal    = [](const double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); };
  const auto normal_of = [](const double p) { return boost::math::quantile(boost::math::normal(), p); };
  const auto rows      = draw_rows(study, StudyMethod::latin_hypercube, n);
  const std::vector<std::size_t> one_each(n, 1);
  std::vector<double> first, second, third;
  double product = 0;
  for (const auto &row : rows) {
    const double z1 = normal_of(row[0]), z2 = normal_of(row[1]);
    first.push_back(row[0]);
    second.push_back(
        normal((z2 - r * z1) / std::sqrt(1 - r * r)));  // independent part, second row of the Cholesky factor
    third.push_back(row[2]);
    product += z1 * z2 / n;
  }
  EXPECT_EQ(rows_of_strata(first), one_each);
  EXPECT_EQ(rows_of_strata(second), one_each);
  EXPECT_EQ(rows_of_strata(third), one_each) << "an input without correlation keeps its strata";
  EXPECT_TRUE(near(product, r,
                   within_absolute(0.18, "three standard errors of a product of 500 rows, "
                                         "sqrt((1 + r2) / n) if they were independent")));
}

TEST(LatinHypercube, RefusesCorrelationsThatExcludeEachOther)
{
  Study study        = study_of(3, 0, 1);
  study.correlations = {"x1,x2=0.9", "x1,x3=0.9", "x2,x3=-0.9"};
  EXPECT_THROW(draw_rows(study, StudyMethod::latin_hypercube, 16), InputError);
}
}  // namespace
