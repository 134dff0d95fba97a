#include "app/study/analysis_program.h"
#include "tests/support/near.h"
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

// Polynomial chaos by the program that holds OpenTURNS, on functions whose indices are exact.
namespace {
using namespace mill;
using json = nlohmann::ordered_json;

struct Fitted {
  json fit;
  std::vector<std::vector<double>> rows;
};

Fitted fitted(Study study, const long n, const std::function<double(const std::vector<double> &)> &f)
{
  study.method  = StudyMethod::chaos;
  study.samples = n;
  Fitted all;
  all.rows            = draw_rows(study, StudyMethod::latin_hypercube, n);
  study.seed          = 2;
  const auto held_out = draw_rows(study, StudyMethod::monte_carlo, held_out_rows(study));
  all.rows.insert(all.rows.end(), held_out.begin(), held_out.end());
  std::vector<double> results;
  for (const auto &row : all.rows)
    results.push_back(f(row));
  all.fit = chaos_of(study, all.rows, {results}, n)[0];
  return all;
}

Study study_with(const std::vector<Spread> &spreads)
{
  Study study;
  for (std::size_t k = 0; k < spreads.size(); ++k) {
    UncertainKey key;
    key.key.name = "x" + std::to_string(k + 1);
    key.spread   = spreads[k];
    study.keys.push_back(key);
  }
  return study;
}

TEST(Chaos, IndicesOfIshigamisFunctionAreExact)
{
  const Spread uniform{Spread::Kind::uniform, not_given, not_given, -M_PI, M_PI};
  const auto fit =
      fitted(study_with({uniform, uniform, uniform}), 256, [](const std::vector<double> &x) {
        return std::sin(x[0]) + 7 * std::pow(std::sin(x[1]), 2) + 0.1 * std::pow(x[2], 4) * std::sin(x[0]);
      }).fit;
  const double first[]{0.313905191, 0.442411145, 0},
      total[]{0.557588855, 0.442411145, 0.243683664};  // closed form
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_TRUE(near(fit["first"][k].get<double>(), first[k],
                     within_absolute(0.01, "the tolerance that is wanted of Sobol indices")))
        << k;
    EXPECT_TRUE(near(fit["total"][k].get<double>(), total[k],
                     within_absolute(0.01, "the tolerance that is wanted of Sobol indices")))
        << k;
  }
  EXPECT_LT(fit["held_out"].get<double>(), 0.01) << "rows that took no part in the fit";
  EXPECT_LT(fit["leave_one_out"].get<double>(), 0.01);
  EXPECT_TRUE(near(fit["mean"].get<double>(), 3.5, within(0.01, "mean a/2, closed form; truncated at degree 8")));
}

TEST(Chaos, APolynomialIsFoundExactly)
{
  // A diameter with a drawing's tolerance, a normal and a triangular input, in their own units.
  const std::vector<Spread> spreads{{Spread::Kind::tolerance, 420, 0.5 / 3, 419.5, 420.5},
                                    {Spread::Kind::normal, 210, 2.1, not_given, not_given},
                                    {Spread::Kind::triangular, 1.0, not_given, 0.5, 2.0}};
  const auto f = [](const std::vector<double> &x) { return 3 * (x[0] - 420) * (x[0] - 420) + 0.01 * x[1] * x[2]; };
  const auto [fit, rows] = fitted(study_with(spreads), 64, f);
  EXPECT_LT(fit["held_out"].get<double>(), 1e-12) << "a polynomial of degree 2 is reproduced";
  ASSERT_EQ(fit["held_out_rows"], 20);
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_TRUE(near(fit["predicted"][i].get<double>(), f(rows[64 + i]),
                     within(1e-8, "solution of a regular linear system")));
  EXPECT_EQ(fit["map"]["height"].size(), 21u);
}

