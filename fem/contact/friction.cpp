#include "fem/contact/friction.h"
#include "core/base/errors.h"
#include "fem/contact/active_set.h"
#include "fem/contact/mode_equations.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

namespace mill::contact {
namespace {
using Eigen::MatrixXd;
using Eigen::VectorXd;

int tangents_of(const FrictionProblem &p)
{
  const auto n = p.initial_gap.size();
  return n > 0 && p.C.rows() % n == 0 ? int(p.C.rows() / n) - 1 : 0;
}

void require(const FrictionProblem &p)
{
  const auto N = p.C.rows(), n = p.initial_gap.size(), k = p.G.cols();
  const int d = tangents_of(p);
  if (d < 1 || d > 2 || p.C.cols() != N || p.G.rows() != N || k == 0 || p.mu.size() != n ||
      (p.W.size() > 0 && (p.W.rows() != N || p.W.cols() != k)))
    throw InputError("friction: sizes do not fit: C " + std::to_string(N) + " x " + std::to_string(p.C.cols()) +
                     ", G " + std::to_string(p.G.rows()) + " x " + std::to_string(k) + ", gap " +
                     std::to_string(n) + ", mu " + std::to_string(p.mu.size()));
  if (!p.C.allFinite() || !p.G.allFinite() || !p.W.allFinite() || !p.initial_gap.allFinite() || !p.mu.allFinite())
    throw InputError("friction: the problem holds a number that is not finite");
  if (!(p.mu.array() >= 0).all() || !(p.C.diagonal().array() > 0).all())
    throw InputError("friction: mu is negative, or a diagonal entry of the compliance is not positive");
}

// Forces, modes and openings of an iterate.
struct Iterate {
  ModeState modes;
  MatrixXd gram;
  VectorXd nodal, opening;  // (N), (N) minus the opening at the start of the step for the tangents
  double length = 0;        // m, of the closing: the scale of rounding in an opening
};

struct Sets {
  std::vector<Status> status;  // (n)
  MatrixXd direction;          // (n, d) unit, of slipping nodes
  VectorXd bend;               // (n) mu p / |t + slip / compliance|: how much the direction follows the slip
};
}  // namespace

struct FrictionSolver::Implementation {
  FrictionProblem p;
  ScaledModes modes;  // the gap column holds (initial gap, slip at the start of the step)
  int n, d;
  double size;  // m/N, mean diagonal of the tangential compliance
  FrictionState last;
  Sets sets;

  explicit Implementation(FrictionProblem problem) : p(std::move(problem)), n(int(p.initial_gap.size()))
  {
    d = tangents_of(p);
    VectorXd gap(p.C.rows());
    gap << p.initial_gap, VectorXd::Zero(n * d);
    modes = scaled_modes(p.G, p.W, p.C.diagonal().mean(), gap);
    size  = p.C.diagonal().tail(n * d).mean();
    reset();
  }

  void reset()
  {
    const auto N   = p.C.rows();
    const int k    = modes.k;
    last           = {};
    last.motion    = VectorXd::Zero(k);
    last.resultant = VectorXd::Zero(k);
    last.nodal     = VectorXd::Zero(N);
    last.gap       = p.initial_gap;
    last.slip      = VectorXd::Zero(n * d);
    last.increment = VectorXd::Zero(n * d);
    last.stiffness = MatrixXd::Zero(k, k);
    last.status    = std::vector<Status>(n, Status::open);
    sets           = {last.status, MatrixXd::Zero(n, d), VectorXd::Zero(n)};
  }

  VectorXd tangential(const VectorXd &values, const int i) const
  {
    VectorXd out(d);
    for (int c = 0; c < d; ++c)
      out[c] = values[n + c * n + i];
    return out;
  }

