#pragma once
#include <cstddef>

// The binary interface of FMI 2.0, co-simulation, as far as an FMU implements it: our own declaration of the types
// that the standard names.
extern "C" {
using fmi2Real           = double;
using fmi2Integer        = int;
using fmi2Boolean        = int;
using fmi2Char           = char;
using fmi2String         = const char *;
using fmi2Byte           = char;
using fmi2ValueReference = unsigned int;
using fmi2Component      = void *;
using fmi2FMUstate       = void *;

enum fmi2Status { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending };
enum fmi2Type { fmi2ModelExchange, fmi2CoSimulation };
enum fmi2StatusKind { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated };

struct fmi2CallbackFunctions {
  void (*logger)(void *environment, fmi2String instance_name, fmi2Status status, fmi2String category,
                 fmi2String message, ...);
  void *(*allocateMemory)(std::size_t n, std::size_t size);
  void (*freeMemory)(void *memory);
  void (*stepFinished)(void *environment, fmi2Status status);
  void *componentEnvironment;
};
}
