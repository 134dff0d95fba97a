#include "twin/modes/force_response.h"
#include "twin/spectra/welch.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr double longest_segment = 10;  // s

Eigen::Index segment_of(const DecimatedRecord &record)
{
  Eigen::Index all = 0, longest = 0;
  for (const auto &piece : record.piece) {
    all += piece.cols();
    longest = std::max(longest, piece.cols());
  }
  Eigen::Index L = default_segment(all);
  while (L > longest || double(L) > longest_segment * record.rate)
    L /= 2;
  return L;
}

// Sums over the segments of |F|^2, Y F* and |Y|^2.
struct Sums {
  Eigen::VectorXd force;
  Eigen::MatrixXcd cross;
  Eigen::MatrixXd channel;
};

void add_segment(Sums &sums, const Eigen::Ref<const Eigen::MatrixXd> &part, const Eigen::ArrayXd &window,
                 Fourier &fourier)
{
  const Eigen::Index kept = sums.force.size(), p = sums.cross.cols();
  std::vector<double> x(std::size_t(part.cols()), 0.0);
  std::vector<std::complex<double>> lines;
  const auto transformed = [&](const Eigen::Index row) {
    const auto values                                 = part.row(row).transpose().array();
    Eigen::Map<Eigen::ArrayXd>(x.data(), part.cols()) = (values - values.mean()) * window;
    fourier.forward(x, lines);
    return Eigen::VectorXcd(Eigen::Map<const Eigen::VectorXcd>(lines.data(), kept));
  };
  const Eigen::VectorXcd F = transformed(p);
  sums.force += F.cwiseAbs2();
  for (Eigen::Index c = 0; c < p; ++c) {
    const Eigen::VectorXcd Y = transformed(c);
    sums.cross.col(c) += Y.cwiseProduct(F.conjugate());
    sums.channel.col(c) += Y.cwiseAbs2();
  }
}
}  // namespace

double ForceResponse::resolution() const
{
  return rate / double(L);
}

double ForceResponse::length() const
{
  return double(L) / rate;
}

ForceResponse force_response(const DecimatedRecord &record, const double highest, const Eigen::Index wanted,
                             Fourier &fourier)
{
  ForceResponse result;
  if (record.piece.empty())
    return result;
  const Eigen::Index L = wanted > 0 ? wanted : segment_of(record), p = record.piece.front().rows() - 1;
  result.rate = record.rate;
  result.L    = L;
  if (L < 64)
    return result;
  const auto kept = std::min(L / 2, Eigen::Index(highest * double(L) / record.rate)) + 1;
  Sums sums{Eigen::VectorXd::Zero(kept), Eigen::MatrixXcd::Zero(kept, p), Eigen::MatrixXd::Zero(kept, p)};
  const Eigen::ArrayXd window =
      0.5 - 0.5 * (Eigen::ArrayXd::LinSpaced(L, 0, double(L - 1)) * (2 * M_PI / double(L))).cos();
  for (const auto &piece : record.piece)
    for (Eigen::Index first = 0; first + L <= piece.cols(); first += L / 2, ++result.n)
      add_segment(sums, piece.middleCols(first, L), window, fourier);
  if (result.n < 2) {
    result.n = 0;
    return result;
  }
  const double n_free = double(result.n) / (1 + double(result.n - 1) / (18 * double(result.n)));  // (41.5)
  result.force        = sums.force * (2 / (record.rate * 3 * double(L) / 8 * double(result.n)));
  result.H            = Eigen::MatrixXcd::Zero(kept, p);
  result.coherence    = Eigen::MatrixXd::Zero(kept, p);
  for (Eigen::Index k = 0; k < kept; ++k)
    for (Eigen::Index c = 0; c < p; ++c)
      if (sums.force[k] > 0 && sums.channel(k, c) > 0) {
        result.H(k, c)         = sums.cross(k, c) / sums.force[k];
        const double of_record = std::norm(sums.cross(k, c)) / (sums.force[k] * sums.channel(k, c));
        result.coherence(k, c) = std::clamp(1 - (1 - of_record) * n_free / (n_free - 1), 0.0, 1.0);
      }
  return result;
}
}  // namespace mill::twin
