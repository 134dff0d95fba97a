// Compiled for every x86-64, with neither other headers of this tree nor templates of the library, whose instances
// other files may have made for a newer processor: it runs before anything else of the program.
#include "app/process/processor.h"
#include <cstring>
#include <unistd.h>

#if defined(__x86_64__)
namespace mill {
namespace {
struct Feature {
  const char *name;
  int present;
};

void say(const char *words)
{
  if (write(STDERR_FILENO, words, std::strlen(words)) < 0)
    _exit(1);
}

void end_on_an_older_processor()
{
  __builtin_cpu_init();
  const Feature features[]{
      {"sse4.2", __builtin_cpu_supports("sse4.2")},     {"popcnt", __builtin_cpu_supports("popcnt")},
      {"avx", __builtin_cpu_supports("avx")},           {"avx2", __builtin_cpu_supports("avx2")},
      {"fma", __builtin_cpu_supports("fma")},           {"bmi2", __builtin_cpu_supports("bmi2")},
      {"avx512f", __builtin_cpu_supports("avx512f")},   {"avx512vl", __builtin_cpu_supports("avx512vl")},
      {"avx512dq", __builtin_cpu_supports("avx512dq")}, {"avx512bw", __builtin_cpu_supports("avx512bw")}};
  const char *between = "error: this program was built for a newer processor; this one lacks ";
  bool missing        = false;
  unsigned bit        = 1;
  for (const Feature &feature : features) {
    if ((compiled_features & bit) != 0 && feature.present == 0) {
      say(between);
      say(feature.name);
      between = ", ";
      missing = true;
    }
    bit <<= 1;
  }
  if (!missing)
    return;
  say("; packages need a processor of 2009 or later (x86-64-v2), a build on this machine fits it "
      "(scripts/build)\n");
  _exit(3);
}

// Before the constructors of the program's own objects and before the check of the address space
// (address_space.cpp), which may already use what is missing; this object is linked before that one.
__attribute__((section(".preinit_array"), used)) void (*const before_all)() = &end_on_an_older_processor;
}  // namespace
}  // namespace mill
#endif
