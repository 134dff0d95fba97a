#pragma once
#include "dynamics/fmu/exported_model.h"
#include "dynamics/fmu/runtime/fmi2_interface.h"
#include "dynamics/fmu/runtime/fmi3_interface.h"
#include "dynamics/fmu/unpacked_unit.h"
#include "dynamics/response/mill_model.h"
#include <memory>
#include <string>
#include <vector>

/// A stand to be exported, filled in by hand from a chain, and that chain.
struct SampleStand {
  mill::dynamics::MillModel chain;
  mill::fmu::ExportedModel model;
};
/// The published stand with line contacts, force of the given meaning.
/// @param gap_damper  N s/m, C; used when the force is not measured
SampleStand sample_stand(mill::ForceMeaning force_meaning = mill::ForceMeaning::measured, double damping = 0.01,
                         double gap_damper = 0);

/// The same in its modes, as a detailed stand is exported.
mill::fmu::ExportedModel in_modes(const SampleStand &stand);

/// A recorded force of `n` samples, evenly spaced (s), about 976 kN; travels along when it is put into a model.
mill::ForceRecord sample_force(Eigen::Index n, double spacing);
void carry(mill::fmu::ExportedModel &model, const mill::ForceRecord &force);

/// Place of a variable in the table.
unsigned reference_of(const mill::fmu::ExportedModel &model, const std::string &name);

/// A short FMI 2 client: a unit that is unpacked and loaded once, and one instance of it.
class Client2 {
public:
  explicit Client2(const mill::fmu::ExportedModel &model, bool logging = false);
  Client2(std::shared_ptr<mill::fmu::UnpackedUnit> unit, const mill::fmu::ExportedModel &model,
          const std::string &guid, const std::string &location, bool logging = false);
  ~Client2();
  Client2(const Client2 &)            = delete;
  Client2 &operator=(const Client2 &) = delete;

  template <class F> F *function(const char *name) const
  {
    return unit->function<F *>(name);
  }
  unsigned at(const std::string &name) const
  {
    return reference_of(model, name);
  }
  int set(const std::string &name, double value);
  double get(const std::string &name);
  int whole(const std::string &name);  ///< of an Integer; INT_MIN where it cannot be read
  int choose(const std::string &name, bool value);
  int slope(double value);
  int start(double force, double begin = 0, double stop = -1);  ///< up to the end of initialization
  int step(double from, double length);
  /// Messages since the last call.
  std::string logged();

  std::shared_ptr<mill::fmu::UnpackedUnit> unit;
  const mill::fmu::ExportedModel &model;
  std::string messages, categories;
  fmi2CallbackFunctions callbacks{};
  fmi2Component c = nullptr;
};

/// A function of the interface by its name: FMI2(client, DoStep)(...)
#define FMI2(client, name) (client).function<decltype(fmi2##name)>("fmi2" #name)
#define FMI3(client, name) (client).function<decltype(fmi3##name)>("fmi3" #name)

/// The same for FMI 3.
class Client3 {
public:
  explicit Client3(const mill::fmu::ExportedModel &model, bool asks_for_force = false, bool logging = true);
  Client3(std::shared_ptr<mill::fmu::UnpackedUnit> unit, const mill::fmu::ExportedModel &model,
          bool asks_for_force = false, bool logging = true);
  ~Client3();
  Client3(const Client3 &)            = delete;
  Client3 &operator=(const Client3 &) = delete;
  template <class F> F *function(const char *name) const
  {
    return unit->function<F *>(name);
  }
  unsigned at(const std::string &name) const
  {
    return reference_of(model, name);
  }
  int set(const std::string &name, double value);
  double get(const std::string &name);
  int whole(const std::string &name);
  int start(double force, double begin = 0);
  int step(double from, double length);
  std::string logged();

  std::shared_ptr<mill::fmu::UnpackedUnit> unit;
  const mill::fmu::ExportedModel &model;
  std::string messages;
  double force_at_end = 0, last_time = 0;
  bool terminated = false, early = false;  ///< what the last step asked for
  fmi3Instance c = nullptr;
};
