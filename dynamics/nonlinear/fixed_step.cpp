#include "fixed_step.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace mill::dynamics {
namespace {
using Matrix4 = std::array<double, 16>;

Matrix4 product(const Matrix4 &a, const Matrix4 &b)
{
  Matrix4 c{};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k)
      for (int j = 0; j < 4; ++j)
        c[std::size_t(4 * i + j)] += a[std::size_t(4 * i + k)] * b[std::size_t(4 * k + j)];
  return c;
}

// e^A by halving until the series converges at once, and squaring.
Matrix4 exponential(Matrix4 a)
{
  double size = 0;
  for (const double x : a)
    size = std::max(size, std::abs(x));
  int halvings = 0;
  for (; size > 0.125; size /= 2)
    ++halvings;
  for (double &x : a)
    x = std::ldexp(x, -halvings);
  Matrix4 sum{}, term{};
  for (std::size_t i = 0; i < 4; ++i)
    sum[5 * i] = term[5 * i] = 1;
  for (int k = 1; k <= 18; ++k) {
    term = product(term, a);
    for (std::size_t i = 0; i < 16; ++i) {
      term[i] /= k;
      sum[i] += term[i];
    }
  }
  for (; halvings > 0; --halvings)
    sum = product(sum, sum);
  return sum;
}

// x of A x = b by elimination with row pivoting, b overwritten; false: singular.
bool solve(std::vector<double> &A, std::vector<double> &b)
{
  const std::size_t n = b.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < n; ++r)
      if (std::abs(A[r * n + c]) > std::abs(A[pivot * n + c]))
        pivot = r;
    if (!(std::abs(A[pivot * n + c]) > 0))
      return false;
    if (pivot != c) {
      std::swap_ranges(&A[c * n], &A[c * n] + n, &A[pivot * n]);
      std::swap(b[c], b[pivot]);
    }
    for (std::size_t r = c + 1; r < n; ++r) {
      const double factor = A[r * n + c] / A[c * n + c];
      for (std::size_t k = c; k < n; ++k)
        A[r * n + k] -= factor * A[c * n + k];
      b[r] -= factor * b[c];
    }
  }
  for (std::size_t c = n; c-- > 0;) {
    for (std::size_t k = c + 1; k < n; ++k)
      b[c] -= A[c * n + k] * b[k];
    b[c] /= A[c * n + c];
  }
  return true;
}

constexpr double rests_solved = 1e-13;  // of the largest compression: below what any force feels
}  // namespace

FixedStep::FixedStep(const CurveStand &stand, const double h)
    : stand_(stand), n_unknowns_(stand.springs.size() + (stand.gap_damper > 0)), free_q_(stand.modes()),
      free_v_(stand.modes())
{
  const std::size_t n = stand.modes(), s = stand.springs.size(), u = n_unknowns_;
  for (std::size_t k = 0; k < n; ++k) {
    // In w q and q', so that rounding does not see the units; force and its rise as states.  (36.6)
    const double w = stand.rate[k], scale = w > 0 ? w : 1 / h;
    Matrix4 a{};
    a[1]            = scale * h;
    a[4]            = -w * w / scale * h;
    a[5]            = -2 * stand.damping * w * h;
    a[6]            = h;
    a[11]           = 1;
    const Matrix4 e = exponential(a);
    modes_.push_back(
        {e[0], e[1] / scale, (e[2] - e[3]) / scale, e[3] / scale, e[4] * scale, e[5], e[6] - e[7], e[7]});
  }
  response_.assign(u * u, 0);
  for (std::size_t i = 0; i < u; ++i)
    for (std::size_t j = 0; j < u; ++j)
      for (std::size_t k = 0; k < n; ++k) {
        const double acts = j < s ? stand.springs[j].row[k] : stand.push[k];
        response_[i * u + j] +=
            i < s ? stand.springs[i].row[k] * modes_[k].q1 * acts : stand.push[k] * modes_[k].v1 * acts;
      }
  explicit_.resize(u);
  end_.resize(u);
}

