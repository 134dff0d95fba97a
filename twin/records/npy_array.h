#pragma once
#include "twin/records/binary_numbers.h"
#include <string>
#include <string_view>
#include <vector>

// numpy's format: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
namespace mill::twin {
struct NpyField {
  std::string name;  ///< of a structured array; empty for a plain one
  BinaryType type;
  std::size_t offset;  ///< byte, in a row
};

/// The field of a recording that has the number of the sample.
constexpr std::string_view sample_field = "s";

/// What the header of an array says.
struct NpyLayout {
  std::vector<NpyField> fields;  ///< columns
  std::size_t row    = 0;        ///< byte
  double n           = 0;        ///< rows
  std::size_t start  = 0;        ///< byte, of the first row
  bool plain         = false;    ///< not structured
  bool columns_first = false;    ///< a plain array in Fortran's order
};

/// Bytes of the head of a file that hold the header at least; the length of the header is in the first 12.
constexpr std::size_t npy_prefix = 12;

/// Length of everything before the first row.
/// @param prefix  the first npy_prefix bytes of the file
/// @throws InputError  not an array, or a header of more than 1 MiB
std::size_t npy_start(std::string_view prefix, const std::string &path);

/// @param head  the first npy_start() bytes of the file
/// @throws InputError  other numbers, other shapes, more than 4e9 rows
NpyLayout npy_layout(std::string_view head, const std::string &path);
}  // namespace mill::twin
