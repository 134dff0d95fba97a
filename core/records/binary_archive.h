#pragma once
#include "core/base/choice.h"
#include "core/base/each_member.h"
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

// Records as bytes and back, to the last bit, by their each_member: what the cache keeps.  The bytes hold neither
// names nor types; layout_of() says of which members and types they are.
namespace mill {
namespace binary {
template <class T> constexpr bool is_matrix = std::is_base_of_v<Eigen::MatrixBase<T>, T>;

/// Appends values.
struct Writer {
  std::string bytes;

  template <class T> void operator()(const char *, const T &value)
  {
    write(value);
  }
  void raw(const void *data, const std::size_t size)
  {
    if (size > 0)  // an empty array has no address
      bytes.append(static_cast<const char *>(data), size);
  }
  void size(const std::size_t value)
  {
    write(std::uint64_t(value));
  }
  template <class T> void write(const T &value)
  {
    if constexpr (std::is_arithmetic_v<T>)
      raw(&value, sizeof value);
    else if constexpr (has_words<T>)
      write(std::string(word_of(value)));
    else if constexpr (is_matrix<T>)
      write_matrix(value);
    else
      each_member(*this, value);
  }
  void write(const std::string &text)
  {
    size(text.size());
    raw(text.data(), text.size());
  }
  template <class T> void write(const std::vector<T> &list)
  {
    size(list.size());
    for (const T &one : list)
      write(one);
  }
  template <class T, std::size_t n> void write(const std::array<T, n> &list)
  {
    for (const T &one : list)
      write(one);
  }
  template <class T> void write(const std::optional<T> &value)
  {
    size(value ? 1 : 0);
    if (value)
      write(*value);
  }
  template <class Key, class T> void write(const std::map<Key, T> &map)
  {
    size(map.size());
    for (const auto &[key, value] : map) {
      write(key);
      write(value);
    }
  }

private:
  // Of one whose bits are zero throughout, as the motion of axes that stay straight, the size alone.
  template <class M> void write_matrix(const M &matrix)
  {
    const auto *const data   = reinterpret_cast<const char *>(matrix.data());
    const std::size_t length = sizeof(typename M::Scalar) * std::size_t(matrix.size());
    const bool zero          = std::all_of(data, data + length, [](const char byte) { return byte == 0; });
    size(std::size_t(matrix.rows()));
    size(std::size_t(matrix.cols()));
    write(zero);
    raw(data, zero ? 0 : length);
  }
};

/// Reads them in the same order; `good` turns false when the bytes do not hold what is asked for.
struct Reader {
  const std::string &bytes;
  std::size_t position = 0;
  bool good            = true;

  template <class T> void operator()(const char *, T &value)
  {
    read(value);
  }
  void raw(void *data, const std::size_t size)
  {
    good = good && size <= bytes.size() - position;
    if (!good || size == 0)
      return;
    std::memcpy(data, bytes.data() + position, size);
    position += size;
  }
  std::size_t size()
  {
    std::uint64_t value = 0;
    raw(&value, sizeof value);
    return good ? std::size_t(value) : 0;
  }
  template <class T> void read(T &value)
  {
    if constexpr (std::is_arithmetic_v<T>)
      raw(&value, sizeof value);
    else if constexpr (has_words<T>) {
      std::string word;
      read(word);
      const auto choice = choice_named<T>(word);
      good              = good && choice;
      value             = choice.value_or(value);
    } else if constexpr (is_matrix<T>)
      read_matrix(value);
    else
      each_member(*this, value);
  }
  void read(bool &value)
  {
    char byte = 0;
    raw(&byte, 1);
    value = byte != 0;
  }
  void read(std::string &text)
  {
    const std::size_t length = size();
    good                     = good && length <= bytes.size() - position;
    text                     = good ? bytes.substr(position, length) : "";
    position += text.size();
  }
  template <class T> void read(std::vector<T> &list)
  {
    list.clear();
    for (std::size_t n = size(); n > 0 && good; --n)
      read(list.emplace_back());
  }
  template <class T, std::size_t n> void read(std::array<T, n> &list)
  {
    for (T &one : list)
      read(one);
  }
  template <class T> void read(std::optional<T> &value)
  {
    value.reset();
    if (size() > 0)
      read(value.emplace());
  }
  template <class Key, class T> void read(std::map<Key, T> &map)
  {
    map.clear();
    for (std::size_t n = size(); n > 0 && good; --n) {
      Key key{};
      read(key);
      read(map[key]);
    }
  }

private:
  template <class M> void read_matrix(M &matrix)
  {
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
    const std::size_t rows = size(), cols = size();
    bool zero = false;
    read(zero);
    const auto fits = [](const int wanted, const std::size_t length) {
      return wanted == Eigen::Dynamic || std::size_t(wanted) == length;
    };
    good = good && rows < most && cols < most && fits(M::RowsAtCompileTime, rows) &&
           fits(M::ColsAtCompileTime, cols) && (zero ? rows * cols < most : rows * cols <= bytes.size());
    if (!good)
      return;
    matrix.resize(Eigen::Index(rows), Eigen::Index(cols));
    if (zero)
      matrix.setZero();
    else
      raw(matrix.data(), sizeof(typename M::Scalar) * rows * cols);
  }
};

/// Text of what a record holds: names and types of its members, those of their members, and so on.
struct Layout {
  std::string text;

  template <class T> void operator()(const char *name, const T &)
  {
    text += name;
    text += ':';
    add(static_cast<const T *>(nullptr));
    text += ';';
  }
  template <class T> void add(const T *)
  {
    if constexpr (std::is_arithmetic_v<T>)
      text += (std::is_floating_point_v<T> ? 'f' : 'i') + std::to_string(sizeof(T));
    else if constexpr (has_words<T>)
      text += "choice";
    else if constexpr (is_matrix<T>) {
      text += "matrix ";
      add(static_cast<const typename T::Scalar *>(nullptr));
    } else {
      const T record{};
      text += '{';
      each_member(*this, record);
      text += '}';
    }
  }
  void add(const std::string *)
  {
    text += "text";
  }
  template <class T> void add(const std::vector<T> *)
  {
    text += "list ";
    add(static_cast<const T *>(nullptr));
  }
  template <class T, std::size_t n> void add(const std::array<T, n> *)
  {
    text += std::to_string(n) + ' ';
    add(static_cast<const T *>(nullptr));
  }
  template <class T> void add(const std::optional<T> *)
  {
    text += "perhaps ";
    add(static_cast<const T *>(nullptr));
  }
  template <class Key, class T> void add(const std::map<Key, T> *)
  {
    text += "map ";
    add(static_cast<const Key *>(nullptr));
    add(static_cast<const T *>(nullptr));
  }
};
}  // namespace binary

template <class Record> std::string bytes_of_record(const Record &record)
{
  binary::Writer writer;
  writer.write(record);
  return std::move(writer.bytes);
}

/// Nothing where the bytes are not those of such a record.
template <class Record> std::optional<Record> record_of_bytes(const std::string &bytes)
{
  std::optional<Record> record(std::in_place);
  binary::Reader reader{bytes};
  reader.read(*record);
  if (!reader.good || reader.position != bytes.size())
    record.reset();
  return record;
}

/// Changes with every member that a record, or one inside it, gains, loses, renames or holds as another type.
template <class Record> std::string layout_of()
{
  binary::Layout layout;
  layout.add(static_cast<const Record *>(nullptr));
  return layout.text;
}
}  // namespace mill
