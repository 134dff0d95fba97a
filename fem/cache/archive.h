#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

// Bytes of the cached bodies: one function template runs through the members of a struct in both directions.
namespace mill::fem {
/// Appends numbers, texts and arrays.
struct Writer {
  std::string bytes;
  void fail() {}
  void raw(const void *data, const std::size_t size)
  {
    if (size > 0)  // an empty array has no address
      bytes.append(static_cast<const char *>(data), size);
  }
  void number(const double &value)
  {
    raw(&value, sizeof value);
  }
  void count(const int &value)
  {
    const double exact = value;
    raw(&exact, sizeof exact);
  }
  void text(const std::string &value)
  {
    count(int(value.size()));
    raw(value.data(), value.size());
  }
  void texts(const std::vector<std::string> &list)
  {
    count(int(list.size()));
    for (const std::string &value : list)
      text(value);
  }
  template <class Array> void array(const Array &array)
  {
    count(int(array.rows()));
    count(int(array.cols()));
    raw(array.data(), sizeof(double) * std::size_t(array.size()));
  }
};

/// Reads them in the same order; `good` turns false when the bytes do not hold what is asked for.
struct Reader {
  const std::string &bytes;
  std::size_t at = 0;
  bool good      = true;
  void fail()
  {
    good = false;
  }
  void raw(void *data, const std::size_t size)
  {
    good = good && size <= bytes.size() - at;
    if (!good || size == 0)  // an empty array has no address
      return;
    std::memcpy(data, bytes.data() + at, size);
    at += size;
  }
  void number(double &value)
  {
    raw(&value, sizeof value);
  }
  void count(int &value)
  {
    double exact = 0;
    raw(&exact, sizeof exact);
    good  = good && std::abs(exact) <= std::numeric_limits<int>::max();  // not of NaN
    value = good ? int(exact) : 0;
  }
  void text(std::string &value)
  {
    int length = 0;
    count(length);
    good = good && length >= 0 && std::size_t(length) <= bytes.size() - at;
    if (!good)
      return;
    value = bytes.substr(at, std::size_t(length));
    at += std::size_t(length);
  }
  void texts(std::vector<std::string> &list)
  {
    int n = 0;
    count(n);
    good = good && n >= 0 && std::size_t(n) <= bytes.size();
    list.assign(good ? std::size_t(n) : 0, "");
    for (std::string &value : list)
      text(value);
  }
  template <class Array> void array(Array &array)
  {
    int rows = 0, cols = 0;
    count(rows);
    count(cols);
    good =
        good && rows >= 0 && cols >= 0 && std::size_t(rows) * std::size_t(cols) <= bytes.size() / sizeof(double);
    if constexpr (Array::ColsAtCompileTime != Eigen::Dynamic)
      good = good && cols == Array::ColsAtCompileTime;
    if (!good)
      return;
    array.resize(rows, cols);
    raw(array.data(), sizeof(double) * std::size_t(array.size()));
  }
};

/// The numbers of a record by its each_member, the same list that a key is made of.
template <class Archive, class Record> void numbers(Archive &archive, Record &record)
{
  each_member([&](const char *, double &value) { archive.number(value); }, record);
}
}  // namespace mill::fem
