#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <vector>

// The state that an earlier program left on the disk is read as foreign text: for any content, a value is
// right or refused.
namespace mill::live {
/// A part of a stored state is not a value that a program of this version writes; what() names it and the reason.
class DamagedState : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// An object of a stored state.  Every reader throws DamagedState where the member is absent, of another type or
/// out of its range.
class StoredObject {
public:
  /// @param name  of it in sentences: "state", "motion"
  StoredObject(const nlohmann::json &json, std::string name);

  bool has(const char *key) const;
  double number(const char *key, double low, double high) const;
  double number_or_unknown(const char *key, double low, double high) const;  ///< null: NaN
  std::int64_t count(const char *key, std::int64_t low, std::int64_t high) const;
  bool flag(const char *key) const;
  std::string text(const char *key) const;  ///< at most 4096 bytes
  StoredObject object(const char *key) const;
  /// @param size  that it has to have
  Eigen::VectorXd numbers(const char *key, Eigen::Index size, double low, double high) const;
  /// Objects of a list.  @param most  of them
  std::vector<StoredObject> list(const char *key, std::size_t most) const;
  /// Throws DamagedState with the name of this object before it.
  [[noreturn]] void refuse(const std::string &why) const;

private:
  const nlohmann::json &member(const char *key) const;

  const nlohmann::json *json_;
  std::string name_;
};

constexpr std::int64_t largest_number = std::int64_t(1) << 53;  ///< -, of a sample, up to which all are exact
constexpr double latest_time          = 2e11;   ///< s since 1970; beyond, a date has no four digits
constexpr double earliest_time        = -6e10;  ///< s since 1970
constexpr double any_size             = 1e150;  ///< its square is a number too
}  // namespace mill::live
