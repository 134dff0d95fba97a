#include "twin/analysis/baseline.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/valid_text.h"
#include "core/records/result_folder.h"
#include "core/records/rows_of_response.h"
#include "twin/analysis/channel_analysis.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace mill::twin {
Baseline read_baseline(const std::string &folder)
{
  using nlohmann::json;
  const std::string path = folder + "/analysis.json";
  const WholeRun complete(folder);  // an analysis that is replaced now is waited for
  const auto text = text_if_readable(path);
  if (!text)
    throw InputError("the baseline " + folder +
                     " holds no analysis.json; name the folder of an earlier millstand analyse");
  const json document = json::parse(*text, nullptr, false);
  if (!document.is_object() || !document.contains("values") || !document.contains("findings") ||
      !document["values"].is_object())
    throw InputError(Place{path, 1, 1}, "this is not an analysis.json of this program; analyse the record again");
  Baseline baseline;
  baseline.folder   = valid_text(folder);
  const json record = document.value("record", json::object());
  baseline.record   = record.is_object() && record.contains("file") && record["file"].is_string()
                          ? record["file"].get<std::string>()
                          : valid_text(folder);
  const double rate = record.is_object() && record.contains("rate") && record["rate"].is_number()
                          ? record["rate"].get<double>()
                          : std::nan("");
  for (const auto &[name, value] : document["values"].items())
    if (const auto id = result_id(name); id && id->is_of(row::record::velocity_rms) && value.is_object() &&
                                         value.contains("value") && value["value"].is_number())
      baseline.velocity_rms[id->place("channel")] = {value["value"].get<double>(), rate};
  const auto text_of = [](const json &one, const char *key) {
    return one.contains(key) && one[key].is_string() ? one[key].get<std::string>() : std::string();
  };
  if (document.contains("bearings"))
    for (const json &one : document["bearings"])
      if (one.is_object() && one.contains("score") && one["score"].is_number())
        baseline.score[{text_of(one, "channel"), text_of(one, "bearing"), text_of(one, "family")}] =
            one["score"].get<double>();
  return baseline;
}

Baseline read_baselines(const std::vector<std::string> &folders)
{
  Baseline all;
  std::map<std::string, std::vector<VelocityLevel>> levels;
  for (const std::string &folder : folders) {
    const Baseline one = read_baseline(folder);
    all.folder += (all.folder.empty() ? "" : ", ") + one.folder;
    all.record += (all.record.empty() ? "" : ", ") + one.record;
    for (const auto &[channel, velocity] : one.velocity_rms)
      levels[channel].push_back(velocity);
    for (const auto &[family, score] : one.score)
      all.score[family] = std::max(all.score[family], score);
  }
  for (const auto &[channel, of_channel] : levels) {
    double squares = 0, rate = of_channel.front().rate;
    for (const VelocityLevel &level : of_channel) {
      squares += level.value * level.value;
      if (!have_one_band(level.rate, rate))
        rate = std::nan("");
    }
    all.velocity_rms[channel] = {std::sqrt(squares / double(of_channel.size())), rate};
  }
  return all;
}
}  // namespace mill::twin
