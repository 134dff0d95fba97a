#pragma once
#include "dynamics/fmu/exported_model.h"
#include "dynamics/fmu/identifier.h"
#include <string>

namespace mill::fmu {
/// Name in the archive of what describes the unit.
constexpr const char *description_file = "modelDescription.xml";

/// The whole unit as the bytes of its archive: description, libraries, resources, sources, documentation.  The
/// same model gives the same bytes.  model.data.guid is set from the rest (identity_of) before.
/// @throws InputError  a start value that the standard does not allow, or out of the range that a unit accepts
std::string unit_archive(const ExportedModel &model, int fmi_version);

/// Loads the unit of an archive and compares.  @throws std::logic_error  it differs by more than model.check
/// allows, or does not run
void check_unit(const std::string &archive, const ExportedModel &model, int fmi_version);
}  // namespace mill::fmu
