#include "app/command/option_words.h"
#include "app/studio/request.h"
#include "app/studio/studio.h"
#include "core/base/choice.h"
#include "core/base/file_ending.h"
#include "core/base/files.h"
#include "report/compare/comparison.h"
#include <algorithm>
#include <filesystem>

namespace fs = std::filesystem;

// Runs of the studio: begun, compared, read.
namespace mill::studio {
namespace {
// What the page asks of the work; else it names the format of an export.
enum class RunOrder { run, cancel };
constexpr auto words_of(RunOrder)
{
  return choice_words<RunOrder>("run", "cancel");
}

using nlohmann::ordered_json;
constexpr std::uintmax_t largest_file = 64 << 20;
constexpr const char *comparison_file = "comparison.html";

// The number of the next run: no folder of an earlier one is written into.
std::string next_id(const std::string &folder, const std::string &what)
{
  for (int n = 1;; ++n) {
    const std::string id = fmt::format("{}-{}", what, n);
    std::error_code ignored;
    if (!fs::exists(folder + "/" + id, ignored) && !fs::exists(folder + "/" + id + ".toml", ignored))
      return id;
  }
}

const char *type_of(const std::string &ending)
{
  constexpr const char *types[][2] = {
      {".html", "text/html; charset=utf-8"}, {".json", "application/json"},
      {".csv", "text/csv; charset=utf-8"},   {".toml", "text/plain; charset=utf-8"},
      {".log", "text/plain; charset=utf-8"}, {".m", "text/plain; charset=utf-8"},
      {".mo", "text/plain; charset=utf-8"}};
  for (const auto &type : types)
    if (ending == type[0])
      return type[1];
  return "application/octet-stream";
}

// "run-3/curves/modes.csv": letters, digits, points and lines, no hidden file and no way up.
bool is_plain_path(const std::string &path)
{
  bool begins = true;
  for (const char c : path) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (c == '/' ? begins : begins ? !letter : !letter && c != '-' && c != '.')
      return false;
    begins = c == '/';
  }
  return !path.empty() && !begins;
}
}  // namespace

web::PageReply Studio::run(const std::string &body)
{
  const auto request     = object_of(body);
  const std::string what = word(request, "what");
  const auto order       = choice_named<RunOrder>(what);
  if (order == RunOrder::cancel) {
    jobs_.cancel();
    return {202, "{}"};
  }
  const auto format   = choice_named<ExportFormat>(what);
  const bool exported = format && *format != ExportFormat::statespace;
  if (!order && !exported)
    throw InputError("\"what\" is run, fmu, modelica, matlab or cancel");
  const std::lock_guard one_at_a_time(run_access_);  // two have not the same number
  if (jobs_.state().status == JobStatus::running)
    return {409, text_of({{"error", jobs_.state().id + " is running; wait for its end, or cancel it"}})};
  std::error_code error;
  fs::create_directories(folder_, error);
  const std::string id = next_id(folder_, exported ? "export" : "run"), text = document_.state().text,
                    file = folder_ + "/" + id + ".toml";
  write_atomically(file, text);
  std::vector<std::string> words;
  std::string made;
  if (exported) {
    fs::create_directories(folder_ + "/" + id, error);
    const std::string ending = *format == ExportFormat::fmu        ? ".fmu"
                               : *format == ExportFormat::modelica ? ".mo"
                                                                   : ".m";
    made                     = slug(fs::path(document_.path()).stem().string()) + ending;
    words = {"export", what, document_.path(), "-o", folder_ + "/" + id + "/" + made, "--force-overwrite"};
  } else {
    words = {"run", document_.path(), "-o", folder_ + "/" + id};
  }
  for (const char *word : {"--progress-step", "1", "--text"})
    words.emplace_back(word);
  words.push_back(file);
  if (!command_.cache.empty())
    words.insert(words.end(), {"--cache", command_.cache});
  jobs_.start(id, exported ? "millstand-all" : "millstand", words, made);
  if (!exported)
    document_.add_run({id, text});
  return {202, text_of({{"id", id}})};
}

web::PageReply Studio::compare(const std::string &body)
{
  const auto request = object_of(body);
  const auto names   = request.find("pins");
  if (names == request.end() || !names->is_array() || names->size() < 2 || names->size() > 6)
    throw InputError("\"pins\" is a list of two to six names");
  const DocumentState s = document_.state();
  std::vector<std::string> directories;
  for (const auto &name : *names) {
    const std::string wanted = name.is_string() ? name.get<std::string>() : "";
    const auto pin = std::find_if(s.pins.begin(), s.pins.end(), [&](const Pin &p) { return p.name == wanted; });
    std::string directory;
    std::error_code ignored;
    for (const StoredRun &run : s.runs)
      if (pin != s.pins.end() && run.text == pin->text &&
          fs::exists(folder_ + "/" + run.id + "/results.json", ignored))
        directory = folder_ + "/" + run.id;
    if (directory.empty())
      return {409, text_of({{"error", "the pin \"" + wanted + "\" has no run; go back to it and press Run"}})};
    if (std::find(directories.begin(), directories.end(), directory) != directories.end())
      return {409, text_of({{"error", "these pins are one state; nothing differs"}})};
    directories.push_back(directory);
  }
  write_atomically(folder_ + "/" + comparison_file, report::comparison_of(directories));
  return {200, text_of({{"path", std::string("/run/") + comparison_file}})};
}

web::PageReply Studio::file_of_run(const std::string &path) const
{
  const std::string name = path.substr(std::min(path.size(), std::string("/run/").size()));
  const fs::path file    = fs::path(folder_) / name;
  std::error_code error;
  const auto status  = fs::symlink_status(file, error);
  const bool of_ours = name.rfind("run-", 0) == 0 || name.rfind("export-", 0) == 0 || name == comparison_file;
  if (!of_ours || !is_plain_path(name) || error || !fs::is_regular_file(status) ||
      fs::file_size(file, error) > largest_file)
    return {404, text_of({{"error", "there is nothing at this path"}})};
  // A report has scripts of its own, and a title that others may have chosen: it gets no origin, so that it can
  // ask this server nothing.
  const bool page = has_ending(file, FileEnding::html);
  return {
      200, read_text(file.string()), type_of(file.extension().string()),
      page ? "sandbox allow-scripts allow-popups allow-downloads; default-src 'none'; script-src 'unsafe-inline'; "
             "style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'; "
             "frame-ancestors 'self'"
           : ""};
}
}  // namespace mill::studio
