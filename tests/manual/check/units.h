#pragma once
#include "core/model/material.h"
#include <cmath>

// Units and materials in which the problems of the manual are stated, in SI.
namespace mill::verify {
inline constexpr double mm = 1e-3, um = 1e-6;              ///< m
inline constexpr double kN       = 1e3;                    ///< N
inline constexpr double MPa      = 1e6;                    ///< Pa
inline constexpr double N_per_mm = 1e3, kN_per_mm = 1e6;   ///< N/m
inline constexpr double degree = M_PI / 180, mrad = 1e-3;  ///< rad
inline const Material steel{210e9, 0.3, 7850};
}  // namespace mill::verify
