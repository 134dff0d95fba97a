#include "dynamics/cluster/time_steps.h"
#include "core/base/errors.h"
#include "core/numerics/eigen_instances.h"
#include "core/numerics/root_search.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::cluster {
namespace {
constexpr double touch = 1e-15;  // m: an approach nearer to zero is neither open nor closed

// N s/m, of the contacts.
Eigen::MatrixXd damping_at_rest(const Stack &stack, const Motion &rest)
{
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(stack.size(), stack.size());
  for (const Contact &c : stack.contacts) {
    const ContactState s    = contact_state(stack, c, rest);
    const double share      = s.approach <= 0 ? 0 : c.depth > 0 ? step(s.approach, 0, 0, c.depth, 1) : 1;
    Eigen::VectorXd row     = Eigen::VectorXd::Zero(stack.size());
    row.segment<2>(2 * c.a) = -s.normal;
    row.segment<2>(2 * c.b) = s.normal;
    C += share * c.damping * row * row.transpose();
  }
  return C;
}
}  // namespace

TimeSteps::TimeSteps(const MotionEquations &equations, const Stack &stack, const Motion &rest,
                     const Eigen::VectorXd &state, const double tolerance, const double length)
    : equations_(equations), state_(state), tolerance_(tolerance), length_(length)
{
  const Eigen::VectorXd m = masses(stack), w = m.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = w.asDiagonal() * total_tangent(stack, rest) * w.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  V_                   = w.asDiagonal() * eigen.eigenvectors();
  VtM_                 = V_.transpose() * m.asDiagonal();
  roots_               = eigen.eigenvalues().cwiseMax(0);
  const Eigen::Index n = m.size();
  dampings_            = (V_.transpose() * damping_at_rest(stack, rest) * V_).diagonal();
  q_                   = VtM_ * state_.head(n);
  p_                   = VtM_ * state_.segment(n, n);
  longest_             = 1.2 / std::sqrt(roots_[n - 1]);
  step_                = longest_;
  Eigen::VectorXd d(equations_.contacts());
  equations_.approaches(0, state_.data(), d.data());
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    closed_.push_back(d[i] > 0);
    watched_.push_back(equations_.one_sided(int(i)));
  }
}

const std::vector<Collocation::Square> &TimeSteps::inverses(const double h)
{
  if (const auto match = kept_.find(h); match != kept_.end())
    return match->second;
  if (kept_.size() > 64)
    kept_.clear();
  auto &list = kept_[h];
  for (Eigen::Index k = 0; k < roots_.size(); ++k)
    list.push_back(
        (Collocation::Square::Identity() + h * dampings_[k] * rule_.A + h * h * roots_[k] * rule_.AA).inverse());
  return list;
}

// The motion of every mode, uncoupled.
void TimeSteps::start_from_modes(const double h, Stages &acceleration) const
{
  for (Eigen::Index k = 0; k < q_.size(); ++k) {
    const double omega = std::sqrt(roots_[k]);
    for (int i = 0; i < Collocation::stages; ++i) {
      const double angle = omega * rule_.c[i] * h;
      acceleration(k, i) = -roots_[k] * q_[k] * std::cos(angle) - omega * p_[k] * std::sin(angle);
    }
  }
}

Eigen::VectorXd TimeSteps::physical(const Eigen::VectorXd &q, const Eigen::VectorXd &p) const
{
  const Eigen::Index n      = q.size();
  Eigen::VectorXd y         = Eigen::VectorXd::Zero(2 * n + 3);
  y.head(n).noalias()       = V_ * q;
  y.segment(n, n).noalias() = V_ * p;
  return y;
}

TimeSteps::Result TimeSteps::solve(const double h)
{
  const Eigen::Index n = q_.size();
  const auto &inverse  = inverses(h);
  Result r;
  r.acceleration.resize(n, Eigen::NoChange);
  start_from_modes(h, r.acceleration);
  Eigen::VectorXd slope(2 * n + 3);
  Stages result(n, int(Collocation::stages));
  const double wanted = std::max(1e-14, 1e-3 * tolerance_) * length_ / (h * h);
  double before       = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 40 && !r.converged; ++iteration) {
    r.velocity = p_.replicate(1, int(Collocation::stages)) + h * r.acceleration * rule_.A.transpose();
    r.position = q_.replicate(1, int(Collocation::stages)) + h * p_ * rule_.c.transpose() +
                 h * h * r.acceleration * rule_.AA.transpose();
    for (int i = 0; i < Collocation::stages; ++i) {
      const Eigen::VectorXd y = physical(r.position.col(i), r.velocity.col(i));
      equations_.slope(time_ + rule_.c[i] * h, y.data(), slope.data());
      result.col(i).noalias() = VtM_ * slope.segment(n, n);
      r.sums.col(i)           = slope.tail(3);
      ++evaluations;
    }
    double largest = 0;
    for (Eigen::Index k = 0; k < n; ++k) {
      const Collocation::Row change =
          (inverse[std::size_t(k)] * (result.row(k) - r.acceleration.row(k)).transpose()).transpose();
      r.acceleration.row(k) += change;
      largest = std::max(largest, change.cwiseAbs().maxCoeff() * V_.col(k).cwiseAbs().maxCoeff());
    }
    if (!std::isfinite(largest))
      return r;
    // To rounding: as small as wanted, or no longer falling near it.
    r.converged = largest < wanted || (iteration > 3 && largest < 1e3 * wanted && largest > 0.5 * before);
    before      = largest;
  }
  for (Eigen::Index k = 0; k < n; ++k)
    r.error = std::max(r.error, h * h * std::abs(rule_.last.dot(r.acceleration.row(k))) *
                                    V_.col(k).cwiseAbs().maxCoeff() / length_);
  return r;
}

