#include "fem/roll/contact_study.h"
#include <utility>

namespace mill::fem {
SolvedLoads::SolvedLoads(Known known) : at(std::move(known)) {}

SolvedLoads::Known SolvedLoads::known() const
{
  const std::lock_guard lock(access);
  return at;
}

// Two threads may solve one load; both find the same.
ContactPoint SolvedLoads::point(const double load, const std::function<ContactPoint()> &solve)
{
  {
    const std::lock_guard lock(access);
    if (const auto match = at.points.find(load); match != at.points.end())
      return match->second;
  }
  ContactPoint point = solve();
  const std::lock_guard lock(access);
  return at.points.emplace(load, std::move(point)).first->second;
}

Eigen::MatrixXd SolvedLoads::number(const std::string &name, const std::function<Eigen::MatrixXd()> &make)
{
  {
    const std::lock_guard lock(access);
    if (const auto match = at.numbers.find(name); match != at.numbers.end())
      return match->second;
  }
  Eigen::MatrixXd made = make();
  const std::lock_guard lock(access);
  return at.numbers.emplace(name, std::move(made)).first->second;
}

Eigen::MatrixXd remembered(const ContactPair &pair, const std::string &name,
                           const std::function<Eigen::MatrixXd()> &make)
{
  return pair.solved ? pair.solved->number(name, make) : make();
}
}  // namespace mill::fem
