#include "twin/records/mat_arrays.h"
#include "core/base/choice.h"
#include "core/base/input_file.h"
#include "core/base/valid_text.h"
#include "twin/records/binary_numbers.h"
#include "twin/records/inflate.h"
#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace mill::twin {
namespace {
// Mark at the end of the head.
enum class ByteOrder { little_endian, big_endian };
constexpr auto words_of(ByteOrder)
{
  return choice_words<ByteOrder>("IM", "MI");
}

constexpr std::size_t head_size = 128;
constexpr int compressed = 15, matrix = 14;
constexpr int deepest            = 12;    // structures inside structures
constexpr std::size_t most_parts = 4096;  // fields and cells of one variable
enum ArrayClass {
  cell         = 1,
  structure    = 2,
  object       = 3,
  text         = 4,
  sparse       = 5,
  first_number = 6,
  last_number  = 15,
  function     = 16,
  opaque = 17  // tables, times of day, strings: the name of the class, its values in the unnamed array of the file
};

struct Element {
  int type         = 0;
  std::size_t size = 0;  // byte of data
  std::size_t data = 0;  // where they begin
  std::size_t next = 0;  // where the next element begins
};

// Types of numbers, table 1-1; nothing for others.
bool number_type(const int type, BinaryType &type_of_numbers)
{
  static constexpr struct {
    int type;
    BinaryType number;
  } types[] = {
      {1, {'i', 1, false}},  {2, {'u', 1, false}},  {3, {'i', 2, false}}, {4, {'u', 2, false}},
      {5, {'i', 4, false}},  {6, {'u', 4, false}},  {7, {'f', 4, false}}, {9, {'f', 8, false}},
      {12, {'i', 8, false}}, {13, {'u', 8, false}},
  };
  for (const auto &one : types)
    if (one.type == type) {
      type_of_numbers = one.number;
      return true;
    }
  return false;
}

// The elements of a run of bytes: the file, or what one compressed element held.
class MatParser {
public:
  MatParser(const std::string &path, const std::string_view content, const bool is_big_endian, NamedArrays &arrays)
      : file(path), bytes(content), big_endian(is_big_endian), result(arrays)
  {
  }

  void read(std::size_t position)
  {
    while (position + 8 <= bytes.size()) {
      const Element element = element_at(position, bytes.size());
      if (element.type == compressed)
        unpack(element);
      if (element.type == matrix)
        take(element, "", 0);
      position = element.next;
    }
  }

private:
  [[noreturn]] void refuse(const std::string &what) const
  {
    throw InputError(file + " " + what);
  }

  std::size_t word(const std::size_t position) const
  {
    return std::size_t(number_at(&bytes[position], {'u', 4, big_endian}));
  }

  Element element_at(const std::size_t position, const std::size_t end) const
  {
    if (position + 8 > end)
      refuse("ends inside a variable; it was cut off while it was written or copied");
    Element element;
    const std::size_t tag = word(position);
    if (tag >> 16) {  // up to four byte, in the tag itself
      element = {int(tag & 0xFFFF), tag >> 16, position + 4, position + 8};
      if (element.size > 4)
        refuse("is damaged: a small element of more than four byte");
      return element;
    }
    element.type = int(tag);
    element.size = word(position + 4);
    element.data = position + 8;
    if (element.size > end - element.data)
      refuse("ends inside a variable; it was cut off while it was written or copied");
    const std::size_t padded = element.type == compressed ? element.size : (element.size + 7) / 8 * 8;
    element.next             = std::min(element.data + padded, end);
    return element;
  }

  // The first eight bytes say how long the variable is; so what unpacks to more than that is not unpacked.
  void unpack(const Element &element)
  {
    const auto packed      = bytes.substr(element.data, element.size);
    const std::string head = inflated_head(packed, Deflated::zlib, 8);
    if (head.size() < 8)
      refuse("holds a compressed variable that is damaged");
    const auto size = std::size_t(number_at(&head[4], {'u', 4, big_endian}));
    require_memory(file, double(bytes.size()), 2.0 * double(size));
    const auto plain = inflated(packed, Deflated::zlib, size + 8);
    if (!plain)
      refuse("holds a compressed variable that is damaged");
    const Element inside = {int(number_at(head.data(), {'u', 4, big_endian})), size, 8, size + 8};
    if (inside.type == matrix)
      MatParser(file, *plain, big_endian, result).take(inside, "", 0);
  }

  void leave_out(const std::string &name, const std::string_view what)
  {
    if (result.others.size() < 20)
      result.others.push_back(fmt::format("'{}' ({})", valid_text(name), valid_text(what)));
  }

