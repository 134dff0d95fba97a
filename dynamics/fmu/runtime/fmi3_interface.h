#pragma once
#include "exported.h"
#include <cstddef>
#include <cstdint>

// The binary interface of FMI 3.0 as far as an FMU implements it: our own declaration of the types that the
// standard names.
extern "C" {
using fmi3Instance            = void *;
using fmi3InstanceEnvironment = void *;
using fmi3FMUState            = void *;
using fmi3ValueReference      = std::uint32_t;
using fmi3Float32             = float;
using fmi3Float64             = double;
using fmi3Int8                = std::int8_t;
using fmi3UInt8               = std::uint8_t;
using fmi3Int16               = std::int16_t;
using fmi3UInt16              = std::uint16_t;
using fmi3Int32               = std::int32_t;
using fmi3UInt32              = std::uint32_t;
using fmi3Int64               = std::int64_t;
using fmi3UInt64              = std::uint64_t;
using fmi3Boolean             = bool;
using fmi3Clock               = bool;
using fmi3Char                = char;
using fmi3String              = const char *;
using fmi3Byte                = std::uint8_t;
using fmi3Binary              = const std::uint8_t *;

enum fmi3Status { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal };
enum fmi3DependencyKind { fmi3Independent, fmi3Constant, fmi3Fixed, fmi3Tunable, fmi3Discrete, fmi3Dependent };
enum fmi3IntervalQualifier { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged };

using fmi3LogMessageCallback         = void (*)(fmi3InstanceEnvironment environment, fmi3Status status,
                                        fmi3String category, fmi3String message);
using fmi3ClockUpdateCallback        = void (*)(fmi3InstanceEnvironment environment);
using fmi3IntermediateUpdateCallback = void (*)(fmi3InstanceEnvironment environment, fmi3Float64 time,
                                                fmi3Boolean set_requested, fmi3Boolean get_allowed,
                                                fmi3Boolean step_finished, fmi3Boolean can_return_early,
                                                fmi3Boolean *early_return_requested,
                                                fmi3Float64 *early_return_time);
using fmi3LockPreemptionCallback     = void (*)();
using fmi3UnlockPreemptionCallback   = void (*)();

MILL_FMU_EXPORT fmi3String fmi3GetVersion();
MILL_FMU_EXPORT fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resource_path, fmi3Boolean, fmi3Boolean logging,
    fmi3Boolean event_mode, fmi3Boolean, const fmi3ValueReference intermediate[], std::size_t n_intermediate,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback message, fmi3IntermediateUpdateCallback update);
MILL_FMU_EXPORT void fmi3FreeInstance(fmi3Instance i);
MILL_FMU_EXPORT fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, std::size_t n,
                                               const fmi3String categories[]);
MILL_FMU_EXPORT fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean, fmi3Float64,
                                                       fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop);
MILL_FMU_EXPORT fmi3Status fmi3ExitInitializationMode(fmi3Instance instance);
MILL_FMU_EXPORT fmi3Status fmi3Terminate(fmi3Instance instance);
MILL_FMU_EXPORT fmi3Status fmi3Reset(fmi3Instance instance);
MILL_FMU_EXPORT fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference vr[], std::size_t n,
                                          fmi3Float64 values[], std::size_t n_values);
MILL_FMU_EXPORT fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference vr[], std::size_t n,
                                          const fmi3Float64 values[], std::size_t n_values);
MILL_FMU_EXPORT fmi3Status fmi3GetBoolean(fmi3Instance instance, const fmi3ValueReference vr[], std::size_t n,
                                          fmi3Boolean values[], std::size_t n_values);
MILL_FMU_EXPORT fmi3Status fmi3SetBoolean(fmi3Instance instance, const fmi3ValueReference vr[], std::size_t n,
                                          const fmi3Boolean values[], std::size_t n_values);
MILL_FMU_EXPORT fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *state);
MILL_FMU_EXPORT fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state);
MILL_FMU_EXPORT fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *state);
MILL_FMU_EXPORT fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state,
                                                      std::size_t *size);
MILL_FMU_EXPORT fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[],
                                                 std::size_t size);
MILL_FMU_EXPORT fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], std::size_t size,
                                                   fmi3FMUState *state);
MILL_FMU_EXPORT fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                                        std::size_t n_unknowns, const fmi3ValueReference knowns[],
                                                        std::size_t n_knowns, const fmi3Float64 seed[],
                                                        std::size_t n_seed, fmi3Float64 sensitivity[],
                                                        std::size_t n_sensitivity);
MILL_FMU_EXPORT fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                                    std::size_t n_unknowns, const fmi3ValueReference knowns[],
                                                    std::size_t n_knowns, const fmi3Float64 seed[],
                                                    std::size_t n_seed, fmi3Float64 sensitivity[],
                                                    std::size_t n_sensitivity);
MILL_FMU_EXPORT fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference vr[],
                                                    std::size_t n, const fmi3Int32 orders[], fmi3Float64 values[],
                                                    std::size_t n_values);
