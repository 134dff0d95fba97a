#include "report/page/json_entries.h"
#include "core/case/errors.h"
#include <cmath>
#include <limits>

namespace mill::report {
void require_flat(const std::string &json)
{
  constexpr int deepest = 64;  // what this program writes has seven levels
  int depth             = 0;
  bool in_text          = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '\\' && in_text)
      ++i;
    else if (c == '"')
      in_text = !in_text;
    else if (!in_text && (c == '[' || c == '{') && ++depth > deepest)
      throw InputError("this JSON nests deeper than 64 levels");
    else if (!in_text && (c == ']' || c == '}'))
      --depth;
  }
}

const Json *entry_of(const Json &object, const char *key)
{
  if (!object.is_object())
    return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

double number_of(const Json *value)
{
  return value && value->is_number() ? value->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

double number(const Json &object, const char *key)
{
  return number_of(entry_of(object, key));
}

int count(const Json &object, const char *key)
{
  const Json *value   = entry_of(object, key);
  const double number = value && value->is_number() ? value->get<double>() : 0;
  return std::abs(number) < 1e9 ? int(number) : 0;
}

bool flag(const Json &object, const char *key)
{
  const Json *value = entry_of(object, key);
  return value && value->is_boolean() && value->get<bool>();
}

std::string text(const Json &object, const char *key)
{
  const Json *value = entry_of(object, key);
  return value && value->is_string() ? value->get<std::string>() : "";
}

const Json &list(const Json &object, const char *key)
{
  static const Json none = Json::array();
  const Json *value      = entry_of(object, key);
  return value && value->is_array() ? *value : none;
}

std::vector<std::string> texts(const Json &object, const char *key)
{
  std::vector<std::string> all;
  for (const Json &entry : list(object, key))
    all.push_back(entry.is_string() ? entry.get<std::string>() : "");
  return all;
}

Eigen::VectorXd numbers_of(const Json &values)
{
  Eigen::VectorXd all = Eigen::VectorXd::Zero(values.is_array() ? Eigen::Index(values.size()) : 0);
  for (Eigen::Index i = 0; i < all.size(); ++i)
    all[i] = number_of(&values[std::size_t(i)]);
  return all;
}

Eigen::VectorXd numbers(const Json &object, const char *key)
{
  return numbers_of(list(object, key));
}
}  // namespace mill::report
