#include "app/study/openturns/drawn_design.h"
#include "app/study/constant_result.h"
#include "core/base/errors.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <openturns/ComposedDistribution.hxx>
#include <openturns/LHSExperiment.hxx>
#include <openturns/LowDiscrepancyExperiment.hxx>
#include <openturns/MonteCarloExperiment.hxx>
#include <openturns/Normal.hxx>
#include <openturns/NormalCopula.hxx>
#include <openturns/RandomGenerator.hxx>
#include <openturns/SaltelliSensitivityAlgorithm.hxx>
#include <openturns/SobolIndicesExperiment.hxx>
#include <openturns/SobolSequence.hxx>
#include <openturns/Triangular.hxx>
#include <openturns/TruncatedNormal.hxx>
#include <openturns/Uniform.hxx>

namespace mill {
namespace {
constexpr long least_groups = 16;
}  // namespace

OT::Distribution distribution_of(const Spread &s)
{
  switch (s.kind) {
  case Spread::Kind::uniform:
    return OT::Uniform(s.low, s.high);
  case Spread::Kind::normal:
    return OT::Normal(s.mean, s.sd);
  case Spread::Kind::truncated:
  case Spread::Kind::tolerance:
    return OT::TruncatedNormal(s.mean, s.sd, s.low, s.high);
  case Spread::Kind::triangular:
    return OT::Triangular(s.low, s.mean, s.high);
  case Spread::Kind::none:
    break;
  }
  throw std::logic_error("an input without a distribution is drawn");
}

namespace {
OT::Distribution joint(const std::vector<Spread> &spreads, const std::vector<Correlation> &correlations)
{
  OT::ComposedDistribution::DistributionCollection marginals;
  for (const Spread &spread : spreads)
    marginals.add(distribution_of(spread));
  if (correlations.empty())
    return OT::ComposedDistribution(marginals);
  OT::CorrelationMatrix matrix(spreads.size());
  for (const Correlation &c : correlations)
    matrix(c.a, c.b) = c.value;
  if (!matrix.isPositiveDefinite())
    throw InputError("no distribution has these correlations together; make them smaller");
  return OT::ComposedDistribution(marginals, OT::NormalCopula(matrix));
}

std::vector<std::vector<double>> rows_of(const OT::Sample &sample)
{
  std::vector<std::vector<double>> rows(sample.getSize(), std::vector<double>(sample.getDimension()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < rows[i].size(); ++k)
      rows[i][k] = sample(i, k);
  return rows;
}

// The library divides independent inputs only.  Strata of correlated ones are those of the distribution's
// independent standard variables.  (52.12)
OT::Sample latin_hypercube(const OT::Distribution &inputs, const OT::UnsignedInteger size)
{
  if (inputs.hasIndependentCopula())
    return OT::LHSExperiment(inputs, size).generate();
  const OT::Sample standard = OT::LHSExperiment(inputs.getStandardDistribution(), size).generate();
  return inputs.getInverseIsoProbabilisticTransformation()(standard);
}
}  // namespace

std::vector<std::vector<double>> drawn_rows(const DrawMethod method, const std::vector<Spread> &spreads,
                                            const std::vector<Correlation> &correlations, const long n,
                                            const int seed)
{
  if (method == DrawMethod::saltelli && !correlations.empty())
    throw InputError("sobol takes independent inputs; leave --correlate out, or use another method");
  OT::RandomGenerator::SetSeed(OT::UnsignedInteger(seed));
  const OT::Distribution inputs = joint(spreads, correlations);
  const auto size               = OT::UnsignedInteger(n);
  switch (method) {
  case DrawMethod::latin_hypercube:
    return rows_of(latin_hypercube(inputs, size));
  case DrawMethod::monte_carlo:
    return rows_of(OT::MonteCarloExperiment(inputs, size).generate());
  case DrawMethod::saltelli:
    break;
  }
  const OT::LowDiscrepancyExperiment points(OT::SobolSequence(), inputs, size);
  return rows_of(OT::SobolIndicesExperiment(points, false).generate());
}

SobolIndices sobol_indices(const std::vector<std::vector<double>> &rows, const std::vector<double> &result,
                           const long n)
{
  const std::size_t d = rows.front().size(), size = std::size_t(n);
  std::vector<std::size_t> whole;  // groups without a failure
  for (std::size_t i = 0; i < size; ++i) {
    bool known = true;
    for (std::size_t block = 0; block < d + 2; ++block)
      known = known && std::isfinite(result[block * size + i]);
    if (known)
      whole.push_back(i);
  }
  if (long(whole.size()) < least_groups)
    throw InputError(fmt::format("only {} whole groups of rows are finished; Sobol indices need {} or more",
                                 whole.size(), least_groups));
  OT::Sample inputs(whole.size() * (d + 2), d), outputs(whole.size() * (d + 2), 1);
  for (std::size_t block = 0; block < d + 2; ++block)
    for (std::size_t i = 0; i < whole.size(); ++i) {
      const std::size_t from = block * size + whole[i], to = block * whole.size() + i;
      for (std::size_t k = 0; k < d; ++k)
        inputs(to, k) = rows[from][k];
      outputs(to, 0) = result[from];
    }
  SobolIndices indices;
  indices.groups = long(whole.size());
  std::vector<double> of_a(whole.size());  // the library takes the variance from them
  for (std::size_t i = 0; i < whole.size(); ++i)
    of_a[i] = outputs(i, 0);
  if (is_constant(of_a))
    return indices;
  OT::SaltelliSensitivityAlgorithm algorithm(inputs, outputs, whole.size());
  algorithm.setUseAsymptoticDistribution(true);
  algorithm.setConfidenceLevel(0.95);
  const OT::Point first = algorithm.getFirstOrderIndices(), total = algorithm.getTotalOrderIndices();
  const OT::Interval first_ends = algorithm.getFirstOrderIndicesInterval(),
                     total_ends = algorithm.getTotalOrderIndicesInterval();
  for (std::size_t k = 0; k < d; ++k) {
    indices.first.push_back(first[k]);
    indices.total.push_back(total[k]);
    indices.first_low.push_back(first_ends.getLowerBound()[k]);
    indices.first_high.push_back(first_ends.getUpperBound()[k]);
    indices.total_low.push_back(total_ends.getLowerBound()[k]);
    indices.total_high.push_back(total_ends.getUpperBound()[k]);
  }
  return indices;
}
}  // namespace mill
