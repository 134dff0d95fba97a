#pragma once
#include <optional>
#include <string>

// Entries of the cache: the one place where they are written and read.
namespace mill {
/// Keeps bytes under the hash of everything they depend on: a line that names kind and version, the key, a
/// checksum, then the bytes.  Written aside and renamed, so that a killed run, a full disk or a second process
/// leaves a whole entry or none.
/// @throws SystemError  cannot be written
void write_cache_entry(const std::string &path, const std::string &kind, const std::string &key,
                       const std::string &bytes);

/// The bytes kept under a key, or nothing: no entry exists, or it is not used and `note` says why (another kind,
/// version or key; damaged; no regular file; not readable).  An entry only saves time, so nothing is thrown, and
/// what stands in its place (a folder, a pipe, a device) is neither waited for nor read.
std::optional<std::string> read_cache_entry(const std::string &path, const std::string &kind,
                                            const std::string &key, std::string *note = nullptr);
}  // namespace mill
