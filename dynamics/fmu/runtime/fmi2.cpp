#include "c_boundary.h"
#include "fmi2_interface.h"
#include "resources.h"
#include <memory>
#include <string>
#include <vector>

// The 34 functions of FMI 2.0 for co-simulation.
using namespace mill::fmu;

namespace {
class Fmi2Log : public Log {
public:
  Fmi2Log(const fmi2CallbackFunctions &functions, std::string name, const bool others)
      : Log(others ? Start::all : Start::failures), functions_(functions), name_(std::move(name))
  {
  }

protected:
  // The message is a format to printf, in which #r12# means the variable of reference 12: both signs are doubled.
  void send(const Status status, const char *category, const std::string &message) const override
  {
    if (!functions_.logger)
      return;
    std::string text;
    for (const char c : message)
      text += c == '%' || c == '#' ? std::string(2, c) : std::string(1, c);
    functions_.logger(functions_.componentEnvironment, name_.c_str(), fmi2Status(status), category, text.c_str());
  }

private:
  fmi2CallbackFunctions functions_;
  std::string name_;
};

template <class Call> fmi2Status call(fmi2Component c, const char *function, const Call &what)
{
  return fmi2Status(guarded(c, function, what));
}

// A type or a call that this model does not have.
fmi2Status no_variables(fmi2Component c, const char *function, const fmi2ValueReference vr[], const std::size_t n,
                        const char *type)
{
  return call(c, function, [&](Instance &i) { return i.refuse_type(function, vr, n, type); });
}

fmi2Status discarded(fmi2Component c, const char *function, const char *why)
{
  return call(c, function,
              [&](Instance &i) { return i.log().refuse(Status::discard, std::string(function) + ": " + why); });
}
}  // namespace

fmi2String fmi2GetTypesPlatform()
{
  return "default";
}

fmi2String fmi2GetVersion()
{
  return "2.0";
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String location,
                              const fmi2CallbackFunctions *functions, fmi2Boolean, fmi2Boolean logging)
{
  try {
    if (!functions)
      return nullptr;
    auto log             = std::make_unique<Fmi2Log>(*functions, name ? name : "", logging != 0);
    const Log &first_log = *log;
    const char *wrong    = !name || !*name            ? "the instance has no name"
                           : type != fmi2CoSimulation ? "this FMU is for co-simulation only"
                           : !guid                    ? "the guid is missing"
                           : !location                ? "the resource location is missing"
                                                      : nullptr;
    try {
      if (wrong)
        throw std::runtime_error(wrong);
      const Fmi2Log kept = *log;  // for what is thrown while the instance that owns the other is made
      try {
        return new Instance(folder_of_uri(location), guid, std::move(log), 2);
      } catch (const std::exception &e) {
        kept.refuse(Status::error, std::string("fmi2Instantiate: ") + e.what());
      }
    } catch (const std::exception &e) {
      first_log.refuse(Status::error, std::string("fmi2Instantiate: ") + e.what());
    }
  } catch (...) {  // out of memory
  }
  return nullptr;
}

void fmi2FreeInstance(fmi2Component c)
{
  delete static_cast<Instance *>(c);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, std::size_t n, const fmi2String categories[])
{
  return call(c, "fmi2SetDebugLogging", [&](Instance &i) {
    std::vector<std::string> names;
    for (std::size_t k = 0; categories && k < n; ++k)
      names.push_back(categories[k] ? categories[k] : "");
    const std::string unknown = i.log().enable(on != 0, names);
    return unknown.empty() ? Status::ok
                           : i.log().refuse(Status::error, "fmi2SetDebugLogging: there is no category " + unknown);
  });
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean, fmi2Real, fmi2Real start, fmi2Boolean has_stop,
                               fmi2Real stop)
{
  return call(c, "fmi2SetupExperiment",
              [&](Instance &i) { return i.set_up("fmi2SetupExperiment", start, has_stop != 0, stop); });
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
  return call(c, "fmi2EnterInitializationMode",
              [](Instance &i) { return i.enter_initialization("fmi2EnterInitializationMode"); });
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
  return call(c, "fmi2ExitInitializationMode",
              [](Instance &i) { return i.exit_initialization("fmi2ExitInitializationMode"); });
}

fmi2Status fmi2Terminate(fmi2Component c)
{
  return call(c, "fmi2Terminate", [](Instance &i) { return i.terminate("fmi2Terminate"); });
}

