#pragma once

namespace mill {
/// OpenBLAS chooses its kernels when it is loaded and falls back to those of 2004 on a processor it does not know,
/// which costs a factor of four.  Starts the program again with the kernels that the instruction set allows,
/// unless OPENBLAS_CORETYPE already says which; returns when nothing is to be done.  Linking 200 libraries takes
/// 0.1 s each time, so only what computes with large matrices calls it, before it has any effect.
void use_fast_blas(char **argv);
}  // namespace mill
