#include "twin/live/compare/stored_object.h"
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace mill::live {
namespace {
constexpr std::size_t longest_text = 4096;  // bytes
}

StoredObject::StoredObject(const nlohmann::json &json, std::string name) : json_(&json), name_(std::move(name))
{
  if (!json.is_object())
    refuse("is not an object");
}

void StoredObject::refuse(const std::string &why) const
{
  throw DamagedState(name_ + " " + why);
}

const nlohmann::json &StoredObject::member(const char *key) const
{
  const auto member = json_->find(key);
  if (member == json_->end())
    refuse(fmt::format("has no \"{}\"", key));
  return *member;
}

bool StoredObject::has(const char *key) const
{
  return json_->contains(key);
}

double StoredObject::number(const char *key, const double low, const double high) const
{
  const auto &value = member(key);
  if (!value.is_number())
    refuse(fmt::format("has a \"{}\" that is not a number", key));
  const double number = value.get<double>();
  if (!(number >= low && number <= high))
    refuse(fmt::format("has a \"{}\" of {:g}, outside {:g} .. {:g}", key, number, low, high));
  return number;
}

double StoredObject::number_or_unknown(const char *key, const double low, const double high) const
{
  // NaN has become null in a file, and is NaN in a state that was never written
  const auto &value  = member(key);
  const bool unknown = value.is_null() || (value.is_number_float() && !std::isfinite(value.get<double>()));
  return unknown ? std::numeric_limits<double>::quiet_NaN() : number(key, low, high);
}

std::int64_t StoredObject::count(const char *key, const std::int64_t low, const std::int64_t high) const
{
  const auto &value = member(key);
  if (!value.is_number_integer())
    refuse(fmt::format("has a \"{}\" that is not a whole number", key));
  const bool beyond = value.is_number_unsigned() &&
                      value.get<std::uint64_t>() > std::uint64_t(std::numeric_limits<std::int64_t>::max());
  const std::int64_t number = beyond ? std::numeric_limits<std::int64_t>::max() : value.get<std::int64_t>();
  if (beyond || number < low || number > high)
    refuse(fmt::format("has a \"{}\" outside {} .. {}", key, low, high));
  return number;
}

bool StoredObject::flag(const char *key) const
{
  const auto &value = member(key);
  if (!value.is_boolean())
    refuse(fmt::format("has a \"{}\" that is neither true nor false", key));
  return value.get<bool>();
}

std::string StoredObject::text(const char *key) const
{
  const auto &value = member(key);
  if (!value.is_string() || value.get_ref<const std::string &>().size() > longest_text)
    refuse(fmt::format("has a \"{}\" that is not a text of at most {} bytes", key, longest_text));
  return value.get<std::string>();
}

StoredObject StoredObject::object(const char *key) const
{
  return {member(key), key};
}

Eigen::VectorXd StoredObject::numbers(const char *key, const Eigen::Index size, const double low,
                                      const double high) const
{
  const auto &value = member(key);
  if (!value.is_array() || Eigen::Index(value.size()) != size)
    refuse(fmt::format("has a \"{}\" that is not a list of {} numbers", key, size));
  Eigen::VectorXd numbers(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto &one = value[std::size_t(i)];
    numbers[i]      = one.is_number() ? one.get<double>() : std::numeric_limits<double>::quiet_NaN();
    if (!(numbers[i] >= low && numbers[i] <= high))
      refuse(fmt::format("has a \"{}\" with an entry outside {:g} .. {:g}", key, low, high));
  }
  return numbers;
}

std::vector<StoredObject> StoredObject::list(const char *key, const std::size_t most) const
{
  const auto &value = member(key);
  if (!value.is_array() || value.size() > most)
    refuse(fmt::format("has a \"{}\" that is not a list of at most {} entries", key, most));
  std::vector<StoredObject> objects;
  for (const auto &one : value)
    objects.emplace_back(one, key);
  return objects;
}
}  // namespace mill::live
