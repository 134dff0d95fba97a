#pragma once
#include "reduce/bearing/ring_flexibility.h"
#include <cmath>

/// Flexibility of rings by a smooth rule, symmetric and positive definite; `scale` m/N is that of one roller
/// alone. With a chock the first harmonics of the cup mix.
inline mill::bearing::RingFlexibility smooth_rings(const int rows, const int modes, const double scale,
                                                   const int chock = 0)
{
  mill::bearing::RingFlexibility rings;
  rings.rows            = rows;
  rings.modes           = modes;
  rings.chock_harmonics = chock;
  const int size        = rows * modes;
  const auto entry      = [&](int i, int k) {
    return scale / 30 * (i % modes == k % modes ? 1.0 : 0.2) / (1 + i % modes + k % modes) *
           std::exp(-1.5 * std::abs(i / modes - k / modes));
  };
  const auto decay = [](int m) { return 1 / (1 + 0.2 * m); };
  for (int m = 0; m < 12; ++m) {
    Eigen::MatrixXd one(size, size);
    for (int i = 0; i < size; ++i)
      for (int k = 0; k < size; ++k)
        one(i, k) = entry(i, k) * decay(m) * decay(m);
    rings.inner.push_back(one);
    rings.outer.push_back(m < chock ? Eigen::MatrixXd(0 * one) : one);
  }
  const auto mixed = [&](int first) {
    Eigen::MatrixXd all(std::max(0, chock - first) * size, std::max(0, chock - first) * size);
    for (int i = 0; i < all.rows(); ++i)
      for (int k = 0; k < all.cols(); ++k)
        all(i, k) = entry(i % size, k % size) * decay(first + i / size) * decay(first + k / size) *
                    std::pow(0.4, std::abs(i / size - k / size));
    return all;
  };
  rings.chock_cosine = mixed(0);
  rings.chock_sine   = mixed(1);
  return rings;
}
