#include "dynamics/fmu/icon.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <zlib.h>

namespace mill::fmu {
namespace {
using Colour = std::array<double, 4>;  // red, green, blue, opacity

constexpr Colour outside{255, 255, 255, 0}, steel{96, 110, 124, 255}, work{44, 62, 80, 255},
    strip{217, 119, 33, 255};

// In sides of the picture.
constexpr double work_radius = 0.09, backup_radius = 0.15, entry_half = 0.022, exit_half = 0.012;

Colour stand_at(const double x, const double y)
{
  for (const double side : {-1., 1.})
    if (std::hypot(x - 0.5, y - 0.5 - side * (work_radius + exit_half)) < work_radius)
      return work;
  if (std::abs(y - 0.5) < (x < 0.5 ? entry_half : exit_half))
    return strip;
  for (const double side : {-1., 1.}) {
    const double middle = exit_half + 2 * work_radius + backup_radius;
    if (std::hypot(x - 0.5, y - 0.5 - side * middle) < backup_radius)
      return steel;
  }
  return outside;
}

// A frame with a filled dot.
Colour terminal_at(const double x, const double y)
{
  const double edge = std::max(std::abs(x - 0.5), std::abs(y - 0.5)), middle = std::hypot(x - 0.5, y - 0.5);
  return edge > 0.4 || middle < 0.2 ? work : outside;
}

using Picture = Colour (*)(double, double);

// One point, smoothed over four by four samples.
std::array<unsigned char, 4> point_at(const Picture picture, const int size, const int column, const int row)
{
  Colour sum{};
  constexpr int parts = 4;
  for (int i = 0; i < parts * parts; ++i) {
    const Colour one =
        picture((column + (i % parts + 0.5) / parts) / size, (row + (i / parts + 0.5) / parts) / size);
    for (int c = 0; c < 3; ++c)
      sum[std::size_t(c)] += one[std::size_t(c)] * one[3];
    sum[3] += one[3];
  }
  std::array<unsigned char, 4> bytes{};
  for (std::size_t c = 0; c < 3; ++c)
    bytes[c] = (unsigned char)(sum[3] > 0 ? std::lround(sum[c] / sum[3]) : 255);
  bytes[3] = (unsigned char)std::lround(sum[3] / (parts * parts));
  return bytes;
}

void add_number(std::string &bytes, const std::uint32_t value)
{
  for (const int shift : {24, 16, 8, 0})
    bytes += char(value >> shift & 0xff);
}

// Length, kind, content and check sum.
void add_chunk(std::string &png, const std::string &kind, const std::string &content)
{
  add_number(png, std::uint32_t(content.size()));
  const std::string checked = kind + content;
  png += checked;
  add_number(png, std::uint32_t(crc32(0, reinterpret_cast<const Bytef *>(checked.data()), uInt(checked.size()))));
}

std::string png_of(const Picture picture, const int size)
{
  std::string rows;
  for (int row = 0; row < size; ++row) {
    rows += '\0';  // no filter
    for (int column = 0; column < size; ++column)
      for (const unsigned char byte : point_at(picture, size, column, row))
        rows += char(byte);
  }
  std::string packed(compressBound(uLong(rows.size())), '\0');
  uLongf length = uLongf(packed.size());
  if (compress2(reinterpret_cast<Bytef *>(packed.data()), &length, reinterpret_cast<const Bytef *>(rows.data()),
                uLong(rows.size()), 9) != Z_OK)
    throw std::runtime_error("zlib cannot pack the icon of the unit");
  packed.resize(length);
  std::string png = "\x89PNG\r\n\x1a\n", header;
  add_number(header, std::uint32_t(size));
  add_number(header, std::uint32_t(size));
  header += std::string("\x08\x06\0\0\0", 5);  // 8 bits, red green blue and opacity
  add_chunk(png, "IHDR", header);
  add_chunk(png, "IDAT", packed);
  add_chunk(png, "IEND", "");
  return png;
}
}  // namespace

std::string icon_png()
{
  return png_of(stand_at, 96);
}

std::string terminal_png()
{
  return png_of(terminal_at, 16);
}
}  // namespace mill::fmu
