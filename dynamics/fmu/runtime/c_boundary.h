#pragma once
#include "instance.h"
#include <exception>
#include <string>

// What both C interfaces need: no exception passes beyond them.
namespace mill::fmu {
/// Carries out a call on an instance, which may be null.  The message of an exception goes into the log, and the
/// instance has failed.
template <class Call> Status guarded(void *component, const char *function, const Call &call) noexcept
{
  if (!component)
    return Status::error;
  auto &instance = *static_cast<Instance *>(component);
  try {
    try {
      return call(instance);
    } catch (const std::exception &e) {
      instance.fail();
      return instance.log().refuse(Status::error, std::string(function) + ": " + e.what());
    }
  } catch (...) {  // not even the message fits into memory
    return Status::fatal;
  }
}
}  // namespace mill::fmu
