#pragma once
#include <string>
#include <vector>

namespace mill::fmu {
/// One file of an archive.
struct ArchiveEntry {
  std::string name;  ///< "resources/model.json", forward slashes
  std::string bytes;
  bool executable = false;  ///< mode 0755 in place of 0644
};

/// A zip archive as its bytes: deflated, version 2.0, dated 1980-01-01, so that the same entries give the same
/// bytes.
/// @throws std::runtime_error  zlib cannot pack it
std::string archive_of(const std::vector<ArchiveEntry> &entries);

/// All entries of an archive.  @throws std::runtime_error  the bytes are not a zip archive
std::vector<ArchiveEntry> entries_of(const std::string &archive);
}  // namespace mill::fmu
