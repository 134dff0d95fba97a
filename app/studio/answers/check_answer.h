#pragma once
#include "app/verbs/checked_case.h"
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace mill::studio {
/// What `millstand check` says of a text that stands in the place of a case file.
struct CheckAnswer {
  std::vector<Problem> errors;
  std::vector<Warning> remarks;
  std::vector<std::string> facts;
  std::optional<CheckedCase> checked;  ///< without errors
};
CheckAnswer check_answer(const std::string &path, const std::string &text);

/// POST /check: problems with the key that each belongs to, estimates, geometry, keys still at the template.
nlohmann::ordered_json check_json(const CheckAnswer &answer, const std::string &text);
}  // namespace mill::studio