  // The equations of a status: each row is a share of the openings equal to zero and a share of the forces.
  // `bounds` (n) frozen friction bounds, or null: mu times the normal force of the same solution.
  bool solve(const Sets &s, const Loading &loading, const VectorXd *bounds, Iterate &out) const
  {
    const int k = modes.k, N = int(p.C.rows());
    std::vector<int> in, row_of(n, -1);
    for (int i = 0; i < n; ++i)
      if (s.status[i] != Status::open) {
        row_of[i] = int(in.size());
        in.push_back(i);
      }
    const int a = int(in.size()), m = a * (1 + d);
    std::vector<int> component(m);  // component of each unknown
    for (int c = 0; c <= d; ++c)
      for (int i = 0; i < a; ++i)
        component[c * a + i] = c * n + in[i];
    MatrixXd A(m, m), B(m, modes.rhs.cols() + 1);  // last column: forces that are imposed by frozen bounds
    for (int j = 0; j < m; ++j) {
      const double *column = p.C.col(component[j]).data();
      for (int i = 0; i < m; ++i)
        A(i, j) = column[component[i]];
    }
    for (int i = 0; i < m; ++i)
      B.row(i) << modes.rhs.row(component[i]), 0.;
    for (int i = 0; i < a; ++i) {
      if (s.status[in[i]] != Status::slip)
        continue;
      // t - mu p e - bend P (t - opening / size) = 0 with P = 1 - e e^T, times `size` so that all rows are
      // lengths.
      const VectorXd e = s.direction.row(in[i]).transpose();
      const MatrixXd P = s.bend[in[i]] * (MatrixXd::Identity(d, d) - e * e.transpose());
      MatrixXd rows(d, m), rhs(d, B.cols());
      for (int c = 0; c < d; ++c) {
        rows.row(c) = A.row((1 + c) * a + i);
        rhs.row(c)  = B.row((1 + c) * a + i);
      }
      rows = (P * rows).eval();
      rhs  = (P * rhs).eval();
      for (int c = 0; c < d; ++c) {
        for (int b = 0; b < d; ++b)
          rows(c, (1 + b) * a + i) += size * ((b == c) - P(c, b));
        if (bounds)
          rhs(c, B.cols() - 1) = size * (*bounds)[in[i]] * e[c];
        else
          rows(c, i) -= size * p.mu[in[i]] * e[c];
        A.row((1 + c) * a + i) = rows.row(c);
        B.row((1 + c) * a + i) = rhs.row(c);
      }
    }
    MatrixXd Z = B;
    if (m > 0) {
      const Eigen::PartialPivLU<MatrixXd> lu(A);
      Z = lu.solve(B);
      Z += lu.solve(B - A * Z);  // the residual is reported, so it should be that of the arithmetic
      if (!Z.allFinite())
        return false;
    }
    MatrixXd G(m, k);
    for (int i = 0; i < m; ++i)
      G.row(i) = modes.rhs.row(component[i]).head(k);
    out.gram            = MatrixXd::Zero(2 * k + 1, 2 * k + 1);
    out.gram.topRows(k) = G.transpose() * Z.leftCols(2 * k + 1);
    MatrixXd driven     = out.gram;
    driven.col(2 * k).head(k) -= G.transpose() * Z.col(2 * k + 1);
    out.modes            = solve_modes(driven, modes, loading);
    const VectorXd c     = closing(out.modes, modes);
    const VectorXd force = Z.leftCols(2 * k + 1) * c + Z.col(2 * k + 1);
    out.nodal            = VectorXd::Zero(N);
    for (int i = 0; i < m; ++i)
      out.nodal[component[i]] = force[i];
    out.opening = p.C * out.nodal - modes.rhs * c;
    out.length  = std::max((p.G * out.modes.motion.cwiseQuotient(modes.scale)).cwiseAbs().maxCoeff(),
                           (p.C * out.nodal).cwiseAbs().maxCoeff());
    return out.nodal.allFinite() && out.opening.allFinite() && (out.modes.determined || out.modes.missing < 1e-9);
  }

