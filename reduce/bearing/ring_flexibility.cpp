#include "reduce/bearing/ring_flexibility.h"
#include "core/base/errors.h"
#include <algorithm>
#include <cmath>

namespace mill::bearing {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void require_shapes(const RingFlexibility &r)
{
  const Index size = Index(r.rows) * r.modes, n = r.chock_harmonics;
  bool fits = r.rows >= 0 && r.modes >= 0 && n >= 0;
  for (const auto *ring : {&r.inner, &r.outer})
    for (const MatrixXd &m : *ring)
      fits = fits && m.rows() == size && m.cols() == size;
  if (n > 0)
    fits = fits && r.chock_cosine.rows() == n * size && r.chock_cosine.cols() == n * size &&
           r.chock_sine.rows() == (n - 1) * size && r.chock_sine.cols() == (n - 1) * size;
  if (!fits)
    throw InputError("rings: a flexibility of " + std::to_string(r.rows) + " rows and " + std::to_string(r.modes) +
                     " modes has matrices of another size");
}

/// (Z, n) cos(m psi) or sin(m psi), m = first .. first + n - 1.
MatrixXd waves(const VectorXd &azimuth, const int first, const int n, const bool sine)
{
  MatrixXd out(azimuth.size(), n);
  for (int m = 0; m < n; ++m)
    for (Index j = 0; j < azimuth.size(); ++j)
      out(j, m) = sine ? std::sin((first + m) * azimuth[j]) : std::cos((first + m) * azimuth[j]);
  return out;
}

/// Adds sum over m, m' of wave_m(psi) matrix[(m..),(m'..)] wave_m'(psi') to all pairs of rollers.
void add_harmonics(MatrixXd &all, const MatrixXd &matrix, const MatrixXd &wave, const RingFlexibility &r)
{
  const Index size = Index(r.rows) * r.modes, n = wave.cols(), Z = wave.rows();
  using Strides = Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>;
  for (Index b = 0; b < size; ++b)
    for (Index a = 0; a < size; ++a) {
      // Entries (m size + a, m' size + b) of the matrix; rollers (row Z + j) modes + mode of the result.
      const Eigen::Map<const MatrixXd, 0, Strides> block(matrix.data() + a + b * matrix.rows(), n, n,
                                                         Strides(size * matrix.rows(), size));
      const MatrixXd pairs = wave * block * wave.transpose();
      const Index row = (a / r.modes) * Z * r.modes + a % r.modes, col = (b / r.modes) * Z * r.modes + b % r.modes;
      Eigen::Map<MatrixXd, 0, Strides>(all.data() + row + col * all.rows(), Z, Z,
                                       Strides(r.modes * all.rows(), r.modes)) += pairs;
    }
}

/// A ring of revolution: the harmonics do not mix, cos m(psi - psi') = cos cos + sin sin.
void add_round(MatrixXd &all, const std::vector<MatrixXd> &ring, const VectorXd &azimuth, const RingFlexibility &r)
{
  const Index size = Index(r.rows) * r.modes, Z = azimuth.size(), n = Index(ring.size());
  if (n == 0)
    return;
  // (Z Z, n): cos m(psi_i - psi_j); all pairs of one entry (a, b) are then one product.
  MatrixXd wave(Z * Z, n);
  for (Index m = 0; m < n; ++m)
    for (Index j = 0; j < Z; ++j)
      for (Index i = 0; i < Z; ++i)
        wave(i + j * Z, m) = std::cos(double(m) * (azimuth[i] - azimuth[j]));
  MatrixXd entries(n, size * size);
  for (Index m = 0; m < n; ++m)
    entries.row(m) = ring[std::size_t(m)].reshaped().transpose();
  const MatrixXd pairs = wave * entries;
  for (Index b = 0; b < size; ++b)
    for (Index a = 0; a < size; ++a) {
      const Index row = (a / r.modes) * Z * r.modes + a % r.modes, col = (b / r.modes) * Z * r.modes + b % r.modes;
      for (Index j = 0; j < Z; ++j)
        for (Index i = 0; i < Z; ++i)
          all(row + i * r.modes, col + j * r.modes) += pairs(i + j * Z, a + b * size);
    }
}
}  // namespace

