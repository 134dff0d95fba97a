#include "fem/contact_solver.h"
#include "core/errors.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

namespace mill::fem {
namespace {
// Equations of one active set A:  C_AA force + g_A = q 1,  sum force = F.
struct ActiveSystem {
  std::vector<int> index;
  Eigen::MatrixXd C;
  Eigen::LLT<Eigen::MatrixXd> factor;
  Eigen::VectorXd unit;  // C_AA^-1 1

  ActiveSystem(const ContactProblem &p, const std::vector<char> &active)
  {
    for (std::size_t i = 0; i < active.size(); ++i)
      if (active[i])
        index.push_back(int(i));
    C      = p.C(index, index);
    factor = C.llt();
    unit   = solve(Eigen::VectorXd::Ones(C.rows()));
  }

  // With one step of iterative refinement: the residual is reported, so it should be that of the arithmetic.
  Eigen::VectorXd solve(const Eigen::VectorXd &b) const
  {
    Eigen::VectorXd x = factor.solve(b);
    x += factor.solve(b - C * x);
    return x;
  }

  // force and q with  C_AA force = q 1 - g,  sum force = total
  std::pair<Eigen::VectorXd, double> equilibrium(const Eigen::VectorXd &g, const double total) const
  {
    const Eigen::VectorXd free = -solve(g);
    const double q             = (total - free.sum()) / unit.sum();
    return {free + q * unit, q};
  }
};

std::vector<char> first_guess(const ContactProblem &p)
{
  // Everything may touch: the first solve then releases what pulls.
  return std::vector<char>(p.initial_gap.size(), 1);
}
}  // namespace

ContactState solve_contact(const ContactProblem &p, const double force, const std::vector<char> &start)
{
  const int n              = int(p.initial_gap.size());
  const Eigen::VectorXd g0 = p.initial_gap + force * p.support;
  ContactState s;
  s.force  = force;
  s.active = start.size() == std::size_t(n) ? start : first_guess(p);
  std::set<std::vector<char>> seen;
  for (s.iterations = 1; s.iterations <= 60; ++s.iterations) {
    const ActiveSystem system(p, s.active);
    const auto [nodal, q]     = system.equilibrium(g0(system.index), force);
    s.q                       = q;
    s.nodal                   = Eigen::VectorXd::Zero(n);
    s.nodal(system.index)     = nodal;
    const Eigen::VectorXd gap = g0 + p.C * s.nodal - Eigen::VectorXd::Constant(n, q);

    // What pulls leaves, what penetrates enters.  A set seen before means a cycle: then one node at a time, the
    // first.
    const double scale_gap = std::max(std::abs(q), gap.cwiseAbs().maxCoeff());
    std::vector<char> next = s.active;
    const bool one_by_one  = !seen.insert(s.active).second;
    for (int i = 0; i < n; ++i) {
      const bool leave = s.active[i] && s.nodal[i] < 0;
      const bool enter = !s.active[i] && gap[i] < -1e-14 * scale_gap;
      if (leave || enter)
        next[i] = enter;
      if (one_by_one && (leave || enter))
        break;
    }
    if (next == s.active) {
      double violation = std::abs(s.nodal.sum() / force - 1);
      for (int i = 0; i < n; ++i)
        violation =
            std::max(violation, s.active[i] ? std::abs(gap[i]) / scale_gap : std::max(0., -gap[i]) / scale_gap);
      s.residual              = violation;
      const auto [d, dq]      = system.equilibrium(p.support(system.index), 1.);
      s.d_q                   = dq;
      s.d_nodal               = Eigen::VectorXd::Zero(n);
      s.d_nodal(system.index) = d;
      return s;
    }
    if (std::none_of(next.begin(), next.end(), [](const char a) { return a; }))
      next[std::distance(g0.data(), std::min_element(g0.data(), g0.data() + n))] = 1;
    s.active = next;
  }
  throw SolverError({"contact: no active set found", "it alternates after 60 iterations",
                     "an operator that is not positive definite", "report the case", ""});
}
}  // namespace mill::fem