  // Status that the conditions ask for; equal to `s` when all hold.
  Sets asked_for(const Sets &s, const Iterate &it, const VectorXd *bounds) const
  {
    Sets out          = s;
    const double tiny = 1e-14 * it.length;
    for (int i = 0; i < n; ++i) {
      const double normal = it.nodal[i];
      if (s.status[i] == Status::open) {
        if (it.opening[i] < -tiny) {
          // Sticks if the slip it brings along is within what its penetration lets expect of the friction.
          const VectorXd slip = -tangential(it.opening, i);
          const double expect = bounds ? (*bounds)[i] * size : -p.mu[i] * it.opening[i];
          out.status[i]       = p.mu[i] > 0 && slip.norm() <= expect ? Status::stick : Status::slip;
          if (out.status[i] == Status::slip && p.mu[i] > 0) {
            out.direction.row(i) = slip.transpose() / slip.norm();
            out.bend[i]          = std::min(1., expect / slip.norm());
          }
        }
        continue;
      }
      if (normal < 0) {
        out.status[i] = Status::open;
        out.direction.row(i).setZero();
        out.bend[i] = 0;
        continue;
      }
      if (p.mu[i] == 0) {
        out.status[i] = Status::slip;
        continue;
      }
      const double bound = bounds ? (*bounds)[i] : p.mu[i] * normal;
      const VectorXd t = tangential(it.nodal, i), slip = -tangential(it.opening, i);
      if (s.status[i] == Status::stick && t.norm() <= bound * (1 + 1e-13))
        continue;
      const VectorXd trial = t + slip / size;
      const double length  = trial.norm();
      const bool backwards = s.direction.row(i).dot(slip) < -tiny;
      if (s.status[i] == Status::slip && (d == 1 ? !backwards : length >= bound * (1 - 1e-13))) {
        // goes on slipping; in space along a direction that follows the slip
      } else if (s.status[i] == Status::slip && length <= bound) {
        out.status[i] = Status::stick;
        out.direction.row(i).setZero();
        out.bend[i] = 0;
        continue;
      } else if (s.status[i] == Status::slip)
        out.direction.row(i) *= -1;  // in the plane: slips the other way
      if (s.status[i] == Status::stick) {
        out.status[i]        = Status::slip;
        out.direction.row(i) = t.transpose() / t.norm();
      }
      if (d == 2 && length > 0) {
        out.direction.row(i) = trial.transpose() / length;
        out.bend[i]          = std::min(1., bound / length);
      }
    }
    return out;
  }

  double residual(const Sets &s, const Iterate &it) const
  {
    double worst        = 0;
    const double length = it.length > 0 ? it.length : 1;
    const double force  = std::max(it.nodal.head(n).maxCoeff(), 1e-300);
    for (int i = 0; i < n; ++i) {
      if (s.status[i] == Status::open) {
        worst = std::max(worst, -it.opening[i] / length);
        continue;
      }
      worst            = std::max({worst, std::abs(it.opening[i]) / length, -it.nodal[i] / force});
      const VectorXd t = tangential(it.nodal, i), slip = -tangential(it.opening, i);
      const double bound = p.mu[i] * it.nodal[i];
      if (s.status[i] == Status::stick)
        worst = std::max({worst, slip.norm() / length, (t.norm() - bound) / force});
      else {
        worst = std::max(worst, std::abs(t.norm() - bound) / force);
        if (bound > 0)  // along the slip: what points aside, and what points back
          worst = std::max({worst, (slip - t * t.dot(slip) / t.squaredNorm()).norm() / length,
                            -t.dot(slip) / (t.norm() * length)});
      }
    }
    const VectorXd missing = modes.rhs.leftCols(modes.k).transpose() * it.nodal - it.modes.resultant;
    const VectorXd made_of = (modes.rhs.leftCols(modes.k).cwiseAbs().transpose() * it.nodal.cwiseAbs())
                                 .cwiseMax(it.modes.resultant.cwiseAbs());
    for (int j = 0; j < modes.k; ++j)
      if (made_of[j] > 0)
        worst = std::max(worst, std::abs(missing[j]) / made_of[j]);
    return worst;
  }

  static bool same(const Sets &a, const Sets &b, const int d)
  {
    return a.status == b.status && (d == 2 || a.direction == b.direction);
  }

