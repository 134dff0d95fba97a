#include "tests/manual/bearing/bearing_models.h"
#include "reduce/bearing/ratings.h"
#include "tests/manual/check/units.h"
#include <cmath>

namespace mill::verify {
namespace {
}

RollerBearing bearing_266(const double cup_angle)
{
  RollerBearing b;
  b.name              = "trb";
  b.type              = BearingType::four_row_tapered;
  b.bore              = 266.7 * mm;
  b.outside_diameter  = 355.6 * mm;
  b.width             = 230.188 * mm;
  b.rollers_per_row   = 39;
  b.roller_length     = 33.4 * mm;
  b.roller_diameter   = 21.5 * mm;
  b.roller_cone_angle = 2.5 * degree;
  b.cup_angle         = cup_angle * degree;
  return b;
}

bearing::BearingModel bearing_hh926700()
{
  bearing::BearingModel model;
  RollerBearing &b    = model.bearing;
  b.name              = "HH926700";
  b.type              = BearingType::four_row_tapered;
  b.rows              = 2;
  b.arrangement       = "+-";
  b.width             = 4 * 37.98 * mm;  // rows at -37.98 and +37.98 mm
  b.rollers_per_row   = 14;
  b.roller_length     = 57.02 * mm;
  b.roller_diameter   = (30.27 + 36.74) / 2 * mm;
  b.pitch_diameter    = 198.93 * mm;
  b.cup_angle         = 22.54 * degree;
  b.roller_cone_angle = (22.54 - 16.24) * degree;
  b.rib_angle         = 70.20 * degree;
  b.preload           = 100;
  b.youngs_modulus    = 210e9;
  model.roller        = bearing::luo_law(b, 167.35 * mm, 230.51 * mm);

  const double speed      = 1200 * 2 * M_PI / 60;
  model.centrifugal_force = 0.126 * b.pitch_diameter * speed * speed / 2;
  return model;
}

// Every factor is positive definite and so is their product: exp(-|r - r'|) between rows, 0.3^|m - m'|
// between harmonics of the chock, a decay over harmonics and modes.
bearing::RingFlexibility synthetic_rings(const int rows, const int modes)
{
  constexpr int n = 21, chock = 8;
  const int size   = rows * modes;
  const auto decay = [](int m) { return 1 / std::sqrt(1 + 0.05 * m * m * m); };
  const auto entry = [&](int i, int k) {
    const double lines = (i % modes == k % modes ? 1.0 : 0.3) / std::sqrt((1.0 + i % modes) * (1.0 + k % modes));
    return 2.5e-10 / 39 * lines * std::exp(-std::abs(i / modes - k / modes));
  };
  bearing::RingFlexibility rings;
  rings.rows            = rows;
  rings.modes           = modes;
  rings.chock_harmonics = chock;
  for (int m = 0; m < n; ++m) {
    Eigen::MatrixXd one(size, size);
    for (int i = 0; i < size; ++i)
      for (int k = 0; k < size; ++k)
        one(i, k) = entry(i, k) * decay(m) * decay(m);
    rings.inner.push_back(one);
    rings.outer.push_back(m < chock ? Eigen::MatrixXd(0 * one) : one);
  }
  const auto mixed = [&](int first) {
    const int harmonics = chock - first;
    Eigen::MatrixXd all(harmonics * size, harmonics * size);
    for (int i = 0; i < all.rows(); ++i)
      for (int k = 0; k < all.cols(); ++k)
        all(i, k) = entry(i % size, k % size) * decay(first + i / size) * decay(first + k / size) *
                    std::pow(0.3, std::abs(i / size - k / size));
    return all;
  };
  rings.chock_cosine = mixed(0);
  rings.chock_sine   = mixed(1);
  return rings;
}
}  // namespace mill::verify
