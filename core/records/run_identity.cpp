#include "core/records/run_identity.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/records/result_folder.h"
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace mill {
namespace {
const std::string id_head            = "# run_id ";
constexpr const char *summed_parts[] = {"curves", "response", "fields", "models"};
}  // namespace

std::string run_id_line(const std::string &run_id)
{
  return id_head + run_id + "\n";
}

std::string run_id_of_toml(const std::string &text)
{
  if (text.rfind(id_head, 0) != 0)
    return "";
  const auto end = std::min(text.find_first_of("\r\n"), text.size());
  return text.substr(id_head.size(), end - id_head.size());
}

void require_one_run(const std::string &file, const std::string &run_id, const std::string &other_file,
                     const std::string &other_run_id)
{
  if (run_id.empty() || other_run_id.empty() || run_id == other_run_id)
    return;
  throw InputError(
      Place{file},
      fmt::format("is of run {}, but {} in the same folder is of run {}: the folder mixes two runs; run "
                  "the case again",
                  run_id, fs::path(other_file).filename().string(), other_run_id));
}

std::string read_toml_text(const std::string &path)
{
  const fs::path file = path, folder = file.parent_path();
  const auto &names = result_names();
  if (std::find(names.begin(), names.end(), file.filename().string()) == names.end())
    return read_text(path);
  const WholeRun run(folder.string());
  const std::string text     = read_text(path);
  const std::string manifest = (folder / "run.json").string();
  const auto json            = nlohmann::json::parse(text_if_readable(manifest).value_or(""), nullptr, false);
  if (json.is_object() && json.contains("run_id") && json["run_id"].is_string())
    require_one_run(path, run_id_of_toml(text), manifest, json["run_id"].get<std::string>());
  return text;
}

bool is_summed(const std::string &name)
{
  return std::any_of(std::begin(summed_parts), std::end(summed_parts),
                     [&](const std::string &part) { return name.rfind(part + "/", 0) == 0; });
}

std::map<std::string, std::string> checksums_below(const std::string &directory,
                                                   const std::map<std::string, std::string> &known)
{
  std::map<std::string, std::string> sums;
  for (const char *part : summed_parts) {
    const std::string folder = directory + "/" + part;
    if (!fs::is_directory(folder))
      continue;
    for (const std::string &file : names_in(folder)) {
      const std::string path = folder + "/" + file, name = part + ("/" + file);
      if (!fs::is_regular_file(path))
        continue;
      const auto sum = known.find(name);
      sums[name]     = sum != known.end() ? sum->second : hash_of(read_text(path));
    }
  }
  return sums;
}

void require_unchanged(const std::string &directory, const std::map<std::string, std::string> &checksums,
                       const std::string &run_id)
{
  for (const auto &[name, sum] : checksums) {
    const std::string path = directory + "/" + name;
    if (fs::exists(path) && hash_of(read_text(path)) != sum)
      throw InputError(Place{path},
                       fmt::format("is not the file that run {} wrote: it was changed since then, or is of "
                                   "another run; run the case again, or restore the file",
                                   run_id));
  }
}
}  // namespace mill
