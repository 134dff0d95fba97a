#pragma once
#include "core/base/choice.h"
#include <Eigen/Core>
#include <array>
#include <string>
#include <type_traits>
#include <vector>

// Everything a record holds, as text: the key by which a stored result is looked up and recognised.
namespace mill {
/// Collects members as "name=value;".  Doubles keep every bit, texts their length, matrices their bytes' hash; a
/// record inside a record is asked for its own members.
class RecordText {
public:
  std::string text;

  template <class T> void operator()(const char *name, const T &value)
  {
    text += name;
    text += '=';
    add(value);
    text += ';';
  }
  void add(double value);
  void add(const std::string &value);
  void add(const Eigen::MatrixXd &value);
  template <class T, std::size_t n> void add(const std::array<T, n> &list)
  {
    add_list(list);
  }
  template <class T> void add(const std::vector<T> &list)
  {
    add_list(list);
  }
  template <class T> void add(const T &value)
  {
    if constexpr (has_words<T>)
      add(std::string(word_of(value)));
    else if constexpr (std::is_integral_v<T> || std::is_enum_v<T>)
      text += std::to_string(static_cast<long long>(value));
    else if constexpr (std::is_convertible_v<T, std::string>)
      add(std::string(value));
    else if constexpr (std::is_base_of_v<Eigen::MatrixBase<T>, T>)
      add(Eigen::MatrixXd(value));
    else {
      text += '{';
      each_member(*this, value);
      text += '}';
    }
  }

private:
  template <class List> void add_list(const List &list)
  {
    text += '[';
    for (const auto &one : list) {
      add(one);
      text += ' ';
    }
    text += ']';
  }
};

/// The members of all records one after the other.  A record is a struct with a function
///   template <class Io> void each_member(Io &&io, const Record &record)
/// in its namespace; members.h of each folder has them.
template <class... Records> std::string record_text(const Records &...records)
{
  RecordText io;
  ((io.add(records), io.text += '|'), ...);
  return io.text;
}
}  // namespace mill