fmi2Status fmi2Reset(fmi2Component c)
{
  return call(c, "fmi2Reset", [](Instance &i) { return i.reset("fmi2Reset"); });
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t n, fmi2Real value[])
{
  return call(c, "fmi2GetReal", [&](Instance &i) { return i.get("fmi2GetReal", vr, n, value); });
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], std::size_t n, fmi2Integer value[])
{
  return call(c, "fmi2GetInteger", [&](Instance &i) { return i.get_whole("fmi2GetInteger", vr, n, value); });
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], std::size_t n, fmi2Boolean value[])
{
  return call(c, "fmi2GetBoolean", [&](Instance &i) {
    for (std::size_t k = 0; k < n || k == 0; ++k) {
      bool truth = false;
      const Status status =
          i.get_truth("fmi2GetBoolean", vr ? vr + k : nullptr, n > 0 ? 1 : 0, value ? &truth : nullptr);
      if (status != Status::ok)
        return status;
      if (n > 0)
        value[k] = truth ? 1 : 0;
    }
    return Status::ok;
  });
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], std::size_t n, fmi2String[])
{
  return no_variables(c, "fmi2GetString", vr, n, "String");
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t n, const fmi2Real value[])
{
  return call(c, "fmi2SetReal", [&](Instance &i) { return i.set("fmi2SetReal", vr, n, value); });
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], std::size_t n, const fmi2Integer[])
{
  return call(c, "fmi2SetInteger", [&](Instance &i) { return i.set_whole("fmi2SetInteger", vr, n); });
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], std::size_t n, const fmi2Boolean value[])
{
  return call(c, "fmi2SetBoolean", [&](Instance &i) {
    // bool arrays, since those of FMI 2 are of int
    const std::unique_ptr<bool[]> truth(new bool[n + 1]);
    for (std::size_t k = 0; value && k < n; ++k)
      truth[k] = value[k] != 0;
    return i.set_truth("fmi2SetBoolean", vr, n, value ? truth.get() : nullptr);
  });
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], std::size_t n, const fmi2String[])
{
  return no_variables(c, "fmi2SetString", vr, n, "String");
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
  return call(c, "fmi2GetFMUstate", [&](Instance &i) { return i.copy("fmi2GetFMUstate", state); });
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
  return call(c, "fmi2SetFMUstate", [&](Instance &i) { return i.restore("fmi2SetFMUstate", state); });
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
  return call(c, "fmi2FreeFMUstate", [&](Instance &i) { return i.free_copy("fmi2FreeFMUstate", state); });
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, std::size_t *size)
{
  return call(c, "fmi2SerializedFMUstateSize",
              [&](Instance &i) { return i.serialized_size("fmi2SerializedFMUstateSize", state, size); });
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], std::size_t size)
{
  return call(c, "fmi2SerializeFMUstate",
              [&](Instance &i) { return i.serialize("fmi2SerializeFMUstate", state, bytes, size); });
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], std::size_t size, fmi2FMUstate *state)
{
  return call(c, "fmi2DeSerializeFMUstate",
              [&](Instance &i) { return i.deserialize("fmi2DeSerializeFMUstate", bytes, size, state); });
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], std::size_t n_unknown,
                                        const fmi2ValueReference known[], std::size_t n_known,
                                        const fmi2Real seed[], fmi2Real result[])
{
  return call(c, "fmi2GetDirectionalDerivative", [&](Instance &i) {
    return i.derivative("fmi2GetDirectionalDerivative", {unknown, n_unknown, known, n_known, seed, result, false});
  });
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                                       const fmi2Integer order[], const fmi2Real value[])
{
  return call(c, "fmi2SetRealInputDerivatives", [&](Instance &i) {
    return i.set_input_derivatives("fmi2SetRealInputDerivatives", vr, n, order, value);
  });
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                                        const fmi2Integer order[], fmi2Real value[])
{
  return call(c, "fmi2GetRealOutputDerivatives", [&](Instance &i) {
    return i.get_output_derivatives("fmi2GetRealOutputDerivatives", vr, n, order, value);
  });
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real from, fmi2Real length, fmi2Boolean)
{
  return call(c, "fmi2DoStep", [&](Instance &i) {
    const Status status = i.may_step("fmi2DoStep", from, length);
    return status == Status::ok ? i.do_step("fmi2DoStep", from, length) : status;
  });
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
  return call(c, "fmi2CancelStep", [](Instance &i) {
    return i.log().refuse(Status::error,
                          "fmi2CancelStep: no step is under way, every step ends before it returns");
  });
}

fmi2Status fmi2GetStatus(fmi2Component c, fmi2StatusKind, fmi2Status *)
{
  return discarded(c, "fmi2GetStatus", "no step is ever pending");
}

fmi2Status fmi2GetRealStatus(fmi2Component c, fmi2StatusKind kind, fmi2Real *value)
{
  if (kind != fmi2LastSuccessfulTime || !value)
    return discarded(c, "fmi2GetRealStatus", "only fmi2LastSuccessfulTime is known");
  return call(c, "fmi2GetRealStatus", [&](Instance &i) {
    *value = i.time();
    return Status::ok;
  });
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, fmi2StatusKind, fmi2Integer *)
{
  return discarded(c, "fmi2GetIntegerStatus", "no status is a whole number");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, fmi2StatusKind kind, fmi2Boolean *value)
{
  if (kind != fmi2Terminated || !value)
    return discarded(c, "fmi2GetBooleanStatus", "only fmi2Terminated is known");
  return call(c, "fmi2GetBooleanStatus", [&](Instance &i) {
    *value = i.ended() ? 1 : 0;
    return Status::ok;
  });
}

fmi2Status fmi2GetStringStatus(fmi2Component c, fmi2StatusKind, fmi2String *)
{
  return discarded(c, "fmi2GetStringStatus", "no step is ever pending");
}
