#include "fmi3_instance.h"
#include <string>

// The functions of FMI 3.0 that this model does not use: types, clocks and other kinds of FMU.  The standard wants
// all of them; their messages say why they refuse.
using namespace mill::fmu;

namespace {
fmi3Status no_variables(fmi3Instance instance, const char *function, const fmi3ValueReference vr[],
                        const std::size_t n, const char *type)
{
  return call3(instance, function, [&](Instance &i) { return i.refuse_type(function, vr, n, type); });
}

fmi3Status refused(fmi3Instance instance, const char *function, const char *why)
{
  return call3(instance, function,
               [&](Instance &i) { return i.log().refuse(Status::error, std::string(function) + ": " + why); });
}

constexpr const char *no_model_exchange = "this FMU is for co-simulation only, not for model exchange";
constexpr const char *no_clocks         = "this FMU has no clocks";
constexpr const char *no_events         = "this FMU has no event mode (hasEventMode)";
constexpr const char *no_configuration  = "this FMU has no structural parameters";
constexpr const char *no_elements       = "dependencies of single elements are not provided";

void refuse_kind(fmi3InstanceEnvironment environment, fmi3LogMessageCallback message, const bool logging,
                 const char *text)
{
  if (message && logging)
    message(environment, fmi3Error, "logStatusError", text);
}
}  // namespace

fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean logging,
                                          fmi3InstanceEnvironment environment, fmi3LogMessageCallback message)
{
  refuse_kind(environment, message, logging, "fmi3InstantiateModelExchange: this FMU is for co-simulation only");
  return nullptr;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                               fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                               fmi3LogMessageCallback message, fmi3ClockUpdateCallback,
                                               fmi3LockPreemptionCallback, fmi3UnlockPreemptionCallback)
{
  refuse_kind(environment, message, logging,
              "fmi3InstantiateScheduledExecution: this FMU is for co-simulation only");
  return nullptr;
}

// Types without a variable.
fmi3Status fmi3GetFloat32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3Float32[], std::size_t)
{
  return no_variables(i, "fmi3GetFloat32", vr, n, "Float32");
}
fmi3Status fmi3SetFloat32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, const fmi3Float32[],
                          std::size_t)
{
  return no_variables(i, "fmi3SetFloat32", vr, n, "Float32");
}
fmi3Status fmi3GetInt8(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3Int8[], std::size_t)
{
  return no_variables(i, "fmi3GetInt8", vr, n, "Int8");
}
fmi3Status fmi3SetInt8(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, const fmi3Int8[], std::size_t)
{
  return no_variables(i, "fmi3SetInt8", vr, n, "Int8");
}
fmi3Status fmi3GetUInt8(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3UInt8[], std::size_t)
{
  return no_variables(i, "fmi3GetUInt8", vr, n, "UInt8");
}
fmi3Status fmi3SetUInt8(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, const fmi3UInt8[],
                        std::size_t)
{
  return no_variables(i, "fmi3SetUInt8", vr, n, "UInt8");
}
fmi3Status fmi3GetInt16(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3Int16[], std::size_t)
{
  return no_variables(i, "fmi3GetInt16", vr, n, "Int16");
}
fmi3Status fmi3SetInt16(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, const fmi3Int16[],
                        std::size_t)
{
  return no_variables(i, "fmi3SetInt16", vr, n, "Int16");
}
fmi3Status fmi3GetUInt16(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3UInt16[], std::size_t)
{
  return no_variables(i, "fmi3GetUInt16", vr, n, "UInt16");
}
fmi3Status fmi3SetUInt16(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, const fmi3UInt16[],
                         std::size_t)
{
  return no_variables(i, "fmi3SetUInt16", vr, n, "UInt16");
}
fmi3Status fmi3GetUInt32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3UInt32[], std::size_t)
{
  return no_variables(i, "fmi3GetUInt32", vr, n, "UInt32");
}
fmi3Status fmi3SetUInt32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, const fmi3UInt32[],
                         std::size_t)
{
  return no_variables(i, "fmi3SetUInt32", vr, n, "UInt32");
}
fmi3Status fmi3GetInt64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3Int64[], std::size_t)
{
  return no_variables(i, "fmi3GetInt64", vr, n, "Int64");
}
fmi3Status fmi3SetInt64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, const fmi3Int64[],
                        std::size_t)
{
  return no_variables(i, "fmi3SetInt64", vr, n, "Int64");
}
fmi3Status fmi3GetUInt64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3UInt64[], std::size_t)
{
  return no_variables(i, "fmi3GetUInt64", vr, n, "UInt64");
}
fmi3Status fmi3SetUInt64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, const fmi3UInt64[],
                         std::size_t)
{
  return no_variables(i, "fmi3SetUInt64", vr, n, "UInt64");
}
fmi3Status fmi3GetString(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3String[], std::size_t)
{
  return no_variables(i, "fmi3GetString", vr, n, "String");
}
fmi3Status fmi3SetString(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, const fmi3String[],
                         std::size_t)
{
  return no_variables(i, "fmi3SetString", vr, n, "String");
}
fmi3Status fmi3GetBinary(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, std::size_t[], fmi3Binary[],
                         std::size_t)
{
  return no_variables(i, "fmi3GetBinary", vr, n, "Binary");
}
fmi3Status fmi3SetBinary(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, const std::size_t[],
                         const fmi3Binary[], std::size_t)
{
  return no_variables(i, "fmi3SetBinary", vr, n, "Binary");
}
fmi3Status fmi3GetClock(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3Clock[])
{
  return no_variables(i, "fmi3GetClock", vr, n, "Clock");
}
fmi3Status fmi3SetClock(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, const fmi3Clock[])
{
  return no_variables(i, "fmi3SetClock", vr, n, "Clock");
}

