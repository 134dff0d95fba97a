#pragma once
#include <Eigen/Core>

namespace mill {
/// How this file was compiled to align Eigen's vectors: of dynamic size, which also decides how they are
/// allocated, and of fixed size.  Two parts of a program that exchange vectors must agree, or one frees what it
/// cannot.
constexpr int vector_alignment = 1000 * EIGEN_DEFAULT_ALIGN_BYTES + EIGEN_MAX_STATIC_ALIGN_BYTES;
}  // namespace mill
