#include "app/verbs/known_modes.h"
#include "app/run/run_kind.h"
#include "app/trace/closed_form_chain.h"
#include "app/trace/stored_run.h"
#include "core/base/errors.h"
#include "core/model/case.h"
#include "core/records/rows_of_cluster.h"
#include "core/records/rows_of_stand.h"
#include <algorithm>

namespace mill {
namespace {
// "mode.gap_first_kind.frequency"; a mode without a name of its own is none here.
bool is_named(const ResultId &id)
{
  return id.is_of(row::modes::frequency) && id.place("open").empty();
}

// "f3", "cluster.pass 1.f3"
bool is_numbered(const ResultId &id)
{
  return (id.is_of(row::modes::vertical) && id.place("open").empty()) || id.is_of(row::cluster::frequency);
}

// Results that are natural frequencies: those with names, else those of the first pass by their numbers.
class Frequencies {
public:
  void add(const std::string &name, const double value, const double error, const std::vector<std::string> &inputs)
  {
    const auto id = result_id(name);
    if (!(value > 0) || !id || (!is_named(*id) && !is_numbered(*id)))
      return;
    CampbellMode mode;
    mode.key            = is_named(*id) ? id->place("mode") : "f" + id->place("n");
    mode.name           = is_named(*id) ? id->place("mode") : "mode " + id->place("n");
    mode.frequency      = value;
    mode.error_estimate = error;
    std::replace(mode.name.begin(), mode.name.end(), '_', ' ');
    auto &list = is_named(*id) ? named : numbered;
    if (std::any_of(list.begin(), list.end(), [&](const CampbellMode &m) { return m.key == mode.key; }))
      return;  // of a later pass
    list.push_back(mode);
    all_inputs[mode.key] = inputs;
  }
  KnownModes modes() const
  {
    KnownModes known;
    known.modes = named.empty() ? numbered : named;
    std::stable_sort(known.modes.begin(), known.modes.end(),
                     [](const CampbellMode &a, const CampbellMode &b) { return a.frequency < b.frequency; });
    known.inputs = all_inputs;
    return known;
  }

private:
  std::vector<CampbellMode> named, numbered;
  std::map<std::string, std::vector<std::string>> all_inputs;
};

KnownModes of_run(const StoredRun &run)
{
  Frequencies all;
  for (const auto &[name, value] : run.values) {
    const auto error  = run.errors.find(name);
    const auto inputs = run.inputs.find(name);
    all.add(name, value, error == run.errors.end() ? not_given : error->second,
            inputs == run.inputs.end() ? std::vector<std::string>() : inputs->second);
  }
  KnownModes known = all.modes();
  known.model      = "of the run in " + run.folder;
  return known;
}

KnownModes by_closed_forms(const Case &the_case)
{
  Frequencies all;
  if (run_kind(the_case).trace) {
    ClosedFormMemory memory;
    for (const ClosedFormResult &r : run_kind(the_case).trace(the_case, memory, {}))
      all.add(r.name, r.parameter.value, r.parameter.error_estimate, r.parameter.inputs);
  }
  KnownModes known = all.modes();
  known.model      = "by closed forms";
  return known;
}
}  // namespace

KnownModes known_modes(const Case &the_case, const std::string &folder)
{
  const std::string from = folder_of_run(folder, the_case);
  const auto run         = stored_run(from, the_case);
  if (run && run->same_inputs)
    if (KnownModes known = of_run(*run); !known.modes.empty())
      return known;
  const std::string why = !run                ? "no run is stored in " + from
                          : !run->same_inputs ? "the run in " + from + " is of other inputs"
                                              : "the run in " + from + " has no natural frequencies";
  if (!folder.empty())
    throw InputError("--run " + folder + ": " + why + "; leave --run out to take modes by closed forms");
  KnownModes known = by_closed_forms(the_case);
  if (!known.modes.empty())
    known.note = why + ": modes are those of closed forms; millstand modes " + the_case.path +
                 " first, for those of finite elements";
  return known;
}
}  // namespace mill
