#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mill::twin {
/// One file in an archive.
struct ZipEntry {
  std::string name;
  std::string_view packed;  ///< bytes in the archive
  std::size_t size    = 0;  ///< byte, unpacked
  std::uint32_t check = 0;  ///< CRC-32 of the unpacked bytes
  int method          = 0;  ///< 0: stored, 8: deflated
};

/// The files of a zip archive that is not encrypted and below 4 GiB.
/// Source: PKWARE, .ZIP File Format Specification 6.3, sections 4.3 and 4.4.
/// @throws InputError  not an archive, cut off, damaged, 4 GiB and more
std::vector<ZipEntry> zip_entries(const std::string &file, std::string_view archive);

/// @throws InputError  another method, damaged by size or check, or more than memory holds
std::string unpacked(const std::string &file, const ZipEntry &entry);
}  // namespace mill::twin
