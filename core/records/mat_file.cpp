#include "core/records/mat_file.h"
#include "core/base/require.h"
#include <cctype>
#include <cstdint>
#include <cstring>

namespace mill {
namespace {
// Types of data elements and classes of arrays, tables 1-1 and 1-3 of the format.
enum DataType : std::uint32_t { int8 = 1, uint16 = 4, int32 = 5, uint32 = 6, float64 = 9, matrix = 14 };
enum ArrayClass : std::uint32_t { cell_array = 1, char_array = 4, double_array = 6 };

template <class Number> void put(std::string &out, const Number value)
{
  char bytes[sizeof(Number)];
  std::memcpy(bytes, &value, sizeof value);  // little-endian, as the head of the file says
  out.append(bytes, sizeof value);
}

std::string element(const DataType type, const std::string &data)
{
  std::string out;
  put(out, std::uint32_t(type));
  put(out, std::uint32_t(data.size()));
  out += data;
  if (type != matrix)
    out.append((8 - data.size() % 8) % 8, '\0');
  return out;
}

template <class Number> std::string bytes_of(const Number *first, const std::size_t n)
{
  std::string data;
  data.reserve(n * sizeof(Number));
  for (std::size_t i = 0; i < n; ++i)
    put(data, first[i]);
  return data;
}

std::string array(const ArrayClass kind, const std::string &name, const std::int32_t rows,
                  const std::int32_t columns, const std::string &content)
{
  const std::uint32_t flags[]     = {kind, 0};
  const std::int32_t dimensions[] = {rows, columns};
  return element(matrix, element(uint32, bytes_of(flags, 2)) + element(int32, bytes_of(dimensions, 2)) +
                             element(int8, name) + content);
}

std::string text_array(const std::string &text)
{
  std::string units;
  for (const char c : text)  // names of the program are ASCII
    put(units, std::uint16_t(static_cast<unsigned char>(c)));
  return array(char_array, "", 1, std::int32_t(text.size()), element(uint16, units));
}

void require_name(const std::string &name)
{
  bool fine = !name.empty() && name.size() < 64 && std::isalpha(static_cast<unsigned char>(name[0]));
  for (const char c : name)
    fine = fine && (std::isalnum(static_cast<unsigned char>(c)) || c == '_');
  require(fine, "no name for MATLAB: " + name);
}
}  // namespace

std::string mat_file(const std::vector<MatVariable> &variables)
{
  std::string out = "MATLAB 5.0 MAT-file, written by millstand";
  out.resize(116, ' ');
  out.append(8, '\0');
  put(out, std::uint16_t(0x0100));
  put(out, std::uint16_t('M' << 8 | 'I'));
  for (const MatVariable &v : variables) {
    require_name(v.name);
    if (v.texts.empty()) {
      out += array(double_array, v.name, std::int32_t(v.matrix.rows()), std::int32_t(v.matrix.cols()),
                   element(float64, bytes_of(v.matrix.data(), std::size_t(v.matrix.size()))));
      continue;
    }
    std::string cells;
    for (const std::string &text : v.texts)
      cells += text_array(text);
    out += array(cell_array, v.name, std::int32_t(v.texts.size()), 1, cells);
  }
  return out;
}
}  // namespace mill
