#pragma once
#include "core/base/each_member.h"
#include <limits>

namespace mill {
constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// Elastic solid.
struct Material {
  double youngs_modulus = 210e9;      ///< Pa
  double poisson_ratio  = 0.28;       ///< -
  double density        = 7700;       ///< kg/m3
  double yield_stress   = not_given;  ///< Pa, of the rolls' surface
};

// The yield stress is compared with pressures after they are computed.
template <class Io, class R, if_record<R, Material> = 0> void each_member(Io &&io, R &record)
{
  auto &[youngs_modulus, poisson_ratio, density, yield_stress] = record;
  io("youngs_modulus", youngs_modulus);
  io("poisson_ratio", poisson_ratio);
  io("density", density);
}

/// What of a material a body at rest has; for keys of static stages.
struct ElasticConstants {
  double youngs_modulus = 0;  ///< Pa
  double poisson_ratio  = 0;  ///< -
};

inline ElasticConstants at_rest(const Material &material)
{
  return {material.youngs_modulus, material.poisson_ratio};
}

template <class Io> void each_member(Io &&io, const ElasticConstants &record)
{
  const auto &[youngs_modulus, poisson_ratio] = record;
  io("youngs_modulus", youngs_modulus);
  io("poisson_ratio", poisson_ratio);
}
}  // namespace mill
