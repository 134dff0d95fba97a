#pragma once
#include <cstdint>
#include <cstring>
#include <string>

namespace mill::twin {
/// One type of number in a binary file.
struct BinaryType {
  char kind;  ///< 'f' floating point, 'i' signed, 'u' unsigned
  int size;   ///< byte: 1, 2, 4, 8
  bool big_endian;
};

/// Value of the number at `bytes`, as double; a signed integer of eight bytes beyond 2^53 is rounded.
inline double number_at(const char *bytes, const BinaryType &type)
{
  std::uint64_t bits = 0;
  for (int i = 0; i < type.size; ++i)
    bits |= std::uint64_t(std::uint8_t(bytes[i])) << 8 * (type.big_endian ? type.size - 1 - i : i);
  if (type.kind == 'f' && type.size == 4) {
    const auto low = std::uint32_t(bits);
    float value;
    std::memcpy(&value, &low, sizeof value);
    return double(value);
  }
  if (type.kind == 'f') {
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  if (type.kind == 'i') {
    const int shift = 64 - 8 * type.size;
    return double(std::int64_t(bits << shift) >> shift);
  }
  return double(bits);
}

/// "<f4", ">i2", "|u1" of numpy.  False where it is not a number of this list.
bool type_of_descriptor(const std::string &text, BinaryType &type);
}  // namespace mill::twin
