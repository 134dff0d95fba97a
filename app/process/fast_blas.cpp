#include "app/process/fast_blas.h"
#include "core/numerics/sparse.h"
#include <cstdlib>
#include <unistd.h>

namespace mill {
void use_fast_blas(char **argv)
{
  constexpr const char *variable = "OPENBLAS_CORETYPE";
  if (argv == nullptr || std::getenv(variable) != nullptr)
    return;
  const char *kernels = fast_blas_kernels();
  if (kernels == nullptr || setenv(variable, kernels, 1) != 0)
    return;
  execv("/proc/self/exe", argv);  // returns only when it fails; then the slow kernels do
}
}  // namespace mill
