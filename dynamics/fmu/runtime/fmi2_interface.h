#pragma once
#include "exported.h"
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

MILL_FMU_EXPORT fmi2String fmi2GetTypesPlatform();
MILL_FMU_EXPORT fmi2String fmi2GetVersion();
MILL_FMU_EXPORT fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String location,
                                              const fmi2CallbackFunctions *functions, fmi2Boolean,
                                              fmi2Boolean logging);
MILL_FMU_EXPORT void fmi2FreeInstance(fmi2Component c);
MILL_FMU_EXPORT fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, std::size_t n,
                                               const fmi2String categories[]);
MILL_FMU_EXPORT fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean, fmi2Real, fmi2Real start,
                                               fmi2Boolean has_stop, fmi2Real stop);
MILL_FMU_EXPORT fmi2Status fmi2EnterInitializationMode(fmi2Component c);
MILL_FMU_EXPORT fmi2Status fmi2ExitInitializationMode(fmi2Component c);
MILL_FMU_EXPORT fmi2Status fmi2Terminate(fmi2Component c);
MILL_FMU_EXPORT fmi2Status fmi2Reset(fmi2Component c);
MILL_FMU_EXPORT fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                                       fmi2Real value[]);
MILL_FMU_EXPORT fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                                          fmi2Integer[]);
MILL_FMU_EXPORT fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                                          fmi2Boolean value[]);
MILL_FMU_EXPORT fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                                         fmi2String[]);
MILL_FMU_EXPORT fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                                       const fmi2Real value[]);
MILL_FMU_EXPORT fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                                          const fmi2Integer[]);
MILL_FMU_EXPORT fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                                          const fmi2Boolean value[]);
MILL_FMU_EXPORT fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                                         const fmi2String[]);
MILL_FMU_EXPORT fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state);
MILL_FMU_EXPORT fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state);
MILL_FMU_EXPORT fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state);
MILL_FMU_EXPORT fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, std::size_t *size);
MILL_FMU_EXPORT fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[],
                                                 std::size_t size);
MILL_FMU_EXPORT fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], std::size_t size,
                                                   fmi2FMUstate *state);
MILL_FMU_EXPORT fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[],
                                                        std::size_t n_unknown, const fmi2ValueReference known[],
                                                        std::size_t n_known, const fmi2Real seed[],
                                                        fmi2Real result[]);
MILL_FMU_EXPORT fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[],
                                                       std::size_t n, const fmi2Integer order[],
                                                       const fmi2Real value[]);
MILL_FMU_EXPORT fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[],
                                                        std::size_t n, const fmi2Integer order[],
                                                        fmi2Real value[]);
MILL_FMU_EXPORT fmi2Status fmi2DoStep(fmi2Component c, fmi2Real from, fmi2Real length, fmi2Boolean);
MILL_FMU_EXPORT fmi2Status fmi2CancelStep(fmi2Component c);
MILL_FMU_EXPORT fmi2Status fmi2GetStatus(fmi2Component c, fmi2StatusKind, fmi2Status *);
MILL_FMU_EXPORT fmi2Status fmi2GetRealStatus(fmi2Component c, fmi2StatusKind kind, fmi2Real *value);
MILL_FMU_EXPORT fmi2Status fmi2GetIntegerStatus(fmi2Component c, fmi2StatusKind, fmi2Integer *);
MILL_FMU_EXPORT fmi2Status fmi2GetBooleanStatus(fmi2Component c, fmi2StatusKind kind, fmi2Boolean *value);
MILL_FMU_EXPORT fmi2Status fmi2GetStringStatus(fmi2Component c, fmi2StatusKind, fmi2String *);
}
