#include "tests/support/interrupted_folder.h"
#include <cerrno>
#include <dirent.h>
#include <dlfcn.h>

namespace {
bool interrupting = false, next_fails = false;
int failures = 0;

bool fails_now()
{
  next_fails = interrupting && !next_fails;
  failures += next_fails;
  return next_fails;
}

template <class Function> Function *of_the_system(const char *name)
{
  return reinterpret_cast<Function *>(dlsym(RTLD_NEXT, name));
}
}  // namespace

// In place of those of the C library, also for the C++ library.
extern "C" {
__attribute__((visibility("default"))) DIR *opendir(const char *name)
{
  static const auto opened = of_the_system<DIR *(const char *)>("opendir");
  if (!fails_now())
    return opened(name);
  errno = EINTR;
  return nullptr;
}

__attribute__((visibility("default"))) DIR *fdopendir(int file)
{
  static const auto opened = of_the_system<DIR *(int)>("fdopendir");
  if (!fails_now())
    return opened(file);
  errno = EINTR;
  return nullptr;
}
}

namespace interrupted_folder {
EachSecondCall::EachSecondCall()
{
  interrupting = true;
  next_fails   = false;
  failures     = 0;
}
EachSecondCall::~EachSecondCall()
{
  interrupting = false;
  next_fails   = false;
}
int EachSecondCall::failed() const
{
  return failures;
}
}  // namespace interrupted_folder
