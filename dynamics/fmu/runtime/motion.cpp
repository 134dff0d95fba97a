#include "motion.h"
#include <algorithm>
#include <cmath>

namespace mill::fmu {
namespace {
// Lengths that differ so little, in units of the fastest rate, share what is prepared: four terms of a Taylor
// series carry the rest, and the fifth is 1e-25.  (35.6)
constexpr double length_grid = 1e-5;
// Different lengths a run may go through in turn before one is prepared again.
constexpr std::size_t most_prepared = 8;
// Passing between modes and poles loses the condition of the shapes; beyond this the matrix exponential is used.
constexpr double largest_condition = 1e3;
constexpr double real_pole         = 1e-8;  // of the fastest rate
}  // namespace

Motion::Motion(const ModalSystem &system)
    : n_(system.rad.size()), rad_(system.rad), bite_(system.bite), damping_(system.damping),
      dampers_(system.dampers)
{
  if (system.gap_damper > 0) {
    dampers_.push_back(bite_);
    for (double &entry : dampers_.back())
      entry *= std::sqrt(system.gap_damper);
  }
  fastest_ = (rad_.empty() ? 0 : rad_.back()) * (1 + 2 * damping_);
  for (const auto &row : dampers_) {
    double coupling = 0;
    for (const double entry : row)
      coupling += std::abs(entry);
    fastest_ += coupling * coupling;
  }
  form_ = Form::separate_modes;
  if (dampers_.empty())
    return;
  A_ = Matrix(2 * n_, 2 * n_);
  for (std::size_t i = 0; i < n_; ++i) {
    A_(i, n_ + i) = rad_[i];
    A_(n_ + i, i) = -rad_[i];
    for (std::size_t j = 0; j < n_; ++j) {
      A_(n_ + i, n_ + j) = i == j ? -2 * damping_ * rad_[i] : 0;
      for (const auto &row : dampers_)
        A_(n_ + i, n_ + j) -= row[i] * row[j];
    }
  }
  x_.resize(2 * n_);
  y_.resize(2 * n_);
  w_.resize(2 * n_);
  form_                  = Form::exponential;
  const GeneralEigen all = general_eigen(A_);
  if (!(all.condition <= largest_condition))
    return;
  form_ = Form::poles;
  // One number per pair of poles and one per real pole.  Rounding leaves a real pole an imaginary part of either
  // sign; a pair that is so close to the axis may be kept as two.
  const auto is_real = [&](const std::size_t k) { return std::abs(all.value[k].imag()) <= real_pole * fastest_; };
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < 2 * n_; ++k)
    if (is_real(k) || all.value[k].imag() > 0)
      kept.push_back(k);
  to_poles_      = ComplexMatrix(kept.size(), 2 * n_);
  from_poles_    = ComplexMatrix(2 * n_, kept.size());
  double members = 0;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const std::size_t from = kept[k];
    const double weight    = is_real(from) ? 1 : 2;
    members += weight;
    pole_.push_back(all.value[from]);
    Complex gain = 0;
    for (std::size_t i = 0; i < 2 * n_; ++i) {
      to_poles_(k, i)   = all.inverse(from, i);
      from_poles_(i, k) = weight * all.vector(i, from);
      gain += i < n_ ? Complex(0) : all.inverse(from, i) * bite_[i - n_];
    }
    gain_.push_back(gain);
  }
  z_.resize(kept.size());
  if (members != double(2 * n_))  // pairs and real poles could not be distinguished
    form_ = Form::exponential;
}

// (35.3) by the power series of the solution for short steps, where the closed form would lose digits, and by the
// closed form for long ones.
void Motion::prepare_modes(Prepared &step, const double h) const
{
  for (auto *row : {&step.qq, &step.qp, &step.qf, &step.qs, &step.pq, &step.pp, &step.pf, &step.ps})
    row->resize(n_);
  for (std::size_t i = 0; i < n_; ++i) {
    const double w = rad_[i], g = bite_[i], zeta = damping_;
    if (w * h < 0.5) {
      const int terms = w * h < 0.05 ? 12 : 22;  // the first left out is below 0.05^14/14! and 0.5^24/24!
      // d_k = coefficient of (t/h)^k times h^k of q, for a unit of q, p, force and slope in turn
      const auto series = [&](const double q0, const double p0, const double f0, const double f1, double &q,
                              double &p) {
        double before = q0, now = p0 * h;
        q = before + now;
        p = now;
        for (int k = 0; k < terms; ++k) {
          const double force = k == 0 ? f0 : k == 1 ? f1 * h : 0;
          const double next  = (g * h * h * force - 2 * zeta * w * h * (k + 1) * now - w * h * w * h * before) /
                              ((k + 1.0) * (k + 2.0));
          q += next;
          p += (k + 2) * next;
          before = now;
          now    = next;
        }
        p /= h;
      };
      series(1, 0, 0, 0, step.qq[i], step.pq[i]);
      series(0, 1, 0, 0, step.qp[i], step.pp[i]);
      series(0, 0, 1, 0, step.qf[i], step.pf[i]);
      series(0, 0, 0, 1, step.qs[i], step.ps[i]);
      continue;
    }
    const double decay = std::exp(-zeta * w * h), damped = w * std::sqrt(1 - zeta * zeta);
    const double c = decay * std::cos(damped * h), s = decay * std::sin(damped * h) / damped;
    step.qq[i] = c + zeta * w * s;
    step.qp[i] = s;
    step.pq[i] = -w * w * s;
    step.pp[i] = c - zeta * w * s;
    // in addition to the particular solution g (f0 + f1 t) / w^2 - 2 zeta g f1 / w^3
    const double still = g / (w * w), lag = 2 * zeta / w;
    step.qf[i] = still * (1 - step.qq[i]);
    step.pf[i] = -still * step.pq[i];
    step.qs[i] = still * (h - lag + lag * step.qq[i] - step.qp[i]);
    step.ps[i] = still * (1 + lag * step.pq[i] - step.pp[i]);
  }
}

