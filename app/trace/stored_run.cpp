#include "app/trace/stored_run.h"
#include "app/trace/trace_key.h"
#include "core/base/files.h"
#include "core/model/case.h"
#include "core/records/result_folder.h"
#include "core/records/run_identity.h"
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace mill {
namespace {
// The same value of every key that both know: a later version may know more keys.
bool same_values(const std::string &a, const std::string &b)
{
  const auto one = resolved_values(a), other = resolved_values(b);
  return std::all_of(one.begin(), one.end(), [&](const auto &entry) {
    const auto match = other.find(entry.first);
    return match == other.end() || match->second == entry.second;
  });
}

void take_number(std::map<std::string, double> &into, const std::string &name, const nlohmann::json &entry,
                 const char *key)
{
  if (const auto number = entry.find(key); number != entry.end() && number->is_number())
    into[name] = number->get<double>();
}
}  // namespace

std::string folder_of_run(const std::string &named, const Case &the_case)
{
  return named.empty() ? "out/" + the_case.name : named;
}

std::optional<StoredRun> stored_run(const std::string &folder, const Case &the_case)
{
  StoredRun run;
  run.folder             = folder;
  const std::string file = run.folder + "/results.json";
  const WholeRun whole(run.folder);
  if (!std::filesystem::exists(file))
    return {};
  const auto json = nlohmann::json::parse(read_text(file), nullptr, false);
  if (!json.is_object() || !json.contains("values") || !json["values"].is_object())
    return {};
  for (const auto &[name, entry] : json["values"].items())
    if (entry.is_object()) {
      take_number(run.values, name, entry, "value");
      take_number(run.errors, name, entry, "error_estimate");
      if (const auto keys = entry.find("inputs"); keys != entry.end() && keys->is_array())
        for (const auto &key : *keys)
          if (key.is_string())
            run.inputs[name].push_back(key.get<std::string>());
    }
  const std::string resolved = run.folder + "/resolved.toml";
  if (!std::filesystem::exists(resolved)) {
    run.same_inputs = false;
    return run;
  }
  const std::string inputs = read_text(resolved);
  const auto run_id        = json.find("run_id");
  if (run_id != json.end() && run_id->is_string())
    require_one_run(file, run_id->get<std::string>(), resolved, run_id_of_toml(inputs));
  run.same_inputs = same_values(inputs, the_case.resolved);
  return run;
}
}  // namespace mill