// A linear function: spread and shares follow from the variances of the laws, whatever their form.
TEST(Chaos, SpreadAndSharesHoldForEveryLaw)
{
  // Deviation of a normal law cut at a and b deviations to both sides of its mean, and its mean.
  const auto cut = [](const double a, const double b) {
    const auto density = [](const double x) { return std::exp(-0.5 * x * x) / std::sqrt(2 * M_PI); };
    const double z = 0.5 * (std::erf(b / M_SQRT2) - std::erf(a / M_SQRT2)), m = (density(a) - density(b)) / z;
    return std::sqrt(1 + (a * density(a) - b * density(b)) / z - m * m);
  };
  const std::vector<Spread> spreads{{Spread::Kind::tolerance, 58, 0.5, 56.5, 59.5},
                                    {Spread::Kind::truncated, 10, 2, 9, 1e9},
                                    {Spread::Kind::normal, 210, 2.1, not_given, not_given},
                                    {Spread::Kind::uniform, not_given, not_given, 0, 3},
                                    {Spread::Kind::triangular, 1.0, not_given, 0.5, 2.0}};
  const double sd[]{0.5 * cut(-3, 3), 2 * cut(-0.5, 8), 2.1, 3 / std::sqrt(12.0),
                    std::sqrt((0.25 + 1 + 4 - 0.5 - 1 - 2) / 18)};  // closed forms
  const double slopes[]{-3, 0.7, 0.5, 1, 2};
  const auto fit  = fitted(study_with(spreads), 64, [&](const std::vector<double> &x) {
                     double sum = 0;
                     for (std::size_t k = 0; k < x.size(); ++k)
                       sum += slopes[k] * x[k];
                     return sum;
                   }).fit;
  double variance = 0;
  for (std::size_t k = 0; k < 5; ++k)
    variance += std::pow(slopes[k] * sd[k], 2);
  EXPECT_TRUE(near(fit["sd"].get<double>(), std::sqrt(variance), within(1e-6, "quadrature of the cut laws")));
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_TRUE(near(fit["first"][k].get<double>(), std::pow(slopes[k] * sd[k], 2) / variance,
                     within(1e-6, "quadrature of the cut laws")))
        << k;
}

TEST(Chaos, TheHeldOutErrorShowsWhatLeaveOneOutDoesNot)
{
  const Spread uniform{Spread::Kind::uniform, not_given, not_given, 0, 1};
  // A step: no polynomial of low degree follows it.
  const auto fit = fitted(study_with({uniform, uniform}), 24, [](const std::vector<double> &x) {
                     return x[0] > 0.83 ? 1.0 : 0.01 * x[1];
                   }).fit;
  EXPECT_GT(fit["held_out"].get<double>(), 0.05);
}

TEST(Chaos, AResultThatIsTheSameInAllRowsIsNotFitted)
{
  const Spread uniform{Spread::Kind::uniform, not_given, not_given, 0, 1};
  Study study     = study_with({uniform});
  const auto rows = draw_rows(study, StudyMethod::latin_hypercube, 32);
  std::vector<double> moved;
  for (const auto &row : rows)
    moved.push_back(2 * row[0]);
  const json fits = chaos_of(study, rows, {std::vector<double>(rows.size(), 1.8e10), moved}, 32);
  EXPECT_TRUE(fits[0].is_null());
  EXPECT_TRUE(near(fits[1]["first"][0].get<double>(), 1, within(1e-9, "one input has the whole variance")));
}

TEST(Chaos, ARowThatFailedIsLeftOut)
{
  const Spread uniform{Spread::Kind::uniform, not_given, not_given, 0, 1};
  const auto fit = fitted(study_with({uniform}), 32, [](const std::vector<double> &x) {
                     return x[0] < 0.1 ? std::nan("") : 2 * x[0];
                   }).fit;
  EXPECT_LT(fit["rows"].get<long>(), 32);
  EXPECT_LT(fit["held_out"].get<double>(), 1e-12);
}
}  // namespace
