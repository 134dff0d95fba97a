#include "app/study/row_model.h"
#include "app/command/command_line.h"
#include "app/kinds/pipeline.h"
#include "app/run/run_kind.h"
#include "app/run/scratch_folder.h"
#include "app/trace/closed_form_chain.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/case/fields.h"
#include "core/model/case.h"
#include "core/records/cache_limit.h"
#include "core/records/chain_number.h"
#include "core/records/chain_results.h"
#include "core/records/open_rows.h"
#include "core/records/rows_of_chatter.h"
#include "core/records/rows_of_contact.h"
#include "core/records/short_names.h"
#include "report/results/names.h"
#include <algorithm>
#include <filesystem>
#include <mutex>

namespace mill {
namespace {
constexpr std::size_t most_remembered = 512;  // bearings of rows that are over
constexpr std::size_t most_watched    = 12;   // where the command names no result

const char *const closed_forms_work = "closed forms", *const with_responses_work = "closed forms and responses";

struct Work {
  Goal goal;
  Verb verb;  // that does as much, or more
  std::string word = word_of(verb);
};

// Work of a run, the least first.
const std::vector<Work> &works()
{
  static const std::vector<Work> all{{Goal::contacts, Verb::stiffness, "contacts"},
                                     {Goal::stiffness, Verb::stiffness},
                                     {Goal::masses, Verb::masses},
                                     {Goal::modes, Verb::modes},
                                     {Goal::chatter, Verb::chatter},
                                     {Goal::simulate, Verb::run}};
  return all;
}

const Parameter *find_result(const NamedResults &results, const std::string &name)
{
  const auto entry =
      std::find_if(results.begin(), results.end(), [&](const auto &result) { return result.first == name; });
  return entry == results.end() ? nullptr : &entry->second;
}

bool holds_all(const NamedResults &results, const std::vector<std::string> &names)
{
  return std::all_of(names.begin(), names.end(),
                     [&](const std::string &name) { return find_result(results, name); });
}

// A result of the roll contacts alone.
bool is_of_contacts(const std::string &name)
{
  const auto id = result_id_or_open(name);
  return id && ((id->is_of(row::roll_contact::all) && id->place("pass").empty()) || id->is_of(row::contact::all) ||
                id->is_of(row::space::all) || id->is_of(row::line::all) || id->is_of(row::open::roll_contact) ||
                id->is_of(row::open::contact));
}

// May this work give all of these names?
bool may_give(const Case &the_case, const Work &work, const std::vector<std::string> &names)
{
  if (work.goal == Goal::contacts)
    return std::holds_alternative<FourHigh>(the_case.spec) && !names.empty() &&
           std::all_of(names.begin(), names.end(), is_of_contacts);
  const auto &verbs = run_kind(the_case).verbs;
  if (std::find(verbs.begin(), verbs.end(), work.verb) == verbs.end())
    return false;
  // Chatter of a stand is asked for by its names; without names modes are enough.
  const bool of_chatter = std::any_of(names.begin(), names.end(), [](const std::string &name) {
    const auto id = result_id_or_open(name);
    return id && (id->is_of(row::chatter::all) || id->is_of(row::open::chatter));
  });
  if (work.goal == Goal::chatter)
    return of_chatter;
  return !of_chatter || work.goal == Goal::simulate;
}

// What one looks for first in a stand; of other kinds the first results.
std::vector<std::string> usual_names(const NamedResults &results)
{
  std::vector<std::string> names;
  const auto add = [&](const std::string &name) {
    const bool known = find_result(results, name) && names.size() < most_watched;
    if (known)
      names.push_back(name);
    return known;
  };
  for (const ChainNumber spring : {ChainNumber::K3, ChainNumber::K4, ChainNumber::K5})
    if (const auto solved = solved_result_of(word_of(spring)); !solved || !add(*solved))
      add(word_of(spring));  // a spring by both its names is one
  for (const char *name : {"f1", "f2", "f3", "f4", "f5", "f6", "critical_speed"})
    add(name);
  for (const auto &[name, result] : results)
    if (names.size() < most_watched && !find_result(results, "f1"))
      names.push_back(name);
  return names;
}

[[noreturn]] void refuse_unknown(const Case &the_case, const std::string &name, const NamedResults &results)
{
  std::vector<std::string> known;
  for (const auto &[other, result] : results)
    known.push_back(other);
  const std::string nearest = nearest_word(name, known);
  throw InputError("--watch " + name + ": " + the_case.path + " gives no result of this name" +
                   (nearest.empty() ? "; docs/output.md lists the names" : "; did you mean '" + nearest + "'?"));
}
// Written aside and renamed, since a double of this process may write the same row.
void write_sample(const RunContext &run, const std::string &folder, const bool keep)
{
  namespace fs            = std::filesystem;
  const std::string aside = name_aside(folder);
  try {
    fs::create_directories(aside);
    if (keep) {
      run.out.write("resolved.toml", run.the_case.resolved);
      fs::copy(run.out.staging(), aside, fs::copy_options::recursive);
    }
    write_atomically(aside + "/results.json", results_json(run.results, run.the_case.name,
                                                           run.results.warnings.empty() ? "ok" : "warnings"));
    remove_folder(folder);
    fs::rename(aside, folder);
  } catch (const fs::filesystem_error &e) {
    remove_folder(aside);
    if (!fs::exists(folder))  // a double was quicker
      throw SystemError(folder + " cannot be written: " + e.code().message());
  }
}
}  // namespace

// Memories of closed forms that no row uses at present: one for each thread.
struct RowModel::Implementation {
  RowModelSettings settings;
  std::string work;
  std::shared_ptr<MadeKeys> made = std::make_shared<MadeKeys>();
  std::mutex access;
  std::vector<std::unique_ptr<ClosedFormMemory>> free_memories;

