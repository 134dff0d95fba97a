#pragma once
#include "fem/strip/elastic_plastic/strip_elastic_equations.h"

namespace mill::fem {
/// What is read off a solved state, with its exact derivatives; history and time are left to the caller.
StripElastic elastic_results(const ElasticPass &pass, const ElasticGrid &grid, const ElasticRoll &roll,
                             ElasticStage stage, const Eigen::VectorXd &unknowns);
}  // namespace mill::fem
