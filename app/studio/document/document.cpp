#include "app/studio/document/document.h"
#include "app/studio/document/journal.h"
#include "core/base/choice.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/save_in_place.h"
#include "core/case/case_edit.h"
#include "core/case/case_file.h"
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

namespace fs = std::filesystem;

namespace mill::studio {
namespace {
using nlohmann::json;
constexpr std::size_t most_steps = 1000;  // that can be taken back
constexpr std::size_t most_pins  = 50;
constexpr std::size_t largest    = 4 << 20;  // bytes of a journal before it begins again

std::optional<std::string> text_on_disk(const std::string &path)
{
  std::error_code ignored;
  return fs::exists(path, ignored) ? std::optional(read_text(path)) : std::nullopt;
}

// All that a change does; the journal is made of its lines.
// What a line of the journal does.
enum class LineOf { set, undo, redo, text, saved, pin, unpin, run };
constexpr auto words_of(LineOf)
{
  return choice_words<LineOf>("set", "undo", "redo", "text", "saved", "pin", "unpin", "run");
}

struct History {
  std::string text, on_disk;
  long revision = 0;
  std::vector<std::string> before, after;
  std::vector<Pin> pins;
  std::vector<StoredRun> runs;
  std::set<std::string> done;  // ids of edits

  void to(std::string next)
  {
    if (next == text)
      return;
    before.push_back(std::move(text));
    if (before.size() > most_steps)
      before.erase(before.begin());
    after.clear();
    text = std::move(next);
    ++revision;
  }
  void step(std::vector<std::string> &from, std::vector<std::string> &other)
  {
    if (from.empty())
      return;
    other.push_back(std::move(text));
    text = std::move(from.back());
    from.pop_back();
    ++revision;
  }
  Pin *pin_named(const std::string &name)
  {
    const auto pin = std::find_if(pins.begin(), pins.end(), [&](const Pin &p) { return p.name == name; });
    return pin == pins.end() ? nullptr : &*pin;
  }

  void set(const json &edits)
  {
    std::string next = text;
    for (const json &edit : edits) {
      const std::string id = edit.at("id").get<std::string>();
      if (!id.empty() && done.count(id) > 0)
        continue;
      next = with_value(next, edit.at("key").get<std::string>(), edit.at("toml").get<std::string>());
      if (!id.empty())
        done.insert(id);
    }
    to(std::move(next));
  }

  void take(const json &line)
  {
    const auto word = [&](const char *name) { return line.at(name).get<std::string>(); };
    const auto op   = choice_named<LineOf>(word("op"));
    if (!op)
      return;
    switch (*op) {
    case LineOf::set:
      return set(line.at("edits"));
    case LineOf::undo:
      return step(before, after);
    case LineOf::redo:
      return step(after, before);
    case LineOf::text:
      return to(word("text"));
    case LineOf::saved:
      on_disk = text;
      return;
    case LineOf::pin: {
      const std::string pinned = line.contains("text") ? word("text") : text;
      if (Pin *known = pin_named(word("name")))
        known->text = pinned;
      else
        pins.push_back({word("name"), pinned});
      return;
    }
    case LineOf::unpin:
      pins.erase(std::remove_if(pins.begin(), pins.end(), [&](const Pin &p) { return p.name == word("name"); }),
                 pins.end());
      return;
    case LineOf::run:
      runs.push_back({word("id"), word("text")});
    }
  }
};
}  // namespace

struct Document::State {
  std::string path, notice;
  bool is_new = false;
  mutable std::mutex access;
  History history;
  std::optional<Journal> journal;

  json first_line() const
  {
    return {{"millstand_studio", 1}, {"text", history.on_disk}};
  }

  void change(const json &line)
  {
    journal->append(line.dump(-1, ' ', false, json::error_handler_t::replace));
    history.take(line);
    if (journal->bytes() > largest)
      begin_again();
  }

  // Pins and runs stay; what could be taken back is gone.
  void begin_again()
  {
    std::vector<std::string> lines{first_line().dump()};
    for (const Pin &pin : history.pins)
      lines.push_back(json{{"op", word_of(LineOf::pin)}, {"name", pin.name}, {"text", pin.text}}.dump());
    for (const StoredRun &run : history.runs)
      lines.push_back(json{{"op", word_of(LineOf::run)}, {"id", run.id}, {"text", run.text}}.dump());
    if (history.text != history.on_disk)
      lines.push_back(json{{"op", word_of(LineOf::text)}, {"text", history.text}}.dump());
    journal->replace(lines);
  }

  // What an earlier studio had at its end; nothing where its lines cannot be read.
  static std::optional<History> replayed(const std::vector<std::string> &lines)
  {
    History old;
    try {
      for (std::size_t i = 0; i < lines.size(); ++i) {
        const json line = json::parse(lines[i]);
        if (i == 0)
          old.text = old.on_disk = line.at("text").get<std::string>();
        else
          old.take(line);
      }
    } catch (const json::exception &) {
      return {};
    } catch (const InputError &) {
      return {};
    }
    return old;
  }

