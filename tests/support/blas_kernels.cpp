// Prints the kernels that OpenBLAS must be given, or nothing (tests/fast_blas.cmake.in).
#include "core/numerics/sparse.h"
#include <cstdio>

int main()
{
  if (mill::blas_in_use() == "unknown")  // asked, so that the linker does not leave the BLAS out
    return 1;
  if (const char *kernels = mill::fast_blas_kernels())
    std::puts(kernels);
}