  std::unique_ptr<ClosedFormMemory> take_memory()
  {
    const std::lock_guard lock(access);
    if (free_memories.empty())
      return std::make_unique<ClosedFormMemory>();
    auto memory = std::move(free_memories.back());
    free_memories.pop_back();
    return memory;
  }
  void give_back(std::unique_ptr<ClosedFormMemory> memory)
  {
    if (memory->bearings.size() > most_remembered)
      memory->bearings.clear();
    if (memory->driven.size() > most_remembered)
      memory->driven.clear();
    if (memory->forces.size() > most_remembered / 64)
      memory->forces.clear();
    const std::lock_guard lock(access);
    free_memories.push_back(std::move(memory));
  }

  NamedResults quick(const Case &row)
  {
    auto memory            = take_memory();
    memory->with_responses = work == with_responses_work;
    memory->with_inputs    = false;
    NamedResults results;
    for (ClosedFormResult &result : closed_form_chain(row, *memory))
      results.emplace_back(std::move(result.name), std::move(result.parameter));
    give_back(std::move(memory));
    return results;
  }

  NamedResults full(const Case &row, const std::string &sample)
  {
    const ScratchFolder scratch("millstand-row", true);
    const OutputDir out(scratch.path(), row, true, "row");
    RunContext run{row, out, settings.cache, settings.fresh};
    run.made    = made;
    run.threads = settings.threads;
    const auto of =
        std::find_if(works().begin(), works().end(), [&](const auto &one) { return one.word == work; });
    run_stages(run, of->goal);
    if (!sample.empty())
      write_sample(run, sample, settings.keep);
    if (settings.cache_limit > 0)
      keep_cache_below(settings.cache, settings.cache_limit);
    return std::move(run.results.values);
  }
};

double cache_limit(const CommandLine &command)
{
  return command.sweep.cache_limit.empty() ? 0 : bytes_of_size("--cache-limit", command.sweep.cache_limit);
}

RowModel::RowModel(RowModelSettings settings) : implementation(std::make_unique<Implementation>())
{
  implementation->settings = std::move(settings);
  implementation->work =
      implementation->settings.kind == ModelKind::quick ? closed_forms_work : word_of(Verb::run);
}

RowModel::~RowModel() = default;

NamedResults RowModel::choose(const Case &base, std::vector<std::string> watched)
{
  for (std::string &name : watched)
    name = full_result_name(name);
  std::vector<std::string> candidates;
  if (implementation->settings.kind == ModelKind::quick)
    candidates = {closed_forms_work, with_responses_work};
  else
    for (const Work &work : works())
      if (may_give(base, work, watched))
        candidates.push_back(work.word);
  for (const std::string &name : watched)  // before minutes are spent on a name that does not exist
    if (implementation->settings.kind == ModelKind::full && report::meaning_of(name).empty())
      refuse_unknown(base, name, {});
  NamedResults results;
  for (const std::string &work : candidates) {
    // Without names the modes of a stand are enough.
    const bool enough = !watched.empty() || work == word_of(Verb::modes) || work == candidates.back() ||
                        implementation->settings.kind == ModelKind::quick;
    if (!enough)
      continue;
    implementation->work = work;
    results              = this->results(base);
    if (watched.empty())
      watched = usual_names(results);
    if (holds_all(results, watched))
      break;
  }
  NamedResults of_watched;
  for (const std::string &name : watched) {
    const Parameter *result = find_result(results, name);
    if (!result)
      refuse_unknown(base, name, results);
    of_watched.emplace_back(name, *result);
  }
  return of_watched;
}

NamedResults RowModel::results(const Case &row, const std::string &sample)
{
  return implementation->settings.kind == ModelKind::quick ? implementation->quick(row)
                                                           : implementation->full(row, sample);
}

std::string RowModel::work() const
{
  return implementation->work;
}

void RowModel::choose_work(const std::string &work)
{
  implementation->work = work;
}
}  // namespace mill