double FixedStep::force_at(const std::size_t j, const double end) const
{
  return j < stand_.springs.size() ? beyond_tangent(stand_, stand_.springs[j], end).force
                                   : stand_.gap_damper * end;
}

// end = explicit - response * force(end): by substitution while that gains a digit each time, else by Newton.
bool FixedStep::solve_end(std::vector<double> &end, const std::vector<double> &explicit_part) const
{
  const std::size_t u = n_unknowns_;
  std::vector<double> next(u), force(u);
  double before = 0;
  for (int round = 0; round < 16; ++round) {
    for (std::size_t j = 0; j < u; ++j)
      force[j] = force_at(j, end[j]);
    double change = 0, size = 0;
    for (std::size_t i = 0; i < u; ++i) {
      next[i] = explicit_part[i];
      for (std::size_t j = 0; j < u; ++j)
        next[i] -= response_[i * u + j] * force[j];
      // A velocity of the gap and a compression are each compared with their own size.
      const double reach = std::max(std::abs(next[i]), i < stand_.springs.size() ? stand_.springs[i].rest : 1e-9);
      change             = std::max(change, std::abs(next[i] - end[i]) / reach);
      size               = 1;
    }
    end.swap(next);
    if (change <= rests_solved * size)
      return true;
    if (round > 0 && change > 0.1 * before)
      break;
    before = change;
  }
  return newton(end, explicit_part);
}

bool FixedStep::newton(std::vector<double> &end, const std::vector<double> &explicit_part) const
{
  const std::size_t u = n_unknowns_, s = stand_.springs.size();
  std::vector<double> A(u * u), miss(u), force(u), slope(u), start;
  const auto missing = [&](const std::vector<double> &positions) {
    double largest = 0;
    for (std::size_t j = 0; j < u; ++j) {
      const SpringForce f = j < s ? beyond_tangent(stand_, stand_.springs[j], positions[j])
                                  : SpringForce{force_at(j, positions[j]), stand_.gap_damper};
      force[j]            = f.force;
      slope[j]            = f.stiffness;
    }
    for (std::size_t i = 0; i < u; ++i) {
      miss[i] = positions[i] - explicit_part[i];
      for (std::size_t j = 0; j < u; ++j)
        miss[i] += response_[i * u + j] * force[j];
      largest = std::max(largest, std::abs(miss[i]) /
                                      std::max(std::abs(positions[i]), i < s ? stand_.springs[i].rest : 1e-9));
    }
    return largest;
  };
  double now = missing(end);
  for (int round = 0; round < 60; ++round) {
    if (now <= rests_solved)
      return true;
    for (std::size_t i = 0; i < u; ++i)
      for (std::size_t j = 0; j < u; ++j)
        A[i * u + j] = (i == j) + response_[i * u + j] * slope[j];
    std::vector<double> step = miss;
    if (!solve(A, step))
      return false;
    start               = end;
    double part         = 1;
    const double before = now;
    for (int halving = 0; halving < 30; ++halving, part /= 2) {
      for (std::size_t i = 0; i < u; ++i)
        end[i] = start[i] - part * step[i];
      if ((now = missing(end)) < before)
        break;
    }
    if (!(now < before))
      return before <= 1e3 * rests_solved;  // rounding: as far as it goes
  }
  return now <= 1e3 * rests_solved;
}