// Contacts whose state differs from the assumed one.
std::vector<int> TimeSteps::changed(const double time, const Eigen::VectorXd &state) const
{
  Eigen::VectorXd d(equations_.contacts());
  equations_.approaches(time, state.data(), d.data());
  std::vector<int> which;
  for (Eigen::Index i = 0; i < d.size(); ++i)
    if (watched_[std::size_t(i)] && (closed_[std::size_t(i)] ? d[i] < -touch : d[i] > touch))
      which.push_back(int(i));
  return which;
}

// Share of the step at which the first contact changes; 1: none does.
double TimeSteps::first_crossing(const Result &r, const double h, int &contact) const
{
  const auto changed_at = [&](const double x) {
    const Collocation::Row w = rule_.up_to(x);
    return changed(time_ + x * h, physical(q_ + x * h * p_ + h * h * (r.acceleration * (w * rule_.A).transpose()),
                                           p_ + h * (r.acceleration * w.transpose())));
  };
  double first = 1;
  contact      = -1;
  for (int i = 0; i <= Collocation::stages; ++i) {
    const double x   = i < Collocation::stages ? rule_.c[i] : 1;
    const auto which = changed_at(x);
    if (which.empty())
      continue;
    for (const int c : which) {
      const auto same = [&](const double share) {
        const auto now = changed_at(share);
        return std::find(now.begin(), now.end(), c) == now.end();
      };
      const double change = border_between(i > 0 ? rule_.c[i - 1] : 0, x, same).fails;
      if (change < first || contact < 0) {
        first   = change;
        contact = c;
      }
    }
    break;
  }
  return first;
}

void TimeSteps::accept(const Result &r, const double h)
{
  const Eigen::Index n = q_.size();
  q_ += h * p_ + h * h * (r.acceleration * rule_.bA.transpose());
  p_ += h * (r.acceleration * rule_.b.transpose());
  Eigen::Vector3d sums = state_.tail<3>();
  for (int i = 0; i < Collocation::stages; ++i)
    sums += h * rule_.b[i] * r.sums.col(i);
  state_           = physical(q_, p_);
  state_.tail<3>() = sums;
  time_ += h;
  length_ = std::max(length_, state_.head(n).cwiseAbs().maxCoeff());
  ++steps;
}

std::vector<TimeSteps::Crossing> TimeSteps::advance(const double end)
{
  while (end - time_ > 1e-15 * std::max(1., end)) {
    const double left = end - time_;
    // Equal steps up to the end; rounded so that the same length is met again.
    double h = left / std::ceil(left / step_ - 1e-9);
    Result r = solve(h);
    if (!r.converged || r.error > std::sqrt(tolerance_)) {
      step_ = 0.5 * h;
      if (step_ > 1e-5 * longest_)
        continue;
      if (!r.converged)
        throw SolverError({fmt::format("stack in time: no step is short enough at {:.6g} ms", 1e3 * time_),
                           fmt::format("the last one had {:.3g} ns", 1e9 * h),
                           "the motion grows without bound, or contacts rattle",
                           "a smaller dynamic force, more damping, a shorter run", ""});
    }
    int contact  = -1;
    double share = first_crossing(r, h, contact);
    if (contact < 0) {
      accept(r, h);
      if (r.error < 1e-2 * std::sqrt(tolerance_))
        step_ = std::min(2 * step_, longest_);
      continue;
    }
    // The step that ends where the contact changes; its own solution moves the place a little.
    for (int k = 0; k < 4; ++k) {
      const Result shorter = solve(share * h);
      if (!shorter.converged)
        break;  // r stays the solution of the step h
      h *= share;
      r     = shorter;
      int c = -1;
      share = first_crossing(r, h, c);
      if (c < 0 || share > 1 - 1e-12)
        break;
    }
    accept(r, h);
    closed_[std::size_t(contact)] = !closed_[std::size_t(contact)];
    return {{contact, !closed_[std::size_t(contact)]}};
  }
  time_ = end;
  return {};
}
}  // namespace mill::cluster
