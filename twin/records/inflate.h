#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace mill::twin {
enum class Deflated {
  zlib,  ///< with head and checksum, as in MATLAB files
  raw    ///< as in zip files
};

/// The bytes behind compressed ones.
/// @param size  byte, exactly: more or less is a damaged file or one that unpacks without end; memory is taken as
/// the
///              bytes come, not as a damaged size asks
/// @return nothing where the bytes are damaged, cut off, or of another size
std::optional<std::string> inflated(std::string_view bytes, Deflated form, std::size_t size);

/// The first bytes behind compressed ones, `most` at most; fewer where they are damaged.
std::string inflated_head(std::string_view bytes, Deflated form, std::size_t most);
}  // namespace mill::twin