MatrixXd flexibility_at(const RingFlexibility &rings, const VectorXd &azimuth)
{
  require_shapes(rings);
  const Index unknowns = Index(rings.rows) * azimuth.size() * rings.modes;
  MatrixXd all         = MatrixXd::Zero(unknowns, unknowns);
  add_round(all, rings.inner, azimuth, rings);
  add_round(all, rings.outer, azimuth, rings);
  const int n = rings.chock_harmonics;
  if (n > 0)
    add_harmonics(all, rings.chock_cosine, waves(azimuth, 0, n, false), rings);
  if (n > 1)
    add_harmonics(all, rings.chock_sine, waves(azimuth, 1, n - 1, true), rings);
  return (all + all.transpose()) / 2;
}

RingFlexibility stiffer(RingFlexibility rings, const double factor)
{
  if (!(factor > 0))
    throw InputError("rings: the factor on the modulus must be positive");
  for (auto *ring : {&rings.inner, &rings.outer})
    for (MatrixXd &m : *ring)
      m /= factor;
  rings.chock_cosine /= factor;
  rings.chock_sine /= factor;
  return rings;
}

namespace {
// (n rows modes)^2, or without order 0: what moves by cos (sin) m psi, orders beyond the chock's own from the
// round cup.
MatrixXd around_the_cup(const RingFlexibility &r, const bool sine, const int harmonics)
{
  const Index size = Index(r.rows) * r.modes, first = sine ? 1 : 0;
  const MatrixXd &chock = sine ? r.chock_sine : r.chock_cosine;
  if (r.chock_harmonics > harmonics || Index(r.outer.size()) < harmonics)
    throw InputError("rings: " + std::to_string(harmonics) + " orders of the cup are wanted, " +
                     std::to_string(r.outer.size()) + " are there");
  MatrixXd out = MatrixXd::Zero((harmonics - first) * size, (harmonics - first) * size);
  out.topLeftCorner(chock.rows(), chock.cols()) = chock;
  for (Index m = std::max<Index>(first, r.chock_harmonics); m < harmonics; ++m)
    out.block((m - first) * size, (m - first) * size, size, size) = r.outer[std::size_t(m)];
  return out;
}
}  // namespace

RingFlexibility with_surroundings_of(RingFlexibility fine, const RingFlexibility &companion,
                                     const RingFlexibility &other, const int harmonics)
{
  for (const auto *r : {&companion, &other})
    if (r->rows != fine.rows || r->modes != fine.modes)
      throw InputError("rings: two sets with another number of rows or polynomials");
  for (const bool sine : {false, true})
    (sine ? fine.chock_sine : fine.chock_cosine) = around_the_cup(fine, sine, harmonics) +
                                                   around_the_cup(other, sine, harmonics) -
                                                   around_the_cup(companion, sine, harmonics);
  for (int m = 0; m < harmonics; ++m)
    fine.outer[std::size_t(m)].setZero();
  fine.chock_harmonics = harmonics;
  return fine;
}

MatrixXd line_modes(const VectorXd &position, const double length, const int modes)
{
  MatrixXd P(position.size(), modes);
  const Eigen::ArrayXd u = 2 * position.array() / length;
  for (int a = 0; a < modes; ++a)
    if (a == 0)
      P.col(a).setOnes();
    else if (a == 1)
      P.col(a) = u;
    else  // (a) P_a = (2a - 1) u P_(a-1) - (a - 1) P_(a-2)
      P.col(a) = ((2 * a - 1) * u * P.col(a - 1).array() - (a - 1) * P.col(a - 2).array()) / a;
  return P;
}
}  // namespace mill::bearing
