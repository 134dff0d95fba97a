#pragma once
#include "fem/bearing/ring_flexibility.h"
#include "fem/bearing/roller_contact.h"
#include "fem/roll/condensed_roll.h"
#include "fem/roll/fourier_roll.h"
#include <optional>
#include <string>

namespace mill::fem {
/// Keeps a condensed body in the cache under the hash of everything it depends on (core/records/cache_entry.h).
/// @throws SystemError  cannot be written
void save_roll(const std::string &path, const std::string &key, const CondensedRoll &roll);
void save_roll(const std::string &path, const std::string &key, const FourierRoll &roll);
void save_roller(const std::string &path, const std::string &key, const CondensedRoller &roller);
void save_rings(const std::string &path, const std::string &key, const RingResult &rings);

/// The stored body, or nothing when there is none or when it cannot be used; then `note` says why.
std::optional<CondensedRoll> load_roll(const std::string &path, const std::string &key,
                                       std::string *note = nullptr);
std::optional<FourierRoll> load_fourier_roll(const std::string &path, const std::string &key,
                                             std::string *note = nullptr);
std::optional<CondensedRoller> load_roller(const std::string &path, const std::string &key,
                                           std::string *note = nullptr);
std::optional<RingResult> load_rings(const std::string &path, const std::string &key, std::string *note = nullptr);
}  // namespace mill::fem
