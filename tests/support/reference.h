#pragma once
#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <ostream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// A value of tests/reference, or a part of it.  In place of the JSON itself, whose header takes each test that
/// compares numbers two seconds to compile.
class Reference {
public:
  explicit Reference(const nlohmann::json &json) : json(&json) {}  ///< kept by reference()

  /// Parts of a list or an object.  @throws std::exception  there is none
  Reference operator[](int index) const;
  Reference operator[](const std::string &key) const;
  Reference operator[](const char *key) const
  {
    return (*this)[std::string(key)];
  }
  Reference at(const std::string &key) const
  {
    return (*this)[key];
  }
  std::size_t size() const;
  bool empty() const
  {
    return size() == 0;
  }
  bool contains(const std::string &key) const;

  class Iterator {
  public:
    Iterator(const Reference &list, int index) : list(list), index(index) {}
    Reference operator*() const
    {
      return list[index];
    }
    Iterator &operator++()
    {
      return ++index, *this;
    }
    bool operator!=(const Iterator &other) const
    {
      return index != other.index;
    }

  private:
    const Reference &list;
    int index;
  };
  Iterator begin() const
  {
    return {*this, 0};
  }  ///< of a list
  Iterator end() const
  {
    return {*this, int(size())};
  }

  std::vector<std::pair<std::string, Reference>> items() const;  ///< of an object

  /// T: numbers, bool, std::string, vectors of numbers or texts, rows and maps of numbers.
  template <class T> T get() const;
  template <class T, class = std::enable_if_t<!std::is_pointer_v<T>>> operator T() const
  {
    return get<T>();
  }

  friend std::ostream &operator<<(std::ostream &out, const Reference &value);

private:
  const nlohmann::json *json;
};

/// Value of one entry of tests/reference/<file>.json: numbers computed outside this program from published
/// equations (the files say which), SI.  Throws when the entry is missing.
Reference reference(const std::string &entry, const std::string &file = "stand");

/// An entry that is a list of numbers.
Eigen::VectorXd reference_vector(const std::string &entry, const std::string &file = "stand");
