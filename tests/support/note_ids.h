#pragma once
#include <nlohmann/json.hpp>
#include <set>
#include <string>

/// Ids of the notes that decide something, of advice.json, calibration.json or analysis.json.
inline std::set<std::string> note_ids(const nlohmann::json &document)
{
  std::set<std::string> ids;
  for (const auto &record : document.at("note_records"))
    ids.insert(record.at("id").get<std::string>());
  return ids;
}
