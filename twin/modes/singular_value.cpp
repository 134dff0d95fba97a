#include "twin/modes/singular_value.h"
#include <cmath>
#include <vector>

namespace mill::twin {
namespace {
// Largest eigenvalue of a matrix without negative ones, to some digits: it is shown behind a diagram.
double largest_eigenvalue(const Eigen::MatrixXcd &S)
{
  Eigen::Index column = 0;
  S.diagonal().real().maxCoeff(&column);
  Eigen::VectorXcd v = S.col(column);
  double value       = 0;
  for (int step = 0; step < 30 && v.norm() > 0; ++step) {
    v.normalize();
    v     = S * v;
    value = v.norm();
  }
  return value;
}
}  // namespace

FirstSingularValue first_singular_value(const DecimatedRecord &record, const double highest, Fourier &fourier)
{
  Eigen::Index L = 64;
  while (2 * L <= Eigen::Index(record.rate))
    L *= 2;
  if (record.piece.empty())
    return {};
  const Eigen::Index p = record.piece.front().rows();
  const auto n         = std::min(L / 2, Eigen::Index(highest * double(L) / record.rate)) + 1;
  const Eigen::ArrayXd window =
      0.5 - 0.5 * (Eigen::ArrayXd::LinSpaced(L, 0, double(L - 1)) * (2 * M_PI / double(L))).cos();
  std::vector<Eigen::MatrixXcd> S(std::size_t(n), Eigen::MatrixXcd::Zero(p, p));
  std::vector<double> x(std::size_t(L), 0.0);
  std::vector<std::complex<double>> lines;
  Eigen::MatrixXcd Y(p, n);
  double segments        = 0;
  Eigen::VectorXd square = Eigen::VectorXd::Zero(p);
  double samples         = 0;
  for (const auto &piece : record.piece) {
    square += piece.rowwise().squaredNorm();
    samples += double(piece.cols());
    for (Eigen::Index first = 0; first + L <= piece.cols(); first += L / 2, ++segments) {
      for (Eigen::Index c = 0; c < p; ++c) {
        const auto part                         = piece.row(c).segment(first, L).transpose().array();
        Eigen::Map<Eigen::ArrayXd>(x.data(), L) = (part - part.mean()) * window;
        fourier.forward(x, lines);
        Y.row(c) = Eigen::Map<const Eigen::RowVectorXcd>(lines.data(), n);
      }
      for (Eigen::Index k = 0; k < n; ++k)
        S[std::size_t(k)].noalias() += Y.col(k) * Y.col(k).adjoint();
    }
  }
  if (!(segments > 0))
    return {};
  const Eigen::VectorXd scale = (square / samples).cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  const double to_density     = 2 / (record.rate * 3 * double(L) / 8 * segments);
  FirstSingularValue result{Eigen::VectorXd(n - 1), Eigen::VectorXd(n - 1)};
  for (Eigen::Index k = 1; k < n; ++k) {
    result.frequency[k - 1] = double(k) * record.rate / double(L);
    result.value[k - 1] =
        to_density * largest_eigenvalue(scale.asDiagonal() * S[std::size_t(k)] * scale.asDiagonal());
  }
  return result;
}
}  // namespace mill::twin
