#pragma once
#include "app/process/out_of_memory.h"
#include "app/run/error_warnings.h"
#include "app/run/run_context.h"
#include "core/base/errors.h"
#include <new>
#include <optional>
#include <string>

namespace mill {
/// A part that outlives the run: taken from the cache, or made and kept there.  Two stages that run side by side
/// and want the same one make it once.
/// @param file  in the cache, `key` the hash of everything that the part depends on
/// @param load  (file, key, std::string *note) -> std::optional<Part>, nothing where no entry can be used
/// @param make  () -> Part
/// @param save  (file, key, part)
/// @param smaller  what makes it need less memory, with its key: "a smaller contact.upper.elements_per_half_width"
/// @throws OutOfMemory  with that remedy
template <class Part, class Load, class Make, class Save>
Part kept_part(RunContext &run, const std::string &stage, const std::string &file, const std::string &key,
               const Load &load, const Make &make, const Save &save, const std::string &smaller)
{
  const MadeKeys::Turn alone(*run.made, key);
  StageTimer timer(run, stage);
  std::string note;
  std::optional<Part> stored;
  if (!run.fresh || run.made->count(key))
    stored = load(file, key, &note);
  if (!note.empty())
    run.progress.note(note);
  if (stored) {
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
  try {
    save(file, key, part);
    run.made->insert(key);
  } catch (const InputError &e) {
    run.warn(not_kept(stage, e));  // but it is good
  }
  return part;
}
}  // namespace mill
