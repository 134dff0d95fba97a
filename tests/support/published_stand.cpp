#include "tests/support/published_stand.h"
#include "tests/support/reference.h"
#include <cmath>
#include <map>

mill::LumpedModel published_stand()
{
  mill::LumpedModel stand;
  const Eigen::VectorXd M = reference_vector("published.M"), K = reference_vector("published.K");
  for (std::size_t i = 0; i < 6; ++i)
    stand.M[i].value = M[Eigen::Index(i)];
  for (std::size_t i = 0; i < 7; ++i)
    stand.K[i].value = K[Eigen::Index(i)];
  return stand;
}

mill::DynamicsSettings settings(const mill::ForceMeaning force_meaning, const double modal_damping)
{
  mill::DynamicsSettings result;
  result.force_meaning = force_meaning;
  result.modal_damping = modal_damping;
  return result;
}

ParameterSet parameter_set(const std::string &name)
{
  struct Choice {
    mill::ForceMeaning meaning;
    double modal, gap_damper;  // -, N s/m
  };
  const std::map<std::string, Choice> choices = {{"P1", {mill::ForceMeaning::published, 0, 1.91141e8}},
                                                 {"P2", {mill::ForceMeaning::published, 0, 1.91141e5}},
                                                 {"P3", {mill::ForceMeaning::published, 0.01, 1.91141e5}},
                                                 {"P4", {mill::ForceMeaning::published, 0.02, 0}},
                                                 {"Q1", {mill::ForceMeaning::measured, 0.02, 1.91141e8}},
                                                 {"R1", {mill::ForceMeaning::measured, 0.02, 1.91141e8}},
                                                 {"R2", {mill::ForceMeaning::disturbance, 0.02, 0}},
                                                 {"R3", {mill::ForceMeaning::measured, 0.03, 0}}};
  const Choice choice                         = choices.at(name);
  ParameterSet set{published_stand(), settings(choice.meaning, choice.modal)};
  set.stand.C.value = choice.gap_damper;  // a measured force leaves it out, as it does K4
  if (name[0] == 'R') {
    const auto K         = reference("regression." + name + ".system").at("K").get<std::vector<double>>();
    set.stand.K[2].value = K[2];
    set.stand.K[4].value = K[4];
    if (name == "R2")
      set.stand.K[3].value = 3e8;
  }
  return set;
}

mill::ForceRecord twelve_tones()
{
  const auto tones       = reference("regression.force");
  const auto frequencies = tones.at("frequencies").get<std::vector<double>>();
  const auto n           = tones.at("samples").get<Eigen::Index>();
  mill::ForceRecord record;
  record.time  = Eigen::ArrayXd::LinSpaced(n, 0, double(n - 1)) * tones.at("h").get<double>();
  record.force = Eigen::VectorXd::Constant(n, tones.at("mid").get<double>());
  for (std::size_t i = 1; i <= frequencies.size(); ++i)
    record.force.array() +=
        tones.at("amplitude").get<double>() * (2 * M_PI * frequencies[i - 1] * record.time.array() +
                                               tones.at("phase_factor").get<double>() * double(i * i))
                                                  .sin();
  return record;
}
