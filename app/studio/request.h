#pragma once
#include "core/base/errors.h"
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

// How requests are read and answers written.
namespace mill::studio {
inline std::string text_of(const nlohmann::ordered_json &json)
{
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// An object of a request, not nested deeper than any of ours is.
inline nlohmann::json object_of(const std::string &body)
{
  try {
    const auto json = nlohmann::json::parse(body.empty() ? "{}" : body,
                                            [](const int depth, nlohmann::json::parse_event_t, auto &) {
                                              if (depth > 8)
                                                throw InputError("the request is nested too deeply");
                                              return true;
                                            });
    if (json.is_object())
      return json;
  } catch (const nlohmann::json::exception &) {
  }
  throw InputError("the request must be a JSON object");
}

/// A text among its members.  @throws InputError
inline std::string word(const nlohmann::json &request, const char *name)
{
  const auto entry = request.find(name);
  if (entry == request.end() || !entry->is_string())
    throw InputError(fmt::format("\"{}\" must be given, as a text", name));
  return entry->get<std::string>();
}

/// As word(); empty where it is not given.  @throws InputError  it is not a text
inline std::string word_if_given(const nlohmann::json &request, const char *member)
{
  return request.contains(member) ? word(request, member) : "";
}
}  // namespace mill::studio
