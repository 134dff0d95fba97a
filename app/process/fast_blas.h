#pragma once

namespace mill {
/// Starts the program again with the kernels of OpenBLAS that the processor allows (fast_blas_kernels,
/// core/numerics/sparse.h), unless OPENBLAS_CORETYPE already says which; returns when nothing is to be done.
/// Linking 200 libraries takes 0.1 s each time, so only what computes with large matrices calls it, before it has
/// any effect.
void use_fast_blas(char **argv);
}  // namespace mill
