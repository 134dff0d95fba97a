#pragma once
#include "core/base/choice.h"
#include "core/base/each_member.h"
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

// Records as JSON and back, by their each_member.  A number that is not finite is null, an absent optional too; a
// matrix is a list of its rows, a choice its word.  Reading is patient: an entry that is absent or of another type
// leaves the member as the record has it from the start, null makes a number NaN.
namespace mill {
namespace json {
using Node = nlohmann::ordered_json;

Node &entry(Node &object, const char *name);  ///< added when it is new
Node &element(Node &list);                    ///< a new one at the end
void make_list(Node &node);
void make_object(Node &node);
void put(Node &node, double value);
void put(Node &node, int value);
void put(Node &node, bool value);
void put(Node &node, const std::string &value);

const Node *find(const Node &object, const char *name);  ///< nullptr when absent
const Node *element(const Node &list, std::size_t i);    ///< nullptr when there is none
bool is_object(const Node &node);
std::size_t length(const Node &list);                   ///< 0 when it is not a list
std::vector<std::string> names_in(const Node &object);  ///< empty when it is not an object
void get(const Node &node, double &value);
void get(const Node &node, int &value);
void get(const Node &node, bool &value);
void get(const Node &node, std::string &value);

template <class T> constexpr bool is_matrix = std::is_base_of_v<Eigen::MatrixBase<T>, T>;
template <class T> constexpr bool is_plain  = std::is_arithmetic_v<T> || std::is_same_v<T, std::string>;

/// Writes one value of any kind that a record may hold.
class Writer {
public:
  explicit Writer(Node &node) : node_(node) {}
  template <class T> void operator()(const char *name, const T &value)
  {
    Writer(entry(node_, name)).write(value);
  }
  template <class T> void write(const T &value)
  {
    if constexpr (is_plain<T>)
      put(node_, value);
    else if constexpr (has_words<T>)
      put(node_, std::string(word_of(value)));
    else if constexpr (is_matrix<T>)
      write_matrix(value);
    else {
      make_object(node_);
      each_member(*this, value);
    }
  }
  template <class T> void write(const std::vector<T> &list)
  {
    write_list(list);
  }
  template <class T, std::size_t n> void write(const std::array<T, n> &list)
  {
    write_list(list);
  }
  template <class T> void write(const std::optional<T> &value)
  {
    if (value)
      write(*value);
  }
  template <class T> void write(const std::map<std::string, T> &map)
  {
    make_object(node_);
    for (const auto &[name, value] : map)
      (*this)(name.c_str(), value);
  }

private:
  template <class List> void write_list(const List &list)
  {
    make_list(node_);
    for (const auto &value : list)
      Writer(element(node_)).write(value);
  }
  template <class M> void write_matrix(const M &matrix)
  {
    if constexpr (M::ColsAtCompileTime == 1)
      write_list(matrix);
    else {
      make_list(node_);
      for (Eigen::Index i = 0; i < matrix.rows(); ++i)
        Writer(element(node_)).write(Eigen::VectorXd(matrix.row(i).transpose()));
    }
  }
  Node &node_;
};

/// Reads what Writer has written.
class Reader {
public:
  explicit Reader(const Node &node) : node_(node) {}
  template <class T> void operator()(const char *name, T &value)
  {
    if (const Node *entry = find(node_, name))
      Reader(*entry).read(value);
  }
  template <class T> void read(T &value)
  {
    if constexpr (is_plain<T>)
      get(node_, value);
    else if constexpr (has_words<T>) {
      std::string word;
      get(node_, word);
      value = choice_named<T>(word).value_or(value);
    } else
      each_member(*this, value);
  }
  void read(Eigen::VectorXd &vector);
  void read(Eigen::MatrixXd &matrix);  ///< rows shorter than the longest end in NaN
  template <class T> void read(std::vector<T> &list)
  {
    list.assign(length(node_), T());
    for (std::size_t i = 0; i < list.size(); ++i)
      Reader(*element(node_, i)).read(list[i]);
  }
  template <class T, std::size_t n> void read(std::array<T, n> &list)
  {
    for (std::size_t i = 0; i < std::min(n, length(node_)); ++i)
      Reader(*element(node_, i)).read(list[i]);
  }
  template <class T> void read(std::optional<T> &value)
  {
    if (is_object(node_))
      read(value.emplace());
  }
  template <class T> void read(std::map<std::string, T> &map)
  {
    for (const std::string &name : names_in(node_))
      (*this)(name.c_str(), map[name]);
  }

private:
  const Node &node_;
};

/// A whole file.
class Document {
public:
  Document();
  /// @throws InputError  not JSON, not an object, a number too large or nested deeper than anything this program
  /// writes
  explicit Document(const std::string &text);
  ~Document();
  Node &node();
  std::string text() const;  ///< indented by one blank, '\n' at the end

private:
  std::unique_ptr<Node> node_;
};

/// Values are copied and walked through with a stack frame for each level.
/// @throws InputError  the text nests deeper than anything this program writes
void require_flat(const std::string &text);
}  // namespace json

/// The text of a file that holds one record.
template <class Record> std::string json_of_record(const Record &record)
{
  json::Document document;
  json::Writer(document.node()).write(record);
  return document.text();
}

/// @throws InputError  see json::Document
template <class Record> Record record_of_json(const std::string &text)
{
  json::Document document(text);
  Record record;
  json::Reader(document.node()).read(record);
  return record;
}
}  // namespace mill