// (35.4): e = exp(s), p1 = (e - 1)/s, p2 = (p1 - 1)/s with s = lambda h; the series where the quotients would
// cancel.
void Motion::prepare_poles(Prepared &step, const double h) const
{
  for (std::size_t k = 0; k < pole_.size(); ++k) {
    const Complex s = pole_[k] * h;
    Complex e, p1, p2;
    if (std::abs(s) >= 0.5) {
      e  = std::exp(s);
      p1 = (e - 1.0) / s;
      p2 = (p1 - 1.0) / s;
    } else {
      p2 = 0;
      for (int j = 15; j >= 0; --j)
        p2 = 1.0 + p2 * s / double(j + 3);  // Horner on 2 p2 = 1 + s/3 (1 + s/4 (1 + ...))
      p2 /= 2;
      p1 = 1.0 + s * p2;
      e  = 1.0 + s * p1;
    }
    step.z.push_back(e);
    step.zf.push_back(gain_[k] * h * p1);
    step.zs.push_back(gain_[k] * h * h * p2);
  }
}

void Motion::prepare_exponential(Prepared &step, const double h) const  // (35.5)
{
  const std::size_t s = 2 * n_;
  Matrix G(s + 2, s + 2);
  for (std::size_t i = 0; i < s; ++i) {
    for (std::size_t j = 0; j < s; ++j)
      G(i, j) = h * A_(i, j);
    G(i, s) = i < n_ ? 0 : h * bite_[i - n_];
  }
  G(s, s + 1)    = 1;
  const Matrix E = matrix_exponential(G);
  step.x         = Matrix(s, s);
  for (std::size_t i = 0; i < s; ++i) {
    for (std::size_t j = 0; j < s; ++j)
      step.x(i, j) = E(i, j);
    step.xf.push_back(E(i, s));
    step.xs.push_back(h * E(i, s + 1));
  }
}

void Motion::prepare(Prepared &step, const double length) const
{
  step.length = length;
  step.z.clear(), step.zf.clear(), step.zs.clear(), step.xf.clear(), step.xs.clear();
  if (form_ == Form::separate_modes)
    prepare_modes(step, length);
  else if (form_ == Form::poles)
    prepare_poles(step, length);
  else
    prepare_exponential(step, length);
}

// The prepared length depends on the given length alone, not on those before: a multiple of a small
// time, so that a copy of the state goes on with the same digits in another instance.
const Motion::Prepared &Motion::prepared_for(const double length)
{
  const double multiple = fastest_ > 0 ? std::round(length / length_grid * fastest_) : 0;
  const double wanted   = multiple > 0 ? multiple * (length_grid / fastest_) : length;
  for (const Prepared &step : prepared_)
    if (step.length == wanted)
      return step;
  if (prepared_.size() < most_prepared)
    prepared_.emplace_back();
  Prepared &step = prepared_[next_place_];
  next_place_    = (next_place_ + 1) % most_prepared;
  prepare(step, wanted);
  return step;
}

// rest: what is left of the length, by the Taylor series of q; q'' and q''' follow from the equation of motion.
void Motion::advance_modes(ModalState &state, const Prepared &step, const double rest,
                           const StraightForce &force) const
{
  const double f = force.start, df = force.slope, end = f + df * step.length;
  for (std::size_t i = 0; i < n_; ++i) {
    const double q0 = state.q[i], p0 = state.p[i];
    double q = step.qq[i] * q0 + step.qp[i] * p0 + step.qf[i] * f + step.qs[i] * df;
    double p = step.pq[i] * q0 + step.pp[i] * p0 + step.pf[i] * f + step.ps[i] * df;
    if (rest != 0) {
      const double w2 = rad_[i] * rad_[i], d = 2 * damping_ * rad_[i];
      const double a = bite_[i] * end - d * p - w2 * q;
      const double j = bite_[i] * df - d * a - w2 * p;
      const double s = -d * j - w2 * a;
      const double t = -d * s - w2 * j;
      q += rest * (p + rest / 2 * (a + rest / 3 * (j + rest / 4 * s)));
      p += rest * (a + rest / 2 * (j + rest / 3 * (s + rest / 4 * t)));
    }
    state.q[i] = q;
    state.p[i] = p;
  }
}