  double turned(const Sets &a, const Sets &b, const Iterate &it) const
  {
    const VectorXd bound  = p.mu.cwiseProduct(it.nodal.head(n).cwiseMax(0));
    const double largest  = std::max(bound.maxCoeff(), 1e-300);
    const VectorXd change = (b.direction - a.direction).rowwise().norm();
    return bound.cwiseProduct(change).maxCoeff() / largest;
  }

  // Newton's method from a status.  True: all conditions hold.
  bool newton(Sets &s, const Loading &loading, const VectorXd *bounds, Iterate &it, int &iterations) const
  {
    std::set<std::vector<Status>> seen;
    bool one_by_one = false;
    int exchanges   = 0;
    double before   = 0;
    for (int step = 0; step < 40 + (one_by_one ? 4 * n : 0); ++step, ++iterations) {
      if (!solve(s, loading, bounds, it))
        return false;
      Sets next = asked_for(s, it, bounds);
      if (same(s, next, d)) {
        // In the plane the set is all there is.  In space the directions still move: until they do so by rounding,
        // weighed by the force they carry.
        const double turn = d == 1 ? 0. : turned(s, next, it);
        if (turn <= 1e-15 || (turn <= 1e-12 && turn >= before / 2 && step > 1))
          return true;
        before = turn;
        s      = next;
        continue;
      }
      // A status seen before: a cycle.  Then by one node at a time, the first.
      one_by_one = one_by_one || (!seen.insert(s.status).second && ++exchanges > 2);
      if (!one_by_one) {
        s = next;
        continue;
      }
      for (int i = 0; i < n; ++i)
        if (next.status[i] != s.status[i] || (d == 1 && next.direction.row(i) != s.direction.row(i))) {
          s.status[i]        = next.status[i];
          s.direction.row(i) = next.direction.row(i);
          s.bend[i]          = next.bend[i];
          break;
        }
    }
    return false;
  }

  // Bounds frozen, then updated from the normal forces.
  bool with_frozen_bounds(Sets &s, const Loading &loading, Iterate &it, int &iterations) const
  {
    VectorXd bounds = p.mu.cwiseProduct(last.nodal.head(n));
    for (int round = 0; round < 60; ++round) {
      if (!newton(s, loading, &bounds, it, iterations))
        return false;
      const VectorXd now = p.mu.cwiseProduct(it.nodal.head(n).cwiseMax(0));
      const double move  = (now - bounds).cwiseAbs().maxCoeff();
      bounds             = now;
      if (move <= 1e-6 * now.maxCoeff()) {
        Sets close = s;
        if (newton(close, loading, nullptr, it, iterations)) {
          s = close;
          return true;
        }
      }
    }
    return false;
  }

  // Without friction, from the normal block: who touches.  All nodes when the tangential motion decides that.
  Sets first_guess(const Loading &loading) const
  {
    Sets out{std::vector<Status>(n, Status::open), MatrixXd::Zero(n, d), VectorXd::Zero(n)};
    std::vector<char> touch(n, 1);
    std::vector<int> normal;
    for (int j = 0; j < modes.k; ++j)
      if (modes.rhs.col(j).head(n).cwiseAbs().maxCoeff() > 0)
        normal.push_back(j);
    if (!normal.empty()) {
      Problem q;
      q.C = p.C.topLeftCorner(n, n);
      q.G = modes.rhs.topRows(n)(Eigen::all, normal);
      if (p.W.size() > 0) {
        q.W.resize(n, Eigen::Index(normal.size()));
        for (std::size_t j = 0; j < normal.size(); ++j)
          q.W.col(Eigen::Index(j)) = modes.rhs.col(modes.k + normal[j]).head(n);
      }
      q.initial_gap = p.initial_gap;
      Loading part;
      part.value.resize(Eigen::Index(normal.size()));
      for (std::size_t j = 0; j < normal.size(); ++j) {
        part.value[Eigen::Index(j)] = loading.value[normal[j]];
        part.prescribed.push_back(loading.prescribed[normal[j]]);
      }
      try {
        touch = ActiveSet(std::move(q)).solve(part).active;
      } catch (const SolverError &) {  // tangential forces are needed for balance: let all touch at first
      }
    }
    for (int i = 0; i < n; ++i)
      if (touch[i])
        out.status[i] = p.mu[i] > 0 ? Status::stick : Status::slip;
    return out;
  }

