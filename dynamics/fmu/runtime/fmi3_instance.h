#pragma once
#include "c_boundary.h"
#include "fmi3_interface.h"

namespace mill::fmu {
/// An instance with what FMI 3 adds: a callback in the middle of a step.
struct Fmi3Instance : Instance {
  using Instance::Instance;
  fmi3InstanceEnvironment environment = nullptr;
  fmi3IntermediateUpdateCallback intermediate_update =
      nullptr;  ///< only where the client asked for the bite force
  bool early_return_allowed = false;
};

template <class Call> fmi3Status call3(fmi3Instance i, const char *function, const Call &what)
{
  return fmi3Status(guarded(i, function, what));
}
}  // namespace mill::fmu