void Motion::advance_poles(const Prepared &step, const double rest, const StraightForce &force)
{
  const double end = force.start + force.slope * step.length;
  for (std::size_t k = 0; k < z_.size(); ++k) {
    Complex z = step.z[k] * z_[k] + step.zf[k] * force.start + step.zs[k] * force.slope;
    if (rest != 0) {
      const Complex one = pole_[k] * z + gain_[k] * end, two = pole_[k] * one + gain_[k] * force.slope;
      const Complex three = pole_[k] * two, four = pole_[k] * three;
      z += rest * (one + rest / 2 * (two + rest / 3 * (three + rest / 4 * four)));
    }
    z_[k] = z;
  }
}

void Motion::advance_exponential(const Prepared &step, const double rest, const StraightForce &force)
{
  const std::size_t s = 2 * n_;
  for (std::size_t i = 0; i < s; ++i) {
    double sum = step.xf[i] * force.start + step.xs[i] * force.slope;
    for (std::size_t j = 0; j < s; ++j)
      sum += step.x(i, j) * x_[j];
    y_[i] = sum;
  }
  x_ = y_;
  if (rest == 0)
    return;
  double factor = rest;
  double f      = force.start + force.slope * step.length;
  for (int k = 1; k <= 4; ++k) {  // y: derivative k of x
    for (std::size_t i = 0; i < s; ++i) {
      w_[i] = i < n_ ? 0 : bite_[i - n_] * f;
      for (std::size_t j = 0; j < s; ++j)
        w_[i] += A_(i, j) * y_[j];
    }
    y_ = w_;
    for (std::size_t i = 0; i < s; ++i)
      x_[i] += factor * y_[i];
    f = k == 1 ? force.slope : 0;
    factor *= rest / (k + 1);
  }
}

void Motion::begin(const ModalState &state)
{
  if (form_ == Form::separate_modes)
    return;
  if (form_ == Form::poles && state.z.size() == z_.size()) {
    z_ = state.z;
    return;
  }
  for (std::size_t i = 0; i < n_; ++i) {
    x_[i]      = rad_[i] * state.q[i];
    x_[n_ + i] = state.p[i];
  }
  if (form_ == Form::poles)
    for (std::size_t k = 0; k < z_.size(); ++k) {
      z_[k] = 0;
      for (std::size_t i = 0; i < 2 * n_; ++i)
        z_[k] += to_poles_(k, i) * x_[i];
    }
}

void Motion::end(ModalState &state)
{
  if (form_ == Form::separate_modes)
    return;
  if (form_ == Form::poles)
    for (std::size_t i = 0; i < 2 * n_; ++i) {
      x_[i] = 0;
      for (std::size_t k = 0; k < z_.size(); ++k)
        x_[i] += from_poles_(i, k).real() * z_[k].real() - from_poles_(i, k).imag() * z_[k].imag();
    }
  if (form_ == Form::poles)
    state.z = z_;
  for (std::size_t i = 0; i < n_; ++i) {
    state.q[i] = x_[i] / rad_[i];
    state.p[i] = x_[n_ + i];
  }
}

void Motion::advance(ModalState &state, const double length, const StraightForce &force)
{
  if (!(length > 0))
    return;
  const Prepared &step = prepared_for(length);
  const double rest    = length - step.length;
  if (form_ == Form::separate_modes)
    advance_modes(state, step, rest, force);
  else if (form_ == Form::poles)
    advance_poles(step, rest, force);
  else
    advance_exponential(step, rest, force);
}

void Motion::acceleration(const ModalState &state, const double force, std::vector<double> &result) const
{
  result.resize(n_);
  for (std::size_t i = 0; i < n_; ++i)
    result[i] = bite_[i] * force - 2 * damping_ * rad_[i] * state.p[i] - rad_[i] * rad_[i] * state.q[i];
  for (const auto &row : dampers_) {
    double rate = 0;
    for (std::size_t i = 0; i < n_; ++i)
      rate += row[i] * state.p[i];
    for (std::size_t i = 0; i < n_; ++i)
      result[i] -= row[i] * rate;
  }
}

ModalState Motion::equilibrium(const double force) const
{
  ModalState state{std::vector<double>(n_), std::vector<double>(n_), {}};
  for (std::size_t i = 0; i < n_; ++i)
    state.q[i] = bite_[i] * force / (rad_[i] * rad_[i]);
  return state;
}
}  // namespace mill::fmu