  // @param on_disk  text of the case file now; empty without one
  // @return  false: the file is another one than that of the journal.  Its pins and runs are taken over then, and
  // edits that no file holds are set aside.
  bool take_up(const std::vector<std::string> &lines, const std::string &on_disk)
  {
    std::optional<History> old = replayed(lines);
    if (old && old->on_disk != on_disk && old->text == on_disk) {  // saved, and ended before the journal had it
      history = std::move(*old);
      change({{"op", word_of(LineOf::saved)}});
      return true;
    }
    if (old && old->on_disk == on_disk) {
      history = std::move(*old);
      if (history.text != history.on_disk)
        notice = "Changes that were not saved have been taken up again.";
      return true;
    }
    notice =
        old ? "The case file was changed outside of the studio." : "The journal of the studio cannot be read.";
    if (!old || old->text != old->on_disk)
      notice += " Changes that were not saved are in " + journal->set_aside() + ".";
    if (old) {
      history.pins = std::move(old->pins);
      history.runs = std::move(old->runs);
    }
    return false;
  }
};

Document::Document(std::string path, const std::function<std::string()> &text_of_new)
    : state_(std::make_unique<State>())
{
  State &s               = *state_;
  s.path                 = std::move(path);
  const auto known       = text_on_disk(s.path);
  s.is_new               = !known;
  const std::string text = known ? *known : text_of_new();
  read_case_text(s.path, text);  // what is not TOML cannot be edited
  s.journal.emplace(journal_path(s.path));
  const auto lines = s.journal->lines();
  if (!lines.empty() && s.take_up(lines, known.value_or("")))
    return;
  s.history.on_disk = known ? *known : "";
  s.history.text    = text;
  if (!known && s.notice.empty())  // a name that was mistyped looks like a new stand
    s.notice = s.path + " does not exist yet: this is a new stand, which is written when it is saved.";
  s.begin_again();
}

Document::~Document() = default;

const std::string &Document::path() const
{
  return state_->path;
}

std::string Document::notice() const
{
  return state_->notice;
}

DocumentState Document::state() const
{
  const std::lock_guard lock(state_->access);
  const History &h = state_->history;
  return {h.revision, h.text, h.text == h.on_disk, h.before.size(), h.after.size(), h.pins, h.runs};
}

std::vector<RefusedEdit> Document::set(const std::vector<Edit> &edits)
{
  std::vector<RefusedEdit> refused;
  const std::lock_guard lock(state_->access);
  // Each is tried first, so that the journal holds only what can be replayed.
  History trial;
  trial.text = state_->history.text;
  trial.done = state_->history.done;
  json line{{"op", word_of(LineOf::set)}, {"edits", json::array()}};
  for (const Edit &edit : edits) {
    const json one{{"id", edit.id}, {"key", edit.key}, {"toml", edit.toml}};
    try {
      trial.set(json::array({one}));
      trial.before.clear();
      line["edits"].push_back(one);
    } catch (const InputError &error) {
      refused.push_back({edit.id, error.problems.empty() ? error.what() : error.problems.front().message});
    }
  }
  if (!line["edits"].empty())
    state_->change(line);
  return refused;
}

void Document::undo()
{
  const std::lock_guard lock(state_->access);
  state_->change({{"op", word_of(LineOf::undo)}});
}

void Document::redo()
{
  const std::lock_guard lock(state_->access);
  state_->change({{"op", word_of(LineOf::redo)}});
}

void Document::replace(const std::string &text)
{
  read_case_text("the text", text);
  const std::lock_guard lock(state_->access);
  state_->change({{"op", word_of(LineOf::text)}, {"text", text}});
}

void Document::save()
{
  const std::lock_guard lock(state_->access);
  State &s           = *state_;
  const auto on_disk = text_on_disk(s.path).value_or("");
  if (on_disk != s.history.on_disk && on_disk != s.history.text)
    throw InputError(s.path + " was changed outside of the studio since it was read; save it under another name "
                              "there, or take it back, and save again");
  save_in_place(s.path, s.history.text);
  s.change({{"op", word_of(LineOf::saved)}});
}

void Document::pin(const std::string &name)
{
  if (name.empty() || name.size() > 200)
    throw InputError("a pin needs a name of 1 to 200 characters");
  const std::lock_guard lock(state_->access);
  if (state_->history.pins.size() >= most_pins && !state_->history.pin_named(name))
    throw InputError(fmt::format("{} states are pinned already; take one away first", most_pins));
  state_->change({{"op", word_of(LineOf::pin)}, {"name", name}});
}

void Document::unpin(const std::string &name)
{
  const std::lock_guard lock(state_->access);
  state_->change({{"op", word_of(LineOf::unpin)}, {"name", name}});
}

void Document::back_to(const std::string &name)
{
  const std::lock_guard lock(state_->access);
  const Pin *pin = state_->history.pin_named(name);
  if (!pin)
    throw InputError("no state is pinned under this name");
  state_->change({{"op", word_of(LineOf::text)}, {"text", std::string(pin->text)}});
}

void Document::add_run(const StoredRun &run)
{
  const std::lock_guard lock(state_->access);
  state_->change({{"op", word_of(LineOf::run)}, {"id", run.id}, {"text", run.text}});
}
}  // namespace mill::studio
