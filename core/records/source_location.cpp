#include "core/records/source_location.h"
#include "core/base/files.h"
#include "core/base/valid_text.h"
#include <filesystem>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace mill {
std::string location_of(const std::string &path)
{
  std::error_code error;
  const fs::path location = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? "" : valid_text(location.string());
}

std::string other_source(const std::string &proof, const std::string &source)
{
  const auto text       = text_if_readable(proof);
  const auto json       = nlohmann::json::parse(text.value_or(""), nullptr, false);
  const bool is_stated  = json.is_object() && json.contains(source_location) && json[source_location].is_string();
  const std::string one = is_stated ? json[source_location].get<std::string>() : "";
  std::error_code ignored;
  const bool is_other = !one.empty() && one != location_of(source) && fs::exists(one, ignored) &&
                        !fs::equivalent(one, source, ignored);
  return is_other ? one : "";
}
}  // namespace mill
