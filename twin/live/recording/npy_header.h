#pragma once
#include <cstdint>
#include <string>
#include <vector>

// Header of a structured array of numpy (.npy, version 1.0 or 2.0) whose length is written again while it grows.
// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
namespace mill::live {
/// One '<f4' per name, then '<i8' "s"; as many bytes for any number of rows.
std::string npy_header(const std::vector<std::string> &fields, std::int64_t rows);

/// Names that a field may have: printable ASCII without quotes, none twice, none "s".
std::vector<std::string> field_names(const std::vector<std::string> &channels);

/// What a header that npy_header() wrote says.
struct NpyHeader {
  std::size_t bytes = 0;            ///< byte, where the rows begin
  std::vector<std::string> fields;  ///< of the channels, without "s"
  std::int64_t rows = 0;            ///< -
  std::size_t row_bytes() const
  {
    return 4 * fields.size() + 8;
  }
};
/// False: these are not the first bytes of such a file.
bool read_npy_header(const std::string &first_bytes, NpyHeader &header);
}  // namespace mill::live
