#include "app/process/address_space.h"
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <future>
#include <malloc.h>
#include <sched.h>
#include <sys/resource.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

namespace mill {
namespace {
constexpr std::size_t MB               = 1u << 20;
constexpr std::size_t buffer           = 129 * MB;  // of OpenBLAS: 32 << 22 bytes and a page (its common_x86_64.h)
constexpr std::size_t program_size     = 96 * MB;  // what libraries and program take before the first large matrix
constexpr std::size_t work             = 1024 * MB;  // room for matrices that is worth more than a second thread
constexpr const char *threads_variable = "OMP_NUM_THREADS";

// Filled before any library runs; zero: the address space is not limited.
std::size_t allowed = 0, mapped = 0;

std::size_t needed(const int threads)
{
  return mapped + (threads > 1 ? work : program_size) + 2 * std::size_t(threads) * buffer;
}

std::size_t mapped_now()
{
  char text[64]  = {};
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0)
    return 0;
  const ssize_t n = ::read(file, text, sizeof text - 1);
  ::close(file);
  return n > 0 ? std::strtoul(text, nullptr, 10) * std::size_t(::sysconf(_SC_PAGESIZE)) : 0;
}

const char *value_in(char **environment, const char *name)
{
  const std::size_t length = std::strlen(name);
  for (; environment && *environment; ++environment)
    if (std::strncmp(*environment, name, length) == 0 && (*environment)[length] == '=')
      return *environment + length + 1;
  return nullptr;
}

int threads_at_start(char **environment)
{
  const char *asked = value_in(environment, threads_variable);
  if (const int n = asked ? std::atoi(asked) : 0; n > 0)
    return n;
  cpu_set_t processors;
  return ::sched_getaffinity(0, sizeof processors, &processors) == 0 ? CPU_COUNT(&processors) : 1;
}

[[noreturn]] void refuse()
{
  char text[400];
  const int n =
      std::snprintf(text, sizeof text,
                    "out of memory: %zu MB of address space are allowed (ulimit -v), at least %zu MB are "
                    "needed\n  where         at the start: %zu MB for the libraries, %zu MB for the BLAS with "
                    "one thread, %zu MB for the rest\n  change        a higher limit\n",
                    allowed / MB, needed(1) / MB, mapped / MB, 2 * buffer / MB, program_size / MB);
  if (::write(STDERR_FILENO, text, std::size_t(std::max(0, n))) < 0)
    ::_exit(3);  // the output is closed; the exit code is the same
  ::_exit(3);
}

// The program again with as many threads as fit; returns only when that fails.
void start_again(char **arguments, char **environment, const int threads)
{
  static char setting[64];
  static char *changed[4096];
  std::snprintf(setting, sizeof setting, "%s=%d", threads_variable, threads);
  int n = 0;
  for (; environment && *environment && n < 4000; ++environment)
    if (std::strncmp(*environment, setting, std::strlen(threads_variable) + 1) != 0)
      changed[n++] = *environment;
  changed[n] = setting;
  ::execve("/proc/self/exe", arguments, changed);
}

// The stack grows on demand, and a demand that is refused is a signal.
__attribute__((noinline)) void touch_stack()
{
  volatile char room[2 * MB];
  for (std::size_t i = 0; i < sizeof room; i += 4096)
    room[i] = 0;
}
}  // namespace

void check_address_space(int, char **arguments, char **environment)
{
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return;
  mapped            = mapped_now();
  allowed           = limit.rlim_cur;
  const int started = threads_at_start(environment), fitting = threads_that_fit(started);
  if (needed(1) > allowed)
    refuse();
  if (fitting < started)
    start_again(arguments, environment, fitting);
}

int threads_that_fit(const int wanted)
{
  int n = std::max(1, wanted);
  while (allowed > 0 && n > 1 && needed(n) > allowed)
    --n;
  return n;
}

int threads_that_start(const int wanted)
{
  std::promise<void> all_started;
  const std::shared_future<void> release = all_started.get_future().share();
  std::vector<std::thread> others;
  others.reserve(std::size_t(std::max(0, wanted - 1)));
  try {
    while (int(others.size()) + 1 < wanted)
      others.emplace_back([release] { release.wait(); });
  } catch (const std::system_error &) {
    // so many and no more
  }
  all_started.set_value();
  for (std::thread &other : others)
    other.join();
  return 1 + int(others.size());
}

void reserve_address_space(const int threads)
{
  if (allowed == 0)
    return;
  ::mallopt(M_ARENA_MAX, 1);  // an arena for each thread would take 64 MB of address space
  touch_stack();
  const auto take = reinterpret_cast<void *(*)(int)>(::dlsym(RTLD_DEFAULT, "blas_memory_alloc"));
  const auto give = reinterpret_cast<void (*)(void *)>(::dlsym(RTLD_DEFAULT, "blas_memory_free"));
  if (!take || !give)
    return;  // another BLAS
  std::vector<void *> taken;
  for (int t = 0; t < threads; ++t)
    taken.push_back(take(0));
  for (void *one : taken)
    give(one);  // OpenBLAS keeps it mapped
}
}  // namespace mill