bool FixedStep::advance(CurveState &state, const double F0, const double F1) const
{
  const std::size_t n = stand_.modes(), s = stand_.springs.size(), u = n_unknowns_;
  std::fill(explicit_.begin(), explicit_.end(), 0);
  for (std::size_t k = 0; k < n; ++k) {
    double held = 0;  // force of springs and damper at the beginning
    for (std::size_t j = 0; j < s; ++j)
      held += stand_.springs[j].row[k] * state.rho[j];
    held += stand_.push[k] * stand_.gap_damper * state.gap_velocity;
    const Mode &m  = modes_[k];
    const double f = stand_.push[k] * F0 - held, g = stand_.push[k] * F1;
    free_q_[k] = m.qq * state.q[k] + m.qv * state.v[k] + m.q0 * f + m.q1 * g;
    free_v_[k] = m.vq * state.q[k] + m.vv * state.v[k] + m.v0 * f + m.v1 * g;
    for (std::size_t j = 0; j < s; ++j)
      explicit_[j] += stand_.springs[j].row[k] * free_q_[k];
    if (u > s)
      explicit_[s] += stand_.push[k] * free_v_[k];
  }
  for (std::size_t i = 0; i < u; ++i)
    end_[i] = i < s ? state.d[i] : state.gap_velocity;
  if (!solve_end(end_, explicit_))
    return false;
  for (std::size_t j = 0; j < s; ++j) {
    state.d[j]   = end_[j];
    state.rho[j] = force_at(j, end_[j]);
  }
  if (u > s)
    state.gap_velocity = end_[s];
  for (std::size_t k = 0; k < n; ++k) {
    double held = stand_.push[k] * stand_.gap_damper * state.gap_velocity;
    for (std::size_t j = 0; j < s; ++j)
      held += stand_.springs[j].row[k] * state.rho[j];
    state.q[k] = free_q_[k] - modes_[k].q1 * held;
    state.v[k] = free_v_[k] - modes_[k].v1 * held;
  }
  return true;
}

bool rest_under(const CurveStand &stand, const double force, CurveState &state)
{
  const std::size_t n = stand.modes(), s = stand.springs.size();
  state = {std::vector<double>(n), std::vector<double>(n), std::vector<double>(s), std::vector<double>(s), 0};
  // Compressions d = free - C rho(d), C of the modes; a mode without stiffness moves no spring.
  std::vector<double> C(s * s), free(s), A(s * s), miss(s);
  const auto soft = [&](const std::size_t k) {
    return stand.rate[k] > 0 ? 1 / (stand.rate[k] * stand.rate[k]) : 0;
  };
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      free[i] += stand.springs[i].row[k] * soft(k) * stand.push[k] * force;
      for (std::size_t j = 0; j < s; ++j)
        C[i * s + j] += stand.springs[i].row[k] * soft(k) * stand.springs[j].row[k];
    }
  std::vector<double> slope(s), start, step(s);
  const auto missing = [&] {
    double largest = 0;
    for (std::size_t j = 0; j < s; ++j) {
      const SpringForce f = beyond_tangent(stand, stand.springs[j], state.d[j]);
      state.rho[j]        = f.force;
      slope[j]            = f.stiffness;
    }
    for (std::size_t i = 0; i < s; ++i) {
      miss[i] = state.d[i] - free[i];
      for (std::size_t j = 0; j < s; ++j)
        miss[i] += C[i * s + j] * state.rho[j];
      largest = std::max(largest, std::abs(miss[i]) / std::max(std::abs(state.d[i]), stand.springs[i].rest));
    }
    return largest;
  };
  state.d    = free;
  double now = missing();
  for (int round = 0; round < 100 && now > rests_solved; ++round) {
    for (std::size_t i = 0; i < s; ++i)
      for (std::size_t j = 0; j < s; ++j)
        A[i * s + j] = (i == j) + C[i * s + j] * slope[j];
    step = miss;
    if (!solve(A, step))
      return false;
    start               = state.d;
    const double before = now;
    double part         = 1;
    for (int halving = 0; halving < 30; ++halving, part /= 2) {
      for (std::size_t i = 0; i < s; ++i)
        state.d[i] = start[i] - part * step[i];
      if ((now = missing()) < before)
        break;
    }
    if (!(now < before))
      break;
  }
  for (std::size_t k = 0; k < n; ++k) {
    double f = stand.push[k] * force;
    for (std::size_t j = 0; j < s; ++j)
      f -= stand.springs[j].row[k] * state.rho[j];
    state.q[k] = soft(k) * f;
  }
  return now <= 1e3 * rests_solved;
}
}  // namespace mill::dynamics
