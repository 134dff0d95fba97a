#pragma once
#include "core/case/provenance.h"
#include "core/model/dynamics_settings.h"
#include "core/model/pass.h"
#include "core/records/results.h"
#include <optional>
#include <string>

// Input keys of results that several kinds of case have; nothing for other results.
namespace mill {
bool begins(const std::string &name, const std::string &prefix);
bool ends(const std::string &name, const std::string &ending);

/// K4.* and bite.PASS.* of pass p; those of one model have its name before theirs.
/// @param pass  its name
std::optional<KeyList> bite_inputs(MovingKeys &keys, std::size_t p, const BiteSetup &setup,
                                   const std::string &name, const std::string &pass);

/// PASS.peak_g.* and PASS.rms_g.*: the numbers of the chain that drives the work roll, and what is done with them.
std::optional<KeyList> response_inputs(const Results &results, const DynamicsSettings &dynamics, const Pass &pass,
                                       std::size_t p, const std::string &name);

/// frf.* and campbell.* that no run has made yet, for a trace: what they depend on in addition to the model. Those
/// of a run carry their own lists.
/// @param orders  number of [[drive.order]]
std::optional<KeyList> turning_inputs(const Results &results, std::size_t orders, const std::string &name);
}  // namespace mill
