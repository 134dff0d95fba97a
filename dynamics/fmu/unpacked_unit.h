#pragma once
#include "dynamics/fmu/exported_model.h"
#include <string>

namespace mill::fmu {
/// An archive unpacked into its own folder, with the library of this platform loaded.  Both end with the
/// object.
class UnpackedUnit {
public:
  /// @throws std::runtime_error  the archive or its library cannot be read; SystemError  the disk refuses the
  /// folder
  UnpackedUnit(const std::string &archive, const std::string &identifier, int fmi_version);
  ~UnpackedUnit();
  UnpackedUnit(const UnpackedUnit &)            = delete;
  UnpackedUnit &operator=(const UnpackedUnit &) = delete;

  /// Path of the folder of resources, ends with a slash.
  std::string resources() const;
  /// A function of the library.  @throws std::runtime_error  it is not there
  template <class Function> Function function(const char *name) const
  {
    return reinterpret_cast<Function>(symbol(name));
  }

private:
  void *symbol(const char *name) const;
  std::string folder_;
  void *library_ = nullptr;
};

/// Lets the unit of an archive reproduce a run through its C interface: the straight lines of force by input
/// derivatives (FMI 2) or the intermediate update (FMI 3).
/// @return  the largest difference of an acceleration or of the load cell, relative to the largest of its kind; of
/// named
///          outputs relative to the largest of each
/// @throws std::runtime_error  a call fails: what the unit logs
double difference_from(const CheckRun &run, const std::string &archive, const ExportedModel &model,
                       int fmi_version);
}  // namespace mill::fmu
