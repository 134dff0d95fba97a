#include "app/fast_blas.h"
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <unistd.h>

namespace mill {
void use_fast_blas(char **argv)
{
#if defined(__x86_64__)
  constexpr const char *variable = "OPENBLAS_CORETYPE";
  const auto core_name           = reinterpret_cast<char *(*)()>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  if (argv == nullptr || std::getenv(variable) != nullptr || core_name == nullptr ||
      std::strcmp(core_name(), "Prescott") != 0)
    return;
  const char *kernels = nullptr;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    kernels = "SkylakeX";
  else if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    kernels = "Haswell";
  if (kernels == nullptr || setenv(variable, kernels, 1) != 0)
    return;
  execv("/proc/self/exe", argv);  // returns only when it fails; then the slow kernels do
#else
  (void)argv;
#endif
}
}  // namespace mill
