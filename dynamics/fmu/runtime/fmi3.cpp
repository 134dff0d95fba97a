#include "fmi3_instance.h"
#include "resources.h"
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

// FMI 3.0 for co-simulation: the functions that do something.  fmi3_refused.cpp has those that this model does not
// use.
using namespace mill::fmu;

namespace {
class Fmi3Log : public Log {
public:
  Fmi3Log(fmi3InstanceEnvironment environment, fmi3LogMessageCallback message, const bool logging)
      : Log(logging ? Start::all : Start::nothing), environment_(environment), message_(message)
  {
  }

protected:
  void send(const Status status, const char *category, const std::string &message) const override
  {
    if (!message_)
      return;
    std::string text;  // #12# means the variable of reference 12
    for (const char c : message)
      text += c == '#' ? "##" : std::string(1, c);
    message_(environment_, fmi3Status(status), category, text.c_str());
  }

private:
  fmi3InstanceEnvironment environment_;
  fmi3LogMessageCallback message_;
};

// The client sets the force at the end of the step, so that it runs along a straight line.
void ask_for_force(Fmi3Instance &i, const double from, const double length)
{
  if (!i.intermediate_update)
    return;
  i.enter_intermediate();
  bool early        = false;
  double early_time = from + length;
  i.intermediate_update(i.environment, from + length, true, false, false, false, &early, &early_time);
  i.leave_intermediate(length);
}

bool counts_agree(Instance &i, const char *function, const std::size_t references, const std::size_t values)
{
  if (references == values)
    return true;
  i.log().refuse(Status::error, std::string(function) + ": " + std::to_string(references) + " variables and " +
                                    std::to_string(values) + " values; every variable is a scalar");
  return false;
}
}  // namespace

fmi3String fmi3GetVersion()
{
  return "3.0";
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resource_path, fmi3Boolean,
                                         fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference intermediate[], std::size_t n_intermediate,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback message,
                                         fmi3IntermediateUpdateCallback update)
{
  try {
    const Fmi3Log log(environment, message, logging);
    try {
      const char *wrong = !name || !*name ? "the instance has no name"
                          : !token        ? "the instantiation token is missing"
                          : event_mode ? "the client wants event mode, which this FMU does not have (hasEventMode)"
                          : !resource_path || !*resource_path
                              ? "the resource path is missing, the model is read from there"
                              : nullptr;
      if (wrong)
        throw std::runtime_error(wrong);
      auto instance =
          std::make_unique<Fmi3Instance>(folder_of_path(resource_path), token, std::make_unique<Fmi3Log>(log), 3);
      instance->environment          = environment;
      instance->early_return_allowed = early_return;
      for (std::size_t k = 0; update && intermediate && k < n_intermediate; ++k)
        if (intermediate[k] == Instance::bite_force) {
          instance->intermediate_update = update;
          instance->expect_force();
        }
      return static_cast<Instance *>(instance.release());
    } catch (const std::exception &e) {
      log.refuse(Status::error, std::string("fmi3InstantiateCoSimulation: ") + e.what());
    }
  } catch (...) {  // out of memory
  }
  return nullptr;
}

void fmi3FreeInstance(fmi3Instance i)
{
  delete static_cast<Fmi3Instance *>(static_cast<Instance *>(i));
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, std::size_t n, const fmi3String categories[])
{
  return call3(instance, "fmi3SetDebugLogging", [&](Instance &i) {
    std::vector<std::string> names;
    for (std::size_t k = 0; categories && k < n; ++k)
      names.push_back(categories[k] ? categories[k] : "");
    const std::string unknown = i.log().enable(on, names);
    return unknown.empty() ? Status::ok
                           : i.log().refuse(Status::error, "fmi3SetDebugLogging: there is no category " + unknown);
  });
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean, fmi3Float64, fmi3Float64 start,
                                       fmi3Boolean has_stop, fmi3Float64 stop)
{
  const char *function = "fmi3EnterInitializationMode";
  return call3(instance, function, [&](Instance &i) {
    const Status status = i.set_up(function, start, has_stop, stop);
    return status == Status::ok ? i.enter_initialization(function) : status;
  });
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
  return call3(instance, "fmi3ExitInitializationMode",
               [](Instance &i) { return i.exit_initialization("fmi3ExitInitializationMode"); });
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
  return call3(instance, "fmi3Terminate", [](Instance &i) { return i.terminate("fmi3Terminate"); });
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
  return call3(instance, "fmi3Reset", [](Instance &i) { return i.reset("fmi3Reset"); });
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference vr[], std::size_t n,
                          fmi3Float64 values[], std::size_t n_values)
{
  return call3(instance, "fmi3GetFloat64", [&](Instance &i) {
    return counts_agree(i, "fmi3GetFloat64", n, n_values) ? i.get("fmi3GetFloat64", vr, n, values) : Status::error;
  });
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference vr[], std::size_t n,
                          const fmi3Float64 values[], std::size_t n_values)
{
  return call3(instance, "fmi3SetFloat64", [&](Instance &i) {
    return counts_agree(i, "fmi3SetFloat64", n, n_values) ? i.set("fmi3SetFloat64", vr, n, values) : Status::error;
  });
}

