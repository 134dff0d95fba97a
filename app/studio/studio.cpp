#include "app/studio/studio.h"
#include "app/process/console.h"
#include "app/studio/answers/case_keys.h"
#include "app/studio/answers/check_answer.h"
#include "app/studio/answers/quick_answer.h"
#include "app/studio/request.h"
#include "core/base/choice.h"
#include "core/base/errors.h"
#include "core/case/case_edit.h"
#include "core/case/case_file.h"
#include "core/case/case_sheet.h"
#include "core/case/case_template.h"
#include "core/case/input_reference.h"
#include "core/model/case.h"
#include "core/records/result_folder.h"
#include "twin/web/server/listen_address.h"
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace mill::studio {
namespace {
// What the page asks of the document.
enum class PageEdit { hello, undo, redo, import, pin, unpin, back };
constexpr auto words_of(PageEdit)
{
  return choice_words<PageEdit>("hello", "undo", "redo", "import", "pin", "unpin", "back");
}

// What a file is that the page imports.
enum class ImportedAs { case_file, sheet };
constexpr auto words_of(ImportedAs)
{
  return choice_words<ImportedAs>("case", "sheet");
}

using nlohmann::ordered_json;

enum Route : std::size_t {
  schema_route,
  document_route,
  events_route,
  edit_route,
  check_route,
  quick_route,
  sweep_route,
  run_route,
  save_route,
  compare_route,
  file_route
};
constexpr std::size_t most_values = 61, most_edits = 2000;

ordered_json job_json(const JobState &job)
{
  return {{"id", job.id},           {"status", job.status ? word_of(*job.status) : ""},
          {"stage", job.stage},     {"percent", job.percent},
          {"seconds", job.seconds}, {"left", job.left},
          {"printed", job.printed}, {"file", job.file}};
}

std::string path_of_case(const CommandLine &command)
{
  return command.target.empty() ? "stand.toml" : command.target;
}

std::string folder_of(const CommandLine &command)
{
  return command.output.empty() ? "out/" + fs::path(path_of_case(command)).stem().string() + "-studio"
                                : command.output;
}

constexpr int usual_port = 8470;

web::PageSettings settings_of(const CommandLine &command, const std::string &folder)
{
  web::PageSettings settings;
  settings.port = usual_port;
  if (!command.studio.listen.empty()) {
    const auto listening = web::address_and_port("--listen", command.studio.listen, "127.0.0.1:8470");
    settings.address     = listening.address;
    settings.port        = listening.port;
  }
  if (!command.studio.token_file.empty()) {
    settings.token       = web::token_of_file(command.studio.token_file);
    settings.token_given = true;
  }
  if (!command.studio.host.empty())
    settings.hosts.push_back(command.studio.host);
  // A page that is open finds a program that was started again.
  std::error_code error;
  fs::create_directories(folder, error);
  if (!settings.token_given && !error)
    settings.token_keeper = folder + "/page.token";
  return settings;
}

// A program that was ended leaves what it had staged, and no later one works in its folder.
void remove_what_stays(const std::string &folder)
{
  const FolderLock alone(folder);
  if (alone.held())
    remove_leftovers(folder);
  std::error_code ignored;
  fs::remove(folder, ignored);  // only where it is empty
}

bool is_of_text(const std::string &kind, const std::string &key)
{
  const Row *row = row_of_key(kind, key);
  return row && (row->kind == Kind::quantity || row->kind == Kind::choice || row->kind == Kind::text ||
                 row->kind == Kind::path);
}
}  // namespace

Studio::Studio(const CommandLine &command)
    : command_(command), document_(path_of_case(command), [] { return template_of("four-high"); }),
      folder_(folder_of(command)), jobs_([this](const JobState &job) { publish_job(job); })
{
  const web::PageSite site{
      "millstand studio", page_table(), {{"document", "run"}, {}}, [this](const web::PageRequest &request) {
        opened_.wait();  // the server answers before emplace() has returned it
        return answer(request);
      }};
  web::PageSettings settings = settings_of(command, folder_);
  try {
    server_.emplace(settings, site);
  } catch (const InputError &) {
    if (!command.studio.listen.empty())
      throw;
    settings.port = 0;  // the usual one is taken, by the studio of another case
    server_.emplace(settings, site);
  }
  open_.set_value();
}

// Requests that are answered until the server has ended find the jobs still there, but nothing runs any more that
// would publish by a server in its destructor.
Studio::~Studio()
{
  jobs_.end();
}

std::string Studio::url() const
{
  return server_->url();
}

std::string Studio::notice() const
{
  const std::string of_page = server_->notice();
  return document_.notice() + (of_page.empty() || document_.notice().empty() ? "" : "\n") +
         (of_page.empty() ? "" : "warning: " + of_page);
}

web::PageReply Studio::answer(const web::PageRequest &request)
{
  switch (Route(request.route)) {
  case schema_route:
    return {200, schema_json(kind_of_text(document_.state().text))};
  case document_route:
    return document();
  case edit_route:
    return edit(request.body);
  case check_route:
    return check(request.body);
  case quick_route:
    return quick(request.body);
  case sweep_route:
    return sweep(request.body);
  case run_route:
    return run(request.body);
  case save_route:
    return save();
  case compare_route:
    return compare(request.body);
  case file_route:
    return file_of_run(request.path);
  case events_route:
    break;
  }
  return {404, "{}"};
}

// The kind that the text names; a four-high stand where it names none.
std::string Studio::kind_of_text(const std::string &text) const
{
  const Node root   = read_case_text(document_.path(), text);
  const auto *entry = root.find("kind");
  const auto &kinds = case_kinds();
  const bool known  = entry && std::find(kinds.begin(), kinds.end(), entry->value.text) != kinds.end();
  return known ? entry->value.text : "four-high";
}

web::PageReply Studio::document() const
{
  const DocumentState s = document_.state();
  std::error_code no_folder;
  ordered_json out{{"revision", s.revision},
                   {"path", document_.path()},
                   {"case", fs::absolute(document_.path(), no_folder).lexically_normal().string()},
                   {"notice", document_.notice()},
                   {"saved", s.saved},
                   {"undo", s.undo},
                   {"redo", s.redo},
                   {"folder", folder_},
                   {"pins", ordered_json::array()},
                   {"job", job_json(jobs_.state())}};
  const auto run_of = [&](const std::string &text) {
    std::string id;
    std::error_code ignored;
    for (const StoredRun &run : s.runs)
      if (run.text == text && fs::exists(folder_ + "/" + run.id + "/results.json", ignored))
        id = run.id;
    return id;
  };
  out["run"] = run_of(s.text);
  for (const Pin &pin : s.pins)
    out["pins"].push_back({{"name", pin.name}, {"run", run_of(pin.text)}, {"same", pin.text == s.text}});
  for (const WrittenValue &value : written_values(s.text))
    out["values"][value.key] = value.text;
  return {200, text_of(out)};
}

void Studio::publish_document(const std::string &by)
{
  server_->publish("document", text_of({{"revision", document_.state().revision}, {"by", by}}));
}

void Studio::publish_job(const JobState &job)
{
  if (job.status == JobStatus::cancelled || job.status == JobStatus::failed)
    remove_what_stays(folder_ + "/" + job.id);
  if (server_)
    server_->publish("run", text_of(job_json(job)));
}

// A case file in place of the present one, or a sheet that fills a template.
void Studio::import(const nlohmann::json &request)
{
  const std::string text = word(request, "text"), name = word(request, "name");
  if (choice_named<ImportedAs>(word(request, "as")) == ImportedAs::case_file) {
    document_.replace(text);
    return;
  }
  document_.replace(
      template_from_sheet(kind_of_text(document_.state().text), name.empty() ? "the sheet" : name, text));
}

web::PageReply Studio::edit(const std::string &body)
{
  const auto request   = object_of(body);
  const auto op        = choice_named<PageEdit>(word(request, "op"));
  const std::string by = word_if_given(request, "by");  // before anything is changed
  if (op == PageEdit::hello) {
    server_->publish("windows", text_of({{"open", server_->statistics().event_streams}}));
    return document();
  }
  try {
    if (!op)
      throw InputError("an unknown operation");
    switch (*op) {
    case PageEdit::hello:
      break;
    case PageEdit::undo:
      document_.undo();
      break;
    case PageEdit::redo:
      document_.redo();
      break;
    case PageEdit::import:
      import(request);
      break;
    case PageEdit::pin:
      document_.pin(word(request, "name"));
      break;
    case PageEdit::unpin:
      document_.unpin(word(request, "name"));
      break;
    case PageEdit::back:
      document_.back_to(word(request, "name"));
    }
  } catch (const InputError &error) {
    ordered_json problems = ordered_json::array();
    for (const Problem &problem : error.problems)
      problems.push_back({{"line", problem.place.line}, {"message", problem.message}});
    return {400, text_of({{"error", error.problems.empty() ? error.what() : error.problems.front().message},
                          {"problems", problems}})};
  }
  publish_document(by);
  return document();
}

web::PageReply Studio::check(const std::string &body)
{
  const auto request   = object_of(body);
  const std::string by = word_if_given(request, "by");
  std::vector<Edit> edits;
  std::vector<RefusedEdit> refused;
  std::size_t asked      = 0;
  const std::string kind = kind_of_text(document_.state().text);
  if (const auto list = request.find("edits"); list != request.end()) {
    if (!list->is_array() || list->size() > most_edits)
      throw InputError(fmt::format("\"edits\" is a list of at most {}", most_edits));
    asked = list->size();
    for (const auto &edit : *list) {
      if (!edit.is_object())
        throw InputError("an edit has id, key and value");
      const std::string id = word(edit, "id"), key = word(edit, "key");
      const auto value     = edit.find("value");
      const bool removed   = value == edit.end() || value->is_null();
      const std::string as = removed ? "" : word(edit, "value");
      try {
        edits.push_back({id, key, removed ? "" : toml_as_typed(as, is_of_text(kind, key))});
      } catch (const InputError &error) {
        refused.push_back({id, error.problems.empty() ? error.what() : error.problems.front().message});
      }
    }
  }
  const long before = document_.state().revision;
  for (RefusedEdit &edit : document_.set(edits))
    refused.push_back(std::move(edit));
  ordered_json refusals = ordered_json::array();
  for (const RefusedEdit &edit : refused)
    refusals.push_back({{"id", edit.id}, {"error", edit.message}});
  if (asked > 0 && refused.size() == asked)
    return {400, text_of({{"error", refused.front().message}, {"refused", refusals}})};
  const DocumentState s    = document_.state();
  const CheckAnswer answer = check_answer(document_.path(), s.text);
  ordered_json out         = check_json(answer, s.text);
  out["revision"]          = s.revision;
  out["saved"]             = s.saved;
  out["undo"]              = s.undo;
  out["redo"]              = s.redo;
  out["refused"]           = refusals;
  if (s.revision != before)
    publish_document(by);
  return {200, text_of(out)};
}

web::PageReply Studio::quick(const std::string &body)
{
  const auto request = object_of(body);
  DocumentState s    = document_.state();
  ordered_json out;
  if (request.contains("pin")) {
    const auto pin = std::find_if(s.pins.begin(), s.pins.end(),
                                  [name = word(request, "pin")](const Pin &p) { return p.name == name; });
    if (pin == s.pins.end())
      throw InputError("no state is pinned under this name");
    s.text = pin->text;
    for (const WrittenValue &value : written_values(s.text))
      out["values"][value.key] = value.text;
  }
  const std::lock_guard lock(memory_access_);
  const auto begin = std::chrono::steady_clock::now();
  try {
    const Case the_case = read_case_of(document_.path(), s.text);
    out.update(quick_json(quick_answer(the_case, memory_)));
  } catch (const InputError &error) {
    out["error"] = error.problems.empty() ? error.what() : error.problems.front().message;
  } catch (const SolverError &error) {
    out["error"] = error.report.what;
  }
  out["revision"] = s.revision;
  out["seconds"]  = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return {200, text_of(out)};
}

// One key through a list of values, all else as it is: a row for each, without an answer where the value is
// refused.
web::PageReply Studio::sweep(const std::string &body)
{
  const auto request    = object_of(body);
  const std::string key = word(request, "key");
  const auto values     = request.find("values");
  if (values == request.end() || !values->is_array() || values->size() > most_values)
    throw InputError(fmt::format("\"values\" is a list of at most {} texts", most_values));
  const DocumentState s  = document_.state();
  const std::string kind = kind_of_text(s.text);
  ordered_json out{{"key", key}, {"revision", s.revision}, {"rows", ordered_json::array()}};
  const std::lock_guard lock(memory_access_);
  for (const auto &value : *values) {
    ordered_json row{{"value", value}};
    try {
      if (!value.is_string())
        throw InputError("a value is a text");
      const auto text = with_value(s.text, key, toml_as_typed(value.get<std::string>(), is_of_text(kind, key)));
      const QuickAnswer answer = quick_answer(read_case_of(document_.path(), text), memory_);
      for (const ClosedFormResult &r : answer.results)
        if (std::isfinite(r.parameter.value))
          row["results"][r.name] = r.parameter.value;
      for (const SpeedVerdict &v : answer.speeds)
        if (std::isfinite(v.critical))
          row["results"]["critical_speed." + v.pass] = v.critical;
    } catch (const InputError &error) {
      row["error"] = error.problems.empty() ? error.what() : error.problems.front().message;
    } catch (const SolverError &error) {
      row["error"] = error.report.what;
    }
    out["rows"].push_back(std::move(row));
  }
  return {200, text_of(out)};
}

web::PageReply Studio::save()
{
  document_.save();
  publish_document("");
  return document();
}

}  // namespace mill::studio
