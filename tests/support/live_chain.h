#pragma once
#include "tests/support/reference.h"
#include <Eigen/Core>
#include <fmt/format.h>
#include <string>

// A case of kind lumped for tests of the built program: published masses, roll contacts of solid rolls, 1 %
// damping.

/// N/m, K1..K7 of that stand.
inline Eigen::VectorXd chain_stiffness()
{
  const auto K = reference("regression.R1.system").at("K").get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(K.data(), Eigen::Index(K.size()));
}

/// Text of the case; `more` comes behind it, from inside [dynamics] on.
inline std::string chain_case(const std::string &more = "")
{
  const Eigen::VectorXd M = reference_vector("published.M"), K = chain_stiffness();
  std::string text = "schema = 1\nkind = \"lumped\"\ntitle = \"chain\"\n[given]\n";
  for (Eigen::Index i = 0; i < M.size(); ++i)
    text += fmt::format("M{} = {{ value = \"{} kg\", source = \"published\" }}\n", i + 1, M[i]);
  for (Eigen::Index i = 0; i < K.size(); ++i)
    text += fmt::format("K{} = {{ value = \"{} N/m\", source = \"published\" }}\n", i + 1, K[i]);
  return text + "[dynamics]\nmodal_damping = \"1 %\"\nforce_meaning = \"measured\"\n" + more;
}

/// A force (N) that repeats itself every `period` samples and has the same amplitude at every line from the fifth
/// to the `last`: a spectrum over one period is the frequency response itself, without scatter.
inline Eigen::VectorXd comb_force(const Eigen::Index period, const Eigen::Index last, const double mean,
                                  const double amplitude)
{
  Eigen::VectorXd force = Eigen::VectorXd::Constant(period, mean);
  const auto time       = Eigen::ArrayXd::LinSpaced(period, 0, 2 * M_PI * double(period - 1) / double(period));
  for (Eigen::Index k = 5; k <= last; ++k)
    force.array() += amplitude * (double(k) * time + 0.37 * double(k * k)).sin();
  return force;
}
