#include "dynamics/nonlinear/harmonic_balance.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

namespace mill::dynamics {
namespace {
using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double settled  = 1e-12;  // of the rest compressions
constexpr int most_rounds = 40;

// Rows of all springs; (s, n).
MatrixXd rows_of(const CurveStand &stand)
{
  MatrixXd rows(Index(stand.springs.size()), Index(stand.modes()));
  for (Index j = 0; j < rows.rows(); ++j)
    for (Index k = 0; k < rows.cols(); ++k)
      rows(j, k) = stand.springs[std::size_t(j)].row[std::size_t(k)];
  return rows;
}

VectorXd vector_of(const std::vector<double> &v)
{
  return Eigen::Map<const VectorXd>(v.data(), Index(v.size()));
}

// Cosines, and sines behind them, at even moments of a period; and back.  (moments, b), b = h + 1 or 2 h + 1
struct Basis {
  MatrixXd to_moments, back;
  int harmonics;
  bool sines;

  Basis(const int h, const bool with_sines) : harmonics(h), sines(with_sines)
  {
    const Index moments = 8 * (h + 2), b = h + 1 + (with_sines ? h : 0);
    to_moments.resize(moments, b);
    // Cosines alone are even: half of the period says all.
    const double whole = with_sines ? 2 * M_PI : M_PI;
    for (Index i = 0; i < moments; ++i) {
      const double angle = whole * (double(i) + 0.5) / double(moments);
      for (int k = 0; k <= h; ++k) {
        to_moments(i, k) = std::cos(k * angle);
        if (with_sines && k > 0)
          to_moments(i, h + k) = std::sin(k * angle);
      }
    }
    back = to_moments.transpose() * (2.0 / double(moments));
    back.row(0) *= 0.5;
  }
  int harmonic(const Index column) const
  {
    return int(column) <= harmonics ? int(column) : int(column) - harmonics;
  }
  Index size() const
  {
    return to_moments.cols();
  }
};

// What the springs add to their tangents, as series, with its derivatives: rho (s, b), slope of each (b, b).
struct Remainders {
  MatrixXd rho;
  std::vector<MatrixXd> slope;
};

Remainders remainders(const CurveStand &stand, const Basis &basis, const MatrixXd &d)
{
  Remainders r{MatrixXd(d.rows(), d.cols()), {}};
  for (Index j = 0; j < d.rows(); ++j) {
    const CurveSpring &spring = stand.springs[std::size_t(j)];
    VectorXd force            = basis.to_moments * d.row(j).transpose(), stiffness(force.size());
    for (Index i = 0; i < force.size(); ++i) {
      const SpringForce f = beyond_tangent(stand, spring, force[i]);
      force[i]            = f.force;
      stiffness[i]        = f.stiffness;
    }
    r.rho.row(j) = (basis.back * force).transpose();
    r.slope.push_back(basis.back * stiffness.asDiagonal() * basis.to_moments);
  }
  return r;
}

// Modal displacement per modal force at one harmonic; a mode without stiffness does not drift.  (36.8)
class Receptance {
public:
  Receptance(const CurveStand &stand, const double w, const bool damped, const Index without = -1)
      : own_(Index(stand.modes())), gap_(damped ? stand.gap_damper : 0), push_(vector_of(stand.push)), w_(w)
  {
    for (Index k = 0; k < own_.size(); ++k) {
      const double rate = stand.rate[std::size_t(k)];
      const Complex z(rate * rate - w * w, damped ? 2 * stand.damping * rate * w : 0);
      own_[k] = k == without || z == 0.0 ? Complex(0) : 1.0 / z;
    }
    const Complex damper(0, w * gap_), through = (own_.array() * push_.array().square()).sum();
    weight_ = damper / (1.0 + damper * through);
  }
  VectorXcd apply(const VectorXcd &force) const
  {
    VectorXcd q = own_.cwiseProduct(force);
    if (w_ * gap_ > 0) {
      const VectorXcd through = own_.cwiseProduct(push_.cast<Complex>());
      q -= weight_ * (push_.cast<Complex>().transpose() * q).value() * through;
    }
    return q;
  }
  // (s, s) between the springs
  MatrixXcd between(const MatrixXd &rows) const
  {
    MatrixXcd g = rows.cast<Complex>() * own_.asDiagonal() * rows.transpose().cast<Complex>();
    if (w_ * gap_ > 0) {
      const VectorXcd through = rows.cast<Complex>() * own_.cwiseProduct(push_.cast<Complex>());
      g -= weight_ * through * through.transpose();
    }
    return g;
  }

private:
  VectorXcd own_;
  double gap_;
  VectorXd push_;
  double w_;
  Complex weight_;
};

VectorXd rests(const CurveStand &stand)
{
  VectorXd rest(Index(stand.springs.size()));
  for (Index j = 0; j < rest.size(); ++j)
    rest[j] = stand.springs[std::size_t(j)].rest;
  return rest;
}

void set_least(PeriodicMotion &motion, const CurveStand &stand)
{
  const Index h       = motion.cosine.cols() - 1;
  motion.least        = VectorXd(motion.cosine.rows());
  const Index moments = 32 * (h + 2);
  for (Index j = 0; j < motion.cosine.rows(); ++j) {
    double least = INFINITY;
    for (Index i = 0; i < moments; ++i) {
      double d = stand.springs[std::size_t(j)].rest;
      for (Index k = 0; k <= h; ++k) {
        const double angle = 2 * M_PI * double(k * i) / double(moments);
        d += motion.cosine(j, k) * std::cos(angle) + motion.sine(j, k) * std::sin(angle);
      }
      least = std::min(least, d);
    }
    motion.least[j] = least;
  }
}

// Equations of one kind of motion: residual (m, scaled by the rests) and its derivative at the unknowns.
template <class Equations> bool newton(VectorXd &x, const Equations &equations)
{
  VectorXd miss;
  MatrixXd slope;
  equations(x, miss, &slope);
  double now = miss.cwiseAbs().maxCoeff();
  for (int round = 0; round < most_rounds; ++round) {
    if (!std::isfinite(now))
      return false;
    if (now <= settled)
      return true;
    const VectorXd step = slope.partialPivLu().solve(miss), start = x;
    const double before = now;
    for (double part = 1; part > 1e-4; part /= 2) {
      x = start - part * step;
      equations(x, miss, nullptr);
      now = miss.cwiseAbs().maxCoeff();
      if (now < before)
        break;
    }
    if (!(now < before))
      return before <= 1e3 * settled;
    equations(x, miss, &slope);
  }
  return now <= 1e3 * settled;
}

// Unknowns: compressions over rests, spring by spring, b each.
MatrixXd as_series(const VectorXd &x, const VectorXd &rest, const Index b)
{
  return rest.asDiagonal() *
         Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(x.data(), rest.size(), b);
}
}  // namespace

PeriodicMotion free_motion(const CurveStand &stand, const Index mode, const double amplitude, const int harmonics,
                           const PeriodicMotion *near)
{
  const Basis basis(harmonics, false);
  const MatrixXd rows = rows_of(stand);
  const VectorXd rest = rests(stand);
  const Index s = rest.size(), b = basis.size(), u = s * b;
  const double tangent = stand.rate[std::size_t(mode)];
  VectorXd x           = VectorXd::Zero(u + 1);  // the last one: (w / w of the tangents)^2
  for (Index j = 0; j < s; ++j)
    for (Index k = 0; k < b; ++k)
      x[j * b + k] = (near ? near->cosine(j, k) : (k == 1 ? amplitude * rows(j, mode) : 0.0)) / rest[j];
  x[u] = near ? std::pow(2 * M_PI * near->frequency / tangent, 2) : 1;

  const auto equations = [&](const VectorXd &positions, VectorXd &miss, MatrixXd *slope) {
    const MatrixXd d    = as_series(positions, rest, b);
    const Remainders r  = remainders(stand, basis, d);
    const double square = positions[u] * tangent * tangent;
    miss.resize(u + 1);
    if (slope)
      *slope = MatrixXd::Zero(u + 1, u + 1);
    for (Index k = 0; k < b; ++k) {
      VectorXd values(rows.cols()), by_square(rows.cols());
      for (Index m = 0; m < values.size(); ++m) {
        const double z = std::pow(stand.rate[std::size_t(m)], 2) - double(k * k) * square;
        values[m]      = (k == 1 && m == mode) || z == 0 ? 0 : 1 / z;
        by_square[m]   = double(k * k) * values[m] * values[m];
      }
      const MatrixXd G      = rows * values.asDiagonal() * rows.transpose();
      const VectorXd moved  = G * r.rho.col(k);
      const VectorXd slower = rows * by_square.cwiseProduct(rows.transpose() * r.rho.col(k));
      for (Index j = 0; j < s; ++j) {
        miss[j * b + k] = (d(j, k) + moved[j] - (k == 1 ? rows(j, mode) * amplitude : 0)) / rest[j];
        if (!slope)
          continue;
        (*slope)(j * b + k, j * b + k) += 1;
        (*slope)(j * b + k, u) = slower[j] * tangent * tangent / rest[j];
        for (Index i = 0; i < s; ++i)
          slope->row(j * b + k).segment(i * b, b) += G(j, i) * rest[i] / rest[j] * r.slope[std::size_t(i)].row(k);
      }
    }
    // The mode itself.
    const double scale = 1 / (tangent * tangent * amplitude);
    miss[u]            = (1 - positions[u]) + scale * rows.col(mode).dot(r.rho.col(1));
    if (slope) {
      (*slope)(u, u) = -1;
      for (Index i = 0; i < s; ++i)
        slope->row(u).segment(i * b, b) += scale * rows(i, mode) * rest[i] * r.slope[std::size_t(i)].row(1);
    }
  };
  PeriodicMotion motion;
  motion.settled     = tangent > 0 && newton(x, equations) && x[u] > 0;
  motion.frequency   = tangent * std::sqrt(std::max(0.0, x[u])) / (2 * M_PI);
  motion.cosine      = as_series(x, rest, b);
  motion.sine        = MatrixXd::Zero(s, b);
  const Remainders r = remainders(stand, basis, motion.cosine);
  motion.modal       = MatrixXcd::Zero(rows.cols(), b);
  for (Index k = 0; k < b; ++k)
    for (Index m = 0; m < rows.cols(); ++m) {
      const double z     = std::pow(stand.rate[std::size_t(m)], 2) - double(k * k) * x[u] * tangent * tangent;
      motion.modal(m, k) = k == 1 && m == mode ? amplitude : z == 0 ? 0 : -rows.col(m).dot(r.rho.col(k)) / z;
    }
  set_least(motion, stand);
  return motion;
}

PeriodicMotion forced_motion(const CurveStand &stand, const double frequency, const double force,
                             const int harmonics, const PeriodicMotion *near)
{
  const Basis basis(harmonics, true);
  const MatrixXd rows = rows_of(stand);
  const VectorXd rest = rests(stand), push = vector_of(stand.push);
  const Index s = rest.size(), b = basis.size(), u = s * b, h = harmonics;
  std::vector<Receptance> receptance;
  std::vector<MatrixXcd> between;
  for (int k = 0; k <= harmonics; ++k) {
    receptance.emplace_back(stand, 2 * M_PI * frequency * k, true);
    between.push_back(receptance.back().between(rows));
  }
  const VectorXcd linear = rows.cast<Complex>() * receptance[1].apply(force * push.cast<Complex>());
  // d = Re(D e^(i k w t)), D = cosine - i sine.
  VectorXd x = VectorXd::Zero(u);
  for (Index j = 0; j < s; ++j)
    for (Index k = 0; k <= h; ++k) {
      x[j * b + k] = (near ? near->cosine(j, k) : k == 1 ? linear[j].real() : 0.0) / rest[j];
      if (k > 0)
        x[j * b + h + k] = (near ? near->sine(j, k) : k == 1 ? -linear[j].imag() : 0.0) / rest[j];
    }
  const auto equations = [&](const VectorXd &positions, VectorXd &miss, MatrixXd *slope) {
    const MatrixXd d   = as_series(positions, rest, b);
    const Remainders r = remainders(stand, basis, d);
    miss.resize(u);
    if (slope)
      *slope = MatrixXd::Identity(u, u);
    for (Index k = 0; k <= h; ++k) {
      VectorXcd rho = r.rho.col(k).cast<Complex>();
      if (k > 0)
        rho -= Complex(0, 1) * r.rho.col(h + k);
      const MatrixXcd &G    = between[std::size_t(k)];
      const VectorXcd moved = G * rho;
      for (Index j = 0; j < s; ++j) {
        const Complex nonlinear_part = moved[j] - (k == 1 ? linear[j] : Complex(0));
        miss[j * b + k]              = (d(j, k) + nonlinear_part.real()) / rest[j];
        if (k > 0)
          miss[j * b + h + k] = (d(j, h + k) - nonlinear_part.imag()) / rest[j];
        if (!slope)
          continue;
        for (Index i = 0; i < s; ++i) {
          const double over          = rest[i] / rest[j];
          const MatrixXd &derivative = r.slope[std::size_t(i)];
          slope->row(j * b + k).segment(i * b, b) += over * G(j, i).real() * derivative.row(k);
          if (k > 0) {
            slope->row(j * b + k).segment(i * b, b) += over * G(j, i).imag() * derivative.row(h + k);
            slope->row(j * b + h + k).segment(i * b, b) +=
                over * (G(j, i).real() * derivative.row(h + k) - G(j, i).imag() * derivative.row(k));
          }
        }
      }
    }
  };
  PeriodicMotion motion;
  motion.settled           = newton(x, equations);
  motion.frequency         = frequency;
  const MatrixXd d         = as_series(x, rest, b);
  motion.cosine            = d.leftCols(h + 1);
  motion.sine              = MatrixXd::Zero(s, h + 1);
  motion.sine.rightCols(h) = d.rightCols(h);
  const Remainders r       = remainders(stand, basis, d);
  motion.modal             = MatrixXcd::Zero(rows.cols(), h + 1);
  for (Index k = 0; k <= h; ++k) {
    VectorXcd rho = r.rho.col(k).cast<Complex>();
    if (k > 0)
      rho -= Complex(0, 1) * r.rho.col(h + k);
    VectorXcd acting = -(rows.transpose().cast<Complex>() * rho);
    if (k == 1)
      acting += force * push.cast<Complex>();
    motion.modal.col(k) = receptance[std::size_t(k)].apply(acting);
  }
  set_least(motion, stand);
  return motion;
}
}  // namespace mill::dynamics
