#include "tests/manual/stand/component_beams.h"
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace mill::verify {
namespace {
struct Section {
  double EI, GA, mass, rotary;  // N m2, N, kg/m, kg m
};
Section section(const double d, const double kappa, const Material &steel)
{
  const double A = M_PI / 4 * d * d, I = A * d * d / 16;
  const double G = steel.youngs_modulus / (2 * (1 + steel.poisson_ratio));
  return {steel.youngs_modulus * I, kappa * G * A, steel.density * A, steel.density * I};
}
}  // namespace

std::vector<BeamPiece> roll_pieces(const double barrel, const double half_barrel, const double neck,
                                   const double seat, const double end, const double cone)
{
  std::vector<BeamPiece> pieces;
  const double length = cone * 0.5 * (barrel - neck), start = half_barrel - length;
  constexpr int steps = 10;
  pieces.push_back({0, start, barrel, barrel});
  for (int i = 0; cone > 0 && i < steps; ++i)
    pieces.push_back({start + length * i / steps, start + length * (i + 1) / steps, barrel,
                      barrel - (barrel - neck) * (i + 0.5) / steps});
  pieces.push_back({half_barrel, seat, neck, neck});
  if (end > seat)
    pieces.push_back({seat, end, neck, neck});
  return pieces;
}

SteppedTimoshenko::SteppedTimoshenko(const BeamSetup &s, const Material &material) : setup(s)
{
  const int n_elements = int(setup.pieces.size()) * setup.per_piece;
  z.resize(n_elements + 1);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(2 * z.size(), 2 * z.size()), mass = stiffness;
  int e = 0;
  for (const BeamPiece &piece : setup.pieces)
    for (int i = 0; i < setup.per_piece; ++i, ++e) {
      const Section c     = section(piece.stiff_diameter, setup.shear_factor, material);
      const Section heavy = section(piece.diameter, setup.shear_factor, material);
      const double l      = (piece.to - piece.from) / setup.per_piece;
      z[e]                = piece.from + i * l;
      z[e + 1]            = z[e] + l;
      // Flexibility of the cantilever: tip force and tip moment; its inverse is the stiffness of one end.
      Eigen::Matrix2d tip;
      tip << l * l * l / (3 * c.EI) + l / c.GA, l * l / (2 * c.EI), l * l / (2 * c.EI), l / c.EI;
      Eigen::Matrix<double, 2, 4> relative;  // motion of the right end against the rigid motion of the left one
      relative << -1, -l, 1, 0, 0, -1, 0, 1;
      stiffness.block<4, 4>(2 * e, 2 * e) += relative.transpose() * tip.inverse() * relative;
      for (const int node : {e, e + 1}) {
        mass(2 * node, 2 * node) += heavy.mass * l / 2;
        mass(2 * node + 1, 2 * node + 1) += setup.rotary_inertia ? heavy.rotary * l / 2 : 0;
      }
    }
  // No rotation at mid-length: leave out unknown 1.
  const auto without = [&](const Eigen::MatrixXd &full) {
    const Eigen::Index n = full.rows();
    Eigen::MatrixXd out(n - 1, n - 1);
    out(0, 0)                           = full(0, 0);
    out.topRightCorner(1, n - 2)        = full.topRightCorner(1, n - 2);
    out.bottomLeftCorner(n - 2, 1)      = full.bottomLeftCorner(n - 2, 1);
    out.bottomRightCorner(n - 2, n - 2) = full.bottomRightCorner(n - 2, n - 2);
    return out;
  };
  K = without(stiffness);
  M = without(mass);
  allowed.setIdentity(K.rows(), K.rows());
  if (setup.seat_centre == 0)
    return;
  seat = Eigen::VectorXd::Zero(K.rows());
  for (Eigen::Index i = 1; i < z.size(); ++i) {
    const double t      = (z[i] - setup.seat_centre) / std::max(setup.seat_width, 1e-12);
    const double length = i + 1 < z.size() ? 0.5 * (z[i + 1] - z[i - 1]) : 0.5 * (z[i] - z[i - 1]);
    seat[2 * i - 1]     = std::abs(t) < 1 ? std::pow(std::cos(M_PI / 2 * t), 2) * length : 0;
  }
  if (setup.seat_width == 0) {
    Eigen::Index nearest = 0;
    (z.array() - setup.seat_centre).abs().minCoeff(&nearest);
    seat.setZero();
    seat[2 * nearest - 1] = 1;
  }
  seat /= seat.sum();
  // The unknown that weighs most follows from the others.
  Eigen::Index last = 0;
  seat.maxCoeff(&last);
  allowed.row(last) = -seat.transpose() / seat[last];
  allowed.col(last) = allowed.col(K.rows() - 1);
  allowed.conservativeResize(Eigen::NoChange, K.rows() - 1);
}

Eigen::VectorXd SteppedTimoshenko::frequencies(const int k) const
{
  // Shifted, so that a free beam has no singular stiffness; the mass may be singular instead.
  const double shift            = std::pow(2 * M_PI * 100, 2);
  const Eigen::MatrixXd mass    = allowed.transpose() * M * allowed;
  const Eigen::MatrixXd shifted = allowed.transpose() * K * allowed + shift * mass;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(mass, shifted, Eigen::EigenvaluesOnly);
  Eigen::VectorXd out(k);
  const Eigen::Index n = mass.rows(), rigid = seat.size() == 0;
  for (int i = 0; i < k; ++i)
    out[i] = std::sqrt(1 / modes.eigenvalues()[n - 1 - rigid - i] - shift) / (2 * M_PI);
  return out;
}

Eigen::VectorXd SteppedTimoshenko::deflection(const double half_load) const
{
  Eigen::VectorXd load = Eigen::VectorXd::Zero(K.rows());
  for (Eigen::Index i = 0; i + 1 < z.size(); ++i)
    if (z[i + 1] <= half_load + 1e-9)
      for (const Eigen::Index node : {i, i + 1})
        load[std::max<Eigen::Index>(0, 2 * node - 1)] += 0.5 * (z[i + 1] - z[i]) / (2 * half_load);
  const Eigen::VectorXd u = allowed * (allowed.transpose() * K * allowed).ldlt().solve(allowed.transpose() * load);
  Eigen::VectorXd w(z.size());
  for (Eigen::Index i = 0; i < z.size(); ++i)
    w[i] = u[std::max<Eigen::Index>(0, 2 * i - 1)];
  return w;
}

Eigen::VectorXd free_bar_frequencies(const double diameter, const double length, const Material &steel,
                                     const double shear_factor, const int k)
{
  const double l  = length / 2;
  const Section c = section(diameter, shear_factor, steel);
  // Symmetric solution w = A cosh(a x) + B cos(b x) below the cut-off; no moment and no shear force at x = l.
  const auto determinant = [&](const double w2) {
    const double p    = w2 * (c.rotary / c.EI + c.mass / c.GA);  // from E and from kappa G
    const double q    = w2 * (c.rotary / c.EI - c.mass / c.GA);
    const double root = std::sqrt(0.25 * q * q + w2 * c.mass / c.EI);
    const double a = std::sqrt(root - 0.5 * p), b = std::sqrt(root + 0.5 * p);
    const double t1 = (c.GA * a * a + w2 * c.mass) / (c.GA * a), t2 = (w2 * c.mass - c.GA * b * b) / (c.GA * b);
    return a * t1 * (-b - t2) * std::sin(b * l) - b * t2 * std::cos(b * l) * (a - t1) * std::tanh(a * l);
  };
  Eigen::VectorXd out(k);
  double last = determinant(std::pow(2 * M_PI, 2));
  int n_found = 0;
  for (double f = 2; n_found < k; f += 1) {
    const double now = determinant(std::pow(2 * M_PI * f, 2));
    if ((now > 0) != (last > 0)) {
      double low = f - 1, high = f;
      for (int i = 0; i < 60; ++i) {
        const double middle                                                            = 0.5 * (low + high);
        ((determinant(std::pow(2 * M_PI * middle, 2)) > 0) == (last > 0) ? low : high) = middle;
      }
      out[n_found++] = 0.5 * (low + high);
    }
    last = now;
  }
  return out;
}
}  // namespace mill::verify
