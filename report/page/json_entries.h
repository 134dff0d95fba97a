#pragma once
#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// Entries of a JSON object that may be missing or of another type: NaN, an empty text or an empty list then.
namespace mill::report {
using Json = nlohmann::json;

/// Values are copied and walked through with a stack frame for each level.
/// @throws InputError  the text nests deeper than anything this program writes
void require_flat(const std::string &json);

/// A text as JSON.  @throws InputError  as require_flat;  nlohmann::json::exception  not JSON, or a number too
/// large
template <class J = Json> J json_of(const std::string &text)
{
  require_flat(text);
  return J::parse(text);
}

const Json *entry_of(const Json &object, const char *key);  ///< nullptr when absent
double number_of(const Json *value);
double number(const Json &object, const char *key);
int count(const Json &object, const char *key);  ///< 0 when absent
bool flag(const Json &object, const char *key);  ///< false when absent
std::string text(const Json &object, const char *key);
const Json &list(const Json &object, const char *key);
std::vector<std::string> texts(const Json &object, const char *key);
Eigen::VectorXd numbers_of(const Json &values);
Eigen::VectorXd numbers(const Json &object, const char *key);
}  // namespace mill::report
