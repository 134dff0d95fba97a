#pragma once
#include "twin/advice/advice.h"
#include <stdexcept>
#include <string>

/// An action of an advice by its name.
template <class Advice> const mill::twin::RatedAction &action(const Advice &advice, const std::string &name)
{
  for (const mill::twin::RatedAction &one : advice.actions)
    if (one.name == name)
      return one;
  throw std::logic_error("no action " + name);
}

inline double effect(const mill::twin::RatedAction &action, const std::string &name)
{
  for (const mill::twin::SideEffect &one : action.effects)
    if (one.name == name)
      return one.value;
  throw std::logic_error("no effect " + name);
}
