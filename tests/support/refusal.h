#pragma once
#include "core/errors.h"
#include <functional>
#include <string>

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
