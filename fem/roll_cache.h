#pragma once
#include "fem/condensed_roll.h"
#include "fem/fourier_roll.h"
#include "fem/ring_flexibility.h"
#include "fem/roller_contact.h"
#include <optional>
#include <string>

namespace mill::fem {
/// Stores a condensed body under the hash of everything it depends on: written aside and renamed, with a checksum
/// of the numbers, so that a killed run or a second process leaves a whole file or none.
void save_roll(const std::string &path, const std::string &key, const CondensedRoll &roll);
void save_roll(const std::string &path, const std::string &key, const FourierRoll &roll);
void save_roller(const std::string &path, const std::string &key, const CondensedRoller &roller);
void save_rings(const std::string &path, const std::string &key, const RingResult &rings);

/// The stored body, or nothing when there is none, when it belongs to another key, or when it is damaged (`note`
/// says so).
std::optional<CondensedRoll> load_roll(const std::string &path, const std::string &key,
                                       std::string *note = nullptr);
std::optional<FourierRoll> load_fourier_roll(const std::string &path, const std::string &key,
                                             std::string *note = nullptr);
std::optional<CondensedRoller> load_roller(const std::string &path, const std::string &key,
                                           std::string *note = nullptr);
std::optional<RingResult> load_rings(const std::string &path, const std::string &key, std::string *note = nullptr);
}  // namespace mill::fem