  const FrictionState &advance(const Loading &loading)
  {
    modes.rhs.col(2 * modes.k) << p.initial_gap, last.slip;
    Sets s = sets;
    for (int i = 0; i < n; ++i)  // the direction of the last step need not be that of this one
      if (s.status[i] == Status::slip && p.mu[i] > 0)
        s.status[i] = Status::stick;
    s.direction.setZero();
    s.bend.setZero();
    const bool nothing_touches =
        std::all_of(s.status.begin(), s.status.end(), [](const Status x) { return x == Status::open; });
    if (nothing_touches)
      s = first_guess(loading);
    Iterate it;
    int iterations   = 1;
    Sets solved_sets = s;
    bool done        = newton(solved_sets, loading, nullptr, it, iterations);
    if (!done) {
      const bool slides = std::none_of(solved_sets.status.begin(), solved_sets.status.end(),
                                       [](const Status x) { return x == Status::stick; });
      solved_sets       = s;
      done              = with_frozen_bounds(solved_sets, loading, it, iterations);
      if (!done)
        fail(slides || std::none_of(solved_sets.status.begin(), solved_sets.status.end(),
                                    [](const Status x) { return x == Status::stick; }));
    }
    FrictionState out;
    out.residual      = residual(solved_sets, it);
    out.iterations    = iterations;
    out.motion        = it.modes.motion.cwiseQuotient(modes.scale);
    out.resultant     = it.modes.resultant.cwiseProduct(modes.scale);
    out.nodal         = it.nodal;
    out.nodal.head(n) = it.nodal.head(n).cwiseMax(0);
    out.gap           = it.opening.head(n).cwiseMax(0);
    out.increment     = -it.opening.tail(n * d);
    for (int i = 0; i < n; ++i) {
      if (solved_sets.status[i] != Status::open)
        out.gap[i] = 0;
      if (solved_sets.status[i] == Status::stick)
        for (int c = 0; c < d; ++c)
          out.increment[c * n + i] = 0;
    }
    out.slip       = last.slip + out.increment;
    out.stiffness  = contact::tangents(it.gram, modes).stiffness;
    out.status     = solved_sets.status;
    out.dissipated = out.nodal.tail(n * d).dot(out.increment);
    sets           = solved_sets;
    last           = out;
    return last;
  }

  [[noreturn]] static void fail(const bool slides)
  {
    if (slides)
      throw SolverError({"friction: the bodies slide", "no node sticks and the resultants are not balanced",
                         "tangential resultants beyond the coefficient of friction times the normal force",
                         "impose the tangential motion instead, or a larger coefficient", ""});
    throw SolverError({"friction: no status found", "neither Newton's method nor frozen bounds end",
                       "a large coefficient of friction with strong coupling, or a long step",
                       "reach the loading in smaller steps", ""});
  }
};

FrictionSolver::FrictionSolver(FrictionProblem problem)
{
  require(problem);
  self = std::make_unique<Implementation>(std::move(problem));
}
FrictionSolver::~FrictionSolver()                          = default;
FrictionSolver::FrictionSolver(FrictionSolver &&) noexcept = default;

const FrictionState &FrictionSolver::advance(const Loading &loading)
{
  const auto k = self->modes.k;
  if (loading.value.size() != k || !(loading.prescribed.empty() || int(loading.prescribed.size()) == k) ||
      !loading.value.allFinite())
    throw InputError("friction: a loading needs " + std::to_string(k) + " finite values");
  return self->advance(scaled(loading, self->modes));
}

void FrictionSolver::reset()
{
  self->reset();
}
const FrictionState &FrictionSolver::state() const
{
  return self->last;
}
}  // namespace mill::contact
