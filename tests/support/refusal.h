#pragma once
#include "core/base/errors.h"
#include <functional>
#include <string>

/// All that an action refuses with, a line each; "accepted" where it does not.
inline std::string refusals(const std::function<void()> &action)
{
  try {
    action();
  } catch (const mill::InputError &error) {
    std::string text;
    for (const mill::Problem &problem : error.problems)
      text += (text.empty() ? "" : "\n") + problem.message;
    return text;
  }
  return "accepted";
}

/// What an action refuses with, "accepted" where it does not.
inline std::string refusal(const std::function<void()> &action)
{
  try {
    action();
  } catch (const mill::InputError &error) {
    return error.problems.at(0).message;
  }
  return "accepted";
}