fmi3Status fmi3GetBoolean(fmi3Instance instance, const fmi3ValueReference vr[], std::size_t n,
                          fmi3Boolean values[], std::size_t n_values)
{
  return call3(instance, "fmi3GetBoolean", [&](Instance &i) {
    return counts_agree(i, "fmi3GetBoolean", n, n_values) ? i.get_truth("fmi3GetBoolean", vr, n, values)
                                                          : Status::error;
  });
}

fmi3Status fmi3SetBoolean(fmi3Instance instance, const fmi3ValueReference vr[], std::size_t n,
                          const fmi3Boolean values[], std::size_t n_values)
{
  return call3(instance, "fmi3SetBoolean", [&](Instance &i) {
    return counts_agree(i, "fmi3SetBoolean", n, n_values) ? i.set_truth("fmi3SetBoolean", vr, n, values)
                                                          : Status::error;
  });
}

fmi3Status fmi3GetInt32(fmi3Instance instance, const fmi3ValueReference vr[], std::size_t n, fmi3Int32 values[],
                        std::size_t n_values)
{
  return call3(instance, "fmi3GetInt32", [&](Instance &i) {
    return counts_agree(i, "fmi3GetInt32", n, n_values) ? i.get_whole("fmi3GetInt32", vr, n, values)
                                                        : Status::error;
  });
}

fmi3Status fmi3SetInt32(fmi3Instance instance, const fmi3ValueReference vr[], std::size_t n, const fmi3Int32[],
                        std::size_t n_values)
{
  return call3(instance, "fmi3SetInt32", [&](Instance &i) {
    return counts_agree(i, "fmi3SetInt32", n, n_values) ? i.set_whole("fmi3SetInt32", vr, n) : Status::error;
  });
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *state)
{
  return call3(instance, "fmi3GetFMUState", [&](Instance &i) { return i.copy("fmi3GetFMUState", state); });
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state)
{
  return call3(instance, "fmi3SetFMUState", [&](Instance &i) { return i.restore("fmi3SetFMUState", state); });
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *state)
{
  return call3(instance, "fmi3FreeFMUState", [&](Instance &i) { return i.free_copy("fmi3FreeFMUState", state); });
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, std::size_t *size)
{
  return call3(instance, "fmi3SerializedFMUStateSize",
               [&](Instance &i) { return i.serialized_size("fmi3SerializedFMUStateSize", state, size); });
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[], std::size_t size)
{
  return call3(instance, "fmi3SerializeFMUState", [&](Instance &i) {
    return i.serialize("fmi3SerializeFMUState", state, reinterpret_cast<char *>(bytes), size);
  });
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], std::size_t size,
                                   fmi3FMUState *state)
{
  return call3(instance, "fmi3DeserializeFMUState", [&](Instance &i) {
    return i.deserialize("fmi3DeserializeFMUState", reinterpret_cast<const char *>(bytes), size, state);
  });
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                        std::size_t n_unknowns, const fmi3ValueReference knowns[],
                                        std::size_t n_knowns, const fmi3Float64 seed[], std::size_t n_seed,
                                        fmi3Float64 sensitivity[], std::size_t n_sensitivity)
{
  const char *function = "fmi3GetDirectionalDerivative";
  return call3(instance, function, [&](Instance &i) {
    if (!counts_agree(i, function, n_knowns, n_seed) || !counts_agree(i, function, n_unknowns, n_sensitivity))
      return Status::error;
    return i.derivative(function, {unknowns, n_unknowns, knowns, n_knowns, seed, sensitivity, false});
  });
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                    std::size_t n_unknowns, const fmi3ValueReference knowns[],
                                    std::size_t n_knowns, const fmi3Float64 seed[], std::size_t n_seed,
                                    fmi3Float64 sensitivity[], std::size_t n_sensitivity)
{
  const char *function = "fmi3GetAdjointDerivative";
  return call3(instance, function, [&](Instance &i) {
    if (!counts_agree(i, function, n_unknowns, n_seed) || !counts_agree(i, function, n_knowns, n_sensitivity))
      return Status::error;
    return i.derivative(function, {unknowns, n_unknowns, knowns, n_knowns, seed, sensitivity, true});
  });
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference vr[], std::size_t n,
                                    const fmi3Int32 orders[], fmi3Float64 values[], std::size_t n_values)
{
  const char *function = "fmi3GetOutputDerivatives";
  return call3(instance, function, [&](Instance &i) {
    return counts_agree(i, function, n, n_values) ? i.get_output_derivatives(function, vr, n, orders, values)
                                                  : Status::error;
  });
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 from, fmi3Float64 length, fmi3Boolean,
                      fmi3Boolean *event_needed, fmi3Boolean *terminate, fmi3Boolean *early,
                      fmi3Float64 *last_time)
{
  return call3(instance, "fmi3DoStep", [&](Instance &i) {
    for (fmi3Boolean *flag : {event_needed, terminate, early})
      if (flag)
        *flag = false;
    Status status = i.may_step("fmi3DoStep", from, length);
    if (status == Status::ok) {
      auto &instance = static_cast<Fmi3Instance &>(i);
      ask_for_force(instance, from, length);
      status           = i.do_step("fmi3DoStep", from, length);
      const bool ended = status == Status::ok && i.ended();
      if (terminate)
        *terminate = ended;
      if (early)
        *early = ended && instance.early_return_allowed;
    }
    if (last_time)
      *last_time = i.time();
    return status;
  });
}
