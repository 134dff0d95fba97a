#include "twin/records/npy_sidecar.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/valid_text.h"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill::twin {
namespace {
using Json = nlohmann::ordered_json;  // names of columns in the order in which they are written
}  // namespace

std::string NpySidecar::unit_of(const std::string &channel) const
{
  for (const auto &[name, unit] : units)
    if (name == channel)
      return unit;
  return "";
}

NpySidecar npy_sidecar(const std::string &path, const std::string &array)
{
  const auto text = text_if_readable(path);
  if (!text)
    throw InputError(fmt::format("{} is needed next to {}: {{\"rate\": 20000, \"units\": {{\"force\": \"kN\", "
                                 "\"upper_work_roll\": \"g\"}}}}",
                                 path, array));
  TextEncoding encoding{};
  const Json json = Json::parse(valid_file_text(*text, encoding), nullptr, false);
  if (!json.is_object())
    throw InputError(Place{path, 1, 1},
                     "this is not a JSON object; write {\"rate\": 20000, \"units\": {\"force\": \"kN\"}}");
  NpySidecar sidecar;
  if (json.contains("rate") && json["rate"].is_number())
    sidecar.rate = json["rate"].get<double>();
  if (json.contains("start") && json["start"].is_string())
    sidecar.start = json["start"].get<std::string>();
  if (!json.contains("units") || !json["units"].is_object())
    throw InputError(Place{path, 1, 1}, "\"units\" is missing; write \"units\": {\"force\": \"kN\", "
                                        "\"upper_work_roll\": \"g\"}, one entry for each channel");
  for (const auto &[name, unit] : json["units"].items())
    sidecar.units.emplace_back(name, unit.is_string() ? unit.get<std::string>() : "");
  return sidecar;
}
}  // namespace mill::twin
