#pragma once
#include "core/case/provenance.h"
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
}  // namespace mill
