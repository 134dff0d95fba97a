#pragma once
#include "tests/support/program.h"
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

/// results.json of a run into scratch(name).
inline nlohmann::json results_of(const std::string &name)
{
  return nlohmann::json::parse(std::ifstream(scratch(name) + "/results.json"));
}

/// @param results  the whole file, as results_of() returns it
inline double value(const nlohmann::json &results, const std::string &name)
{
  return results.at("values").at(name).at("value").get<double>();
}

/// The first warning with this id, by its parts; null without one.
inline nlohmann::json warning_with(const nlohmann::json &results, const std::string &id)
{
  for (const auto &record : results.at("warning_records"))
    if (record.at("id") == id)
      return record;
  return nullptr;
}

/// @param values  results_of(..).at("values")
inline double of(const nlohmann::json &values, const std::string &name, const char *member = "value")
{
  return values.at(name).at(member).get<double>();
}

/// What stands beside a result under the name of a check; fails the test where there is none.
inline double check_of(const nlohmann::json &values, const std::string &name, const std::string &check)
{
  for (const auto &c : values.at(name).at("checks"))
    if (c.at("name") == check)
      return c.at("value");
  ADD_FAILURE() << name << " has no check " << check;
  return 0;
}
