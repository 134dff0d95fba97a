// Lets the library for Linux load with glibc 2.31, although it is built with a newer one.
//
// The static libstdc++ and libgcc of a newer system ask for functions that an older glibc does not have or has in
// another library (libpthread).  Their replacements here are hidden in the library of a unit.  This file does not
// travel with the sources: a unit that is built elsewhere is built for the glibc of that place.
#if defined(__linux__) && defined(__x86_64__)
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <cstdint>
#include <features.h>
#include <link.h>
#include <sched.h>

extern "C" {
/// Says whether the process has one thread alone; no is always safe.
char __libc_single_threaded = 0;

/// The address alone is looked at: it says that there may be threads.
int __pthread_key_create(unsigned *, void (*)(void *))
{
  return -1;
}

/// Runs a function once; other threads wait until it has ended.
int pthread_once(int *control, void (*function)())
{
  constexpr int running = 1, done = 2;
  int before = 0;
  if (__atomic_compare_exchange_n(control, &before, running, false, __ATOMIC_ACQUIRE, __ATOMIC_ACQUIRE)) {
    function();
    __atomic_store_n(control, done, __ATOMIC_RELEASE);
    return 0;
  }
  while (__atomic_load_n(control, __ATOMIC_ACQUIRE) != done)
    sched_yield();
  return 0;
}

#if __GLIBC_PREREQ(2, 35)
struct ObjectSearch {
  std::uintptr_t address;
  dl_find_object *result;
};

static int object_holds(dl_phdr_info *object, std::size_t, void *data)
{
  auto &search         = *static_cast<ObjectSearch *>(data);
  bool inside          = false;
  void *table          = nullptr;
  std::uintptr_t begin = 0, end = 0;
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto &segment       = object->dlpi_phdr[i];
    const std::uintptr_t from = object->dlpi_addr + segment.p_vaddr;
    if (segment.p_type == PT_LOAD && search.address >= from && search.address < from + segment.p_memsz) {
      inside = true;
      begin  = from;
      end    = from + segment.p_memsz;
    } else if (segment.p_type == PT_GNU_EH_FRAME)
      table = reinterpret_cast<void *>(from);
  }
  if (!inside || !table)
    return 0;
  *search.result                = {};
  search.result->dlfo_map_start = reinterpret_cast<void *>(begin);
  search.result->dlfo_map_end   = reinterpret_cast<void *>(end);
  search.result->dlfo_eh_frame  = table;
  return 1;
}

/// Finds the unwind table of the code at an address; 0 when it is found, as the function of glibc.
int _dl_find_object(void *address, struct dl_find_object *result) noexcept
{
  ObjectSearch search{reinterpret_cast<std::uintptr_t>(address), result};
  return dl_iterate_phdr(object_holds, &search) == 1 ? 0 : -1;
}
#endif

/// hypot() with the version that every glibc has; the linker sends the calls here (--wrap=hypot).
double first_hypot(double, double);
__asm__(".symver first_hypot, hypot@GLIBC_2.2.5");
double __wrap_hypot(const double x, const double y)
{
  return first_hypot(x, y);
}
}
#endif
