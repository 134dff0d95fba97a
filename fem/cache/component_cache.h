#pragma once
#include "core/records/component.h"
#include <optional>
#include <string>

namespace mill::fem {
/// Stores a component under the hash of everything it depends on: written aside and renamed, with a checksum.
void save_component(const std::string &path, const std::string &key, const Component &component);

/// The stored component, or nothing when there is none, when it belongs to another key, or when it is damaged
/// (`note` says so).
std::optional<Component> load_component(const std::string &path, const std::string &key,
                                        std::string *note = nullptr);
}  // namespace mill::fem
