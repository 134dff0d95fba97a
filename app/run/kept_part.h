#pragma once
#include "app/process/out_of_memory.h"
#include "app/run/error_warnings.h"
#include "app/run/run_context.h"
#include "core/base/errors.h"
#include "core/records/cached_record.h"
#include <functional>
#include <new>
#include <optional>
#include <string>

namespace mill {
/// What an earlier run kept under the key, unless this run is a fresh one; says why an entry cannot be used.
template <class Part>
std::optional<Part> taken_from_cache(const RunContext &run, const std::string &file, const std::string &key)
{
  std::string note;
  auto part = run.fresh && !run.made->count(key) ? std::nullopt : load_record<Part>(file, key, &note);
  if (!note.empty())
    run.progress.note(note);
  return part;
}

/// Keeps it for the next run; where that fails the run has a warning, and the part is good all the same.
template <class Part>
bool keep_in_cache(RunContext &run, const std::string &name, const std::string &file, const std::string &key,
                   const Part &part)
{
  try {
    save_record(file, key, part);
    return true;
  } catch (const InputError &e) {
    run.warn(not_kept(name, e));
    return false;
  }
}

/// A part that outlives the run: taken from the cache, or made and kept there.  Two stages that run side by side
/// and want the same one make it once.
/// @param file  in the cache, `key` the hash of everything that the part depends on
/// @param make  () -> Part
/// @param smaller  what makes it need less memory, with its key: "a smaller contact.upper.elements_per_half_width"
/// @param worth_keeping  (part) -> bool
/// @throws OutOfMemory  with that remedy
template <class Part, class Make>
Part kept_part(
    RunContext &run, const std::string &stage, const std::string &file, const std::string &key, const Make &make,
    const std::string &smaller,
    const std::function<bool(const Part &)> &worth_keeping = [](const Part &) { return true; })
{
  const MadeKeys::Turn alone(*run.made, key);
  StageTimer timer(run, stage);
  if (auto stored = taken_from_cache<Part>(run, file, key)) {
    run.progress.note(stage + ": taken from " + file);
    timer.cached = true;
    return std::move(*stored);
  }
  const auto made = [&] {
    try {
      return make();
    } catch (OutOfMemory &e) {
      e.report.remedy = memory_remedy(smaller);
      throw;
    } catch (const std::bad_alloc &) {
      OutOfMemory refused   = out_of_memory(stage);
      refused.report.remedy = memory_remedy(smaller);
      throw refused;
    }
  };
  Part part = made();
  if (worth_keeping(part) && keep_in_cache(run, stage, file, key, part))
    run.made->insert(key);
  return part;
}
}  // namespace mill
