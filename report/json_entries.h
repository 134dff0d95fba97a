#pragma once
#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// Entries of a JSON object that may be missing or of another type: NaN, an empty text or an empty list then.
namespace mill::report {
using Json = nlohmann::json;

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