// Dependencies of elements, configuration, events.
fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance i, fmi3ValueReference, std::size_t *)
{
  return refused(i, "fmi3GetNumberOfVariableDependencies", no_elements);
}
fmi3Status fmi3GetVariableDependencies(fmi3Instance i, fmi3ValueReference, std::size_t[], fmi3ValueReference[],
                                       std::size_t[], fmi3DependencyKind[], std::size_t)
{
  return refused(i, "fmi3GetVariableDependencies", no_elements);
}
fmi3Status fmi3EnterConfigurationMode(fmi3Instance i)
{
  return refused(i, "fmi3EnterConfigurationMode", no_configuration);
}
fmi3Status fmi3ExitConfigurationMode(fmi3Instance i)
{
  return refused(i, "fmi3ExitConfigurationMode", no_configuration);
}
fmi3Status fmi3EnterEventMode(fmi3Instance i)
{
  return refused(i, "fmi3EnterEventMode", no_events);
}
fmi3Status fmi3EnterStepMode(fmi3Instance i)
{
  return refused(i, "fmi3EnterStepMode", no_events);
}
fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance i)
{
  return refused(i, "fmi3EvaluateDiscreteStates", no_events);
}
fmi3Status fmi3UpdateDiscreteStates(fmi3Instance i, fmi3Boolean *, fmi3Boolean *, fmi3Boolean *, fmi3Boolean *,
                                    fmi3Boolean *, fmi3Float64 *)
{
  return refused(i, "fmi3UpdateDiscreteStates", no_events);
}

// Clocks.
fmi3Status fmi3GetIntervalDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t, fmi3Float64[],
                                  fmi3IntervalQualifier[])
{
  return refused(i, "fmi3GetIntervalDecimal", no_clocks);
}
fmi3Status fmi3GetIntervalFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t, fmi3UInt64[],
                                   fmi3UInt64[], fmi3IntervalQualifier[])
{
  return refused(i, "fmi3GetIntervalFraction", no_clocks);
}
fmi3Status fmi3GetShiftDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t, fmi3Float64[])
{
  return refused(i, "fmi3GetShiftDecimal", no_clocks);
}
fmi3Status fmi3GetShiftFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t, fmi3UInt64[],
                                fmi3UInt64[])
{
  return refused(i, "fmi3GetShiftFraction", no_clocks);
}
fmi3Status fmi3SetIntervalDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3Float64[])
{
  return refused(i, "fmi3SetIntervalDecimal", no_clocks);
}
fmi3Status fmi3SetIntervalFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3UInt64[],
                                   const fmi3UInt64[])
{
  return refused(i, "fmi3SetIntervalFraction", no_clocks);
}
fmi3Status fmi3SetShiftDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3Float64[])
{
  return refused(i, "fmi3SetShiftDecimal", no_clocks);
}
fmi3Status fmi3SetShiftFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3UInt64[],
                                const fmi3UInt64[])
{
  return refused(i, "fmi3SetShiftFraction", no_clocks);
}
fmi3Status fmi3ActivateModelPartition(fmi3Instance i, fmi3ValueReference, fmi3Float64)
{
  return refused(i, "fmi3ActivateModelPartition", no_clocks);
}

// Model exchange.
fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance i)
{
  return refused(i, "fmi3EnterContinuousTimeMode", no_model_exchange);
}
fmi3Status fmi3CompletedIntegratorStep(fmi3Instance i, fmi3Boolean, fmi3Boolean *, fmi3Boolean *)
{
  return refused(i, "fmi3CompletedIntegratorStep", no_model_exchange);
}
fmi3Status fmi3SetTime(fmi3Instance i, fmi3Float64)
{
  return refused(i, "fmi3SetTime", no_model_exchange);
}
fmi3Status fmi3SetContinuousStates(fmi3Instance i, const fmi3Float64[], std::size_t)
{
  return refused(i, "fmi3SetContinuousStates", no_model_exchange);
}
fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance i, fmi3Float64[], std::size_t)
{
  return refused(i, "fmi3GetContinuousStateDerivatives", no_model_exchange);
}
fmi3Status fmi3GetEventIndicators(fmi3Instance i, fmi3Float64[], std::size_t)
{
  return refused(i, "fmi3GetEventIndicators", no_model_exchange);
}
fmi3Status fmi3GetContinuousStates(fmi3Instance i, fmi3Float64[], std::size_t)
{
  return refused(i, "fmi3GetContinuousStates", no_model_exchange);
}
fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance i, fmi3Float64[], std::size_t)
{
  return refused(i, "fmi3GetNominalsOfContinuousStates", no_model_exchange);
}
fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance i, std::size_t *)
{
  return refused(i, "fmi3GetNumberOfEventIndicators", no_model_exchange);
}
fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance i, std::size_t *)
{
  return refused(i, "fmi3GetNumberOfContinuousStates", no_model_exchange);
}