MILL_FMU_EXPORT fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 from, fmi3Float64 length, fmi3Boolean,
                                      fmi3Boolean *event_needed, fmi3Boolean *terminate, fmi3Boolean *early,
                                      fmi3Float64 *last_time);
MILL_FMU_EXPORT fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                                          fmi3Boolean, fmi3InstanceEnvironment environment,
                                                          fmi3LogMessageCallback message);
MILL_FMU_EXPORT fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                                               fmi3Boolean, fmi3InstanceEnvironment environment,
                                                               fmi3LogMessageCallback message,
                                                               fmi3ClockUpdateCallback, fmi3LockPreemptionCallback,
                                                               fmi3UnlockPreemptionCallback);
MILL_FMU_EXPORT fmi3Status fmi3GetFloat32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                          fmi3Float32[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3SetFloat32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                          const fmi3Float32[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetInt8(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3Int8[],
                                       std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3SetInt8(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                       const fmi3Int8[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetUInt8(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3UInt8[],
                                        std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3SetUInt8(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                        const fmi3UInt8[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetInt16(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3Int16[],
                                        std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3SetInt16(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                        const fmi3Int16[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetUInt16(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                         fmi3UInt16[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3SetUInt16(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                         const fmi3UInt16[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetInt32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3Int32[],
                                        std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3SetInt32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                        const fmi3Int32[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetUInt32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                         fmi3UInt32[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3SetUInt32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                         const fmi3UInt32[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetInt64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3Int64[],
                                        std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3SetInt64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                        const fmi3Int64[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetUInt64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                         fmi3UInt64[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3SetUInt64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                         const fmi3UInt64[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetString(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                         fmi3String[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3SetString(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                         const fmi3String[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetBinary(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                         std::size_t[], fmi3Binary[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3SetBinary(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                         const std::size_t[], const fmi3Binary[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetClock(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3Clock[]);
MILL_FMU_EXPORT fmi3Status fmi3SetClock(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                        const fmi3Clock[]);
MILL_FMU_EXPORT fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance i, fmi3ValueReference, std::size_t *);
MILL_FMU_EXPORT fmi3Status fmi3GetVariableDependencies(fmi3Instance i, fmi3ValueReference, std::size_t[],
                                                       fmi3ValueReference[], std::size_t[], fmi3DependencyKind[],
                                                       std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3EnterConfigurationMode(fmi3Instance i);
MILL_FMU_EXPORT fmi3Status fmi3ExitConfigurationMode(fmi3Instance i);
MILL_FMU_EXPORT fmi3Status fmi3EnterEventMode(fmi3Instance i);
MILL_FMU_EXPORT fmi3Status fmi3EnterStepMode(fmi3Instance i);
MILL_FMU_EXPORT fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance i);
MILL_FMU_EXPORT fmi3Status fmi3UpdateDiscreteStates(fmi3Instance i, fmi3Boolean *, fmi3Boolean *, fmi3Boolean *,
                                                    fmi3Boolean *, fmi3Boolean *, fmi3Float64 *);
MILL_FMU_EXPORT fmi3Status fmi3GetIntervalDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                                  fmi3Float64[], fmi3IntervalQualifier[]);
MILL_FMU_EXPORT fmi3Status fmi3GetIntervalFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                                   fmi3UInt64[], fmi3UInt64[], fmi3IntervalQualifier[]);
MILL_FMU_EXPORT fmi3Status fmi3GetShiftDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                               fmi3Float64[]);
MILL_FMU_EXPORT fmi3Status fmi3GetShiftFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                                fmi3UInt64[], fmi3UInt64[]);
MILL_FMU_EXPORT fmi3Status fmi3SetIntervalDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                                  const fmi3Float64[]);
MILL_FMU_EXPORT fmi3Status fmi3SetIntervalFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                                   const fmi3UInt64[], const fmi3UInt64[]);
MILL_FMU_EXPORT fmi3Status fmi3SetShiftDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                               const fmi3Float64[]);
MILL_FMU_EXPORT fmi3Status fmi3SetShiftFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                                const fmi3UInt64[], const fmi3UInt64[]);
MILL_FMU_EXPORT fmi3Status fmi3ActivateModelPartition(fmi3Instance i, fmi3ValueReference, fmi3Float64);
MILL_FMU_EXPORT fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance i);
MILL_FMU_EXPORT fmi3Status fmi3CompletedIntegratorStep(fmi3Instance i, fmi3Boolean, fmi3Boolean *, fmi3Boolean *);
MILL_FMU_EXPORT fmi3Status fmi3SetTime(fmi3Instance i, fmi3Float64);
MILL_FMU_EXPORT fmi3Status fmi3SetContinuousStates(fmi3Instance i, const fmi3Float64[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance i, fmi3Float64[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetEventIndicators(fmi3Instance i, fmi3Float64[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetContinuousStates(fmi3Instance i, fmi3Float64[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance i, fmi3Float64[], std::size_t);
MILL_FMU_EXPORT fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance i, std::size_t *);
MILL_FMU_EXPORT fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance i, std::size_t *);
}
