#include "tests/manual/solvers/full_contact.h"
#include "core/base/errors.h"
#include "fem/roll/condensed_roll.h"
#include <algorithm>
#include <cmath>

namespace mill::fem {
FullContact solve_full_contact(const ElasticBody &first, const ElasticBody &second, const Eigen::VectorXd &gap,
                               const double q, const bool slab)
{
  // Unknowns of both bodies one after the other.  An active pair is tied by  u_second = -u_first - (q - gap),
  // where u is the displacement along y of each body's own frame, the contact being its highest point.
  const ElasticBody *bodies[2] = {&first, &second};
  const int n_first            = int(first.stiffness().rows());
  const int n_all              = n_first + int(second.stiffness().rows());
  std::vector<char> held(n_all, 0);
  std::vector<int> patch[2];
  for (int b = 0, offset = 0; b < 2; offset += int(bodies[b++]->stiffness().rows())) {
    const auto h = constrained_unknowns(*bodies[b], {true, false}, slab);
    std::copy(h.begin(), h.end(), held.begin() + offset);
    for (const int node : patch_in_grid_order(*bodies[b]))
      patch[b].push_back(offset + 3 * node + 1);
  }
  const int n = int(gap.size());
  FullContact out;
  std::vector<char> active(n, 1);
  for (out.iterations = 1; out.iterations <= 60; ++out.iterations) {
    std::vector<int> place(n_all, -1), node;
    std::vector<int> master(n_all, -1);
    for (int i = 0; i < n; ++i)
      if (active[i])
        master[patch[1][i]] = patch[0][i];
    for (int i = 0; i < n_all; ++i)
      if (!held[i] && master[i] < 0) {
        place[i] = int(node.size());
        node.push_back(i / 3);
      }
    // u = sign v + shift for a tied unknown, u = v otherwise.
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(n_all);
    for (int i = 0; i < n; ++i)
      if (active[i])
        shift[patch[1][i]] = -(q - gap[i]);
    const auto target = [&](const int i) { return master[i] >= 0 ? place[master[i]] : place[i]; };
    const auto sign   = [&](const int i) { return master[i] >= 0 ? -1. : 1.; };
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(Eigen::Index(node.size()));
    for (int b = 0, offset = 0; b < 2; offset += int(bodies[b++]->stiffness().rows()))
      for (int j = 0; j < bodies[b]->stiffness().outerSize(); ++j)
        for (SymmetricSparse::InnerIterator it(bodies[b]->stiffness(), j); it; ++it) {
          const int r = offset + int(it.row()), c = offset + j, tr = target(r), tc = target(c);
          const auto add = [&](const int row, const int col, const int from, const double s) {
            if (row >= 0)
              load[row] -= s * it.value() * shift[from];
            if (row >= 0 && col >= 0 && row <= col)
              entries.emplace_back(row, col, s * sign(from) * it.value());
          };
          if (!held[r])
            add(tr, held[c] ? -1 : tc, c, sign(r));
          if (r != c && !held[c])
            add(tc, held[r] ? -1 : tr, r, sign(c));
        }
    SymmetricSparse K(Eigen::Index(node.size()), Eigen::Index(node.size()));
    K.setFromTriplets(entries.begin(), entries.end());
    const CondensingFactor factor(K, node, {});
    Eigen::VectorXd v = factor.solve(load);
    v += factor.solve(load - K.selfadjointView<Eigen::Upper>() * v);  // refined: it is compared at 1e-8
    Eigen::VectorXd u = shift;
    for (int i = 0; i < n_all; ++i)
      if (target(i) >= 0 && !held[i])
        u[i] += sign(i) * v[target(i)];

    const Eigen::VectorXd reaction = -(first.stiffness().selfadjointView<Eigen::Upper>() * u.head(n_first));
    out.nodal                      = Eigen::VectorXd::Zero(n);
    std::vector<char> next         = active;
    for (int i = 0; i < n; ++i) {
      const double open = gap[i] - u[patch[0][i]] - u[patch[1][i]] - q;
      if (active[i])
        out.nodal[i] = reaction[patch[0][i]];
      if (active[i] ? out.nodal[i] < 0 : open < -1e-13 * q)
        next[i] = !active[i];
    }
    out.force = out.nodal.sum();
    if (next == active)
      return out;
    active = next;
  }
  throw SolverError({"full contact: no active set found", "", "", "", ""});
}
}  // namespace mill::fem