  // One array; `outer` is the name of the structure or cell that holds it, with what follows it.
  void take(const Element &array, const std::string &outer, const int depth)
  {
    const std::size_t end = array.data + array.size;
    if (array.size == 0 || depth > deepest)
      return;
    const Element flags = element_at(array.data, end);
    if (flags.size < 8)
      refuse("is damaged: an array without flags");
    const std::size_t flag = word(flags.data);
    const int kind         = int(flag & 0xFF);
    if (kind == opaque)
      return leave_out_object(flags.next, end, outer);
    const Element sizes = element_at(flags.next, end);
    std::vector<std::size_t> dimensions;
    for (std::size_t i = 0; i + 4 <= sizes.size; i += 4)
      dimensions.push_back(word(sizes.data + i));
    const Element named    = element_at(sizes.next, end);
    const std::string name = outer.empty() ? std::string(bytes.substr(named.data, named.size)) : outer;
    if (name.empty())  // values of the objects of the file, which MATLAB appends
      return;
    if (kind == structure)
      take_fields(named.next, end, dimensions, name, depth);
    else if (kind == cell)
      take_cells(named.next, end, dimensions, name, depth);
    else if (kind >= first_number && kind <= last_number && !(flag & 0x0800))
      take_numbers(named.next, end, dimensions, name);
    else
      leave_out(name, kind == text           ? "text"
                      : kind == sparse       ? "sparse matrix"
                      : (flag & 0x0800) != 0 ? "complex numbers"
                      : kind == object       ? "object"
                      : kind == function     ? "function"
                                             : "of another kind");
  }

  // Name, system of types and class, as texts.
  void leave_out_object(const std::size_t position, const std::size_t end, const std::string &outer)
  {
    const Element name = element_at(position, end), system = element_at(name.next, end),
                  type = element_at(system.next, end);
    leave_out(outer.empty() ? std::string(bytes.substr(name.data, name.size)) : outer,
              bytes.substr(type.data, type.size));
  }

  std::size_t count_of(const std::vector<std::size_t> &dimensions) const
  {
    double n = dimensions.empty() ? 0 : 1;
    for (const std::size_t size : dimensions)
      n *= double(size);
    if (n > double(bytes.size()))
      refuse("holds a variable with fewer numbers than its size says");
    return std::size_t(n);
  }

  void take_numbers(const std::size_t position, const std::size_t end, const std::vector<std::size_t> &dimensions,
                    const std::string &name)
  {
    const std::size_t n = count_of(dimensions);
    if (n == 0 || dimensions.size() < 2)
      return;
    const Element data = element_at(position, end);
    BinaryType type;
    if (!number_type(data.type, type))
      return leave_out(name, "numbers of an unknown type");
    type.big_endian = big_endian;
    if (double(n) * double(type.size) > double(data.size))
      refuse("holds a variable with fewer numbers than its size says");
    // more than two dimensions: samples in the first, all others side by side
    NamedArray array{name, Eigen::MatrixXd(Eigen::Index(dimensions[0]), Eigen::Index(n / dimensions[0]))};
    if (dimensions.size() > 2 && dimensions[0] == 1)
      array.value.resize(1, Eigen::Index(n));
    for (std::size_t i = 0; i < n; ++i)
      array.value.data()[i] = number_at(&bytes[data.data + i * std::size_t(type.size)], type);
    result.arrays.push_back(std::move(array));
  }

  void take_fields(std::size_t position, const std::size_t end, const std::vector<std::size_t> &dimensions,
                   const std::string &name, const int depth)
  {
    const Element length    = element_at(position, end);
    const Element names     = element_at(length.next, end);
    const std::size_t width = length.size >= 4 ? word(length.data) : 0;
    const std::size_t n = count_of(dimensions), n_fields = width > 0 ? names.size / width : 0;
    position = names.next;
    for (std::size_t i = 0; i < std::min(n * n_fields, most_parts); ++i) {
      const Element value = element_at(position, end);
      std::string field(bytes.substr(names.data + i % n_fields * width, width));
      field.resize(std::min(field.find('\0'), field.size()));
      const std::string outer = n == 1 ? name : fmt::format("{}_{}", name, i / n_fields + 1);
      if (value.type == matrix)
        take(value, outer + "." + field, depth + 1);
      position = value.next;
    }
  }

  void take_cells(std::size_t position, const std::size_t end, const std::vector<std::size_t> &dimensions,
                  const std::string &name, const int depth)
  {
    for (std::size_t i = 0; i < std::min(count_of(dimensions), most_parts); ++i) {
      const Element value = element_at(position, end);
      if (value.type == matrix)
        take(value, fmt::format("{}_{}", name, i + 1), depth + 1);
      position = value.next;
    }
  }

  const std::string &file;
  std::string_view bytes;
  bool big_endian;
  NamedArrays &result;
};
}  // namespace

NamedArrays mat_arrays(const std::string &file, const std::string &bytes)
{
  if (bytes.rfind("MATLAB 7.3", 0) == 0 || bytes.rfind("\x89HDF", 0) == 0)
    throw InputError(file + " is a MATLAB file of version 7.3; save it in MATLAB with save('record.mat', '-v7')");
  const auto order = bytes.size() < head_size ? std::nullopt : choice_named<ByteOrder>(bytes.substr(126, 2));
  if (!order)
    throw InputError(file + " is not a MATLAB file of level 5; save it in MATLAB with save('record.mat', '-v7')");
  NamedArrays arrays;
  MatParser(file, bytes, *order == ByteOrder::big_endian, arrays).read(head_size);
  return arrays;
}
}  // namespace mill::twin
