#include "app/python/python_run.h"
#include "app/python/long_call.h"
#include "app/python/python_errors.h"
#include "app/python/python_values.h"
#include "app/run/output_dir.h"
#include "app/run/run_context.h"
#include "app/run/run_summary.h"
#include "app/verbs/run_command.h"
#include "core/base/files.h"
#include "core/records/json_archive.h"
#include "core/records/result_folder.h"
#include "core/records/short_names.h"
#include <algorithm>
#include <filesystem>
#include <pybind11/stl.h>
#include <sstream>

namespace py = pybind11;
namespace fs = std::filesystem;

namespace mill::python {
namespace {
constexpr const char *curves_folder = "curves/";

std::string verdict_of(const FinishedRun &run, const std::string &summary)
{
  std::vector<SpeedVerdict> speeds = run.results.speeds;
  worst_first(speeds);
  if (!speeds.empty())
    return sentence_of(speeds.front());
  const std::string &text = run.limits.empty() ? summary : run.limits;
  return text.substr(0, text.find('\n'));
}

// lumped_model.toml without its passes, whose records are known by paths from the folder of the run.
std::string without_passes(const std::string &text)
{
  std::istringstream lines(text);
  std::string kept, line;
  bool of_pass = false;
  while (std::getline(lines, line)) {
    if (!line.empty() && line[0] == '[')
      of_pass = line.rfind("[[pass]]", 0) == 0 || line.rfind("[pass.", 0) == 0;
    if (!of_pass)
      kept += line + "\n";
  }
  return kept;
}

HeldRun held_run(const HeldCase &the_case, const CommandLine &command, const CheckedCase &checked,
                 const FinishedRun &run)
{
  HeldRun out{the_case};
  out.verb   = word_of(command.verb);
  out.folder = run.folder;
  out.speeds = run.results.speeds;
  out.asked  = run.asked;
  worst_first(out.speeds);
  for (const auto &[name, parameter] : run.results.values)
    out.results.push_back({name, parameter});
  out.warnings    = run.results.warnings;
  out.assumptions = run.results.assumptions;
  out.summary     = run_summary(run.results, checked.the_case.name, run.limits, run.folder + "/report.html");
  out.verdict     = verdict_of(run, out.summary);
  for (const auto &[path, table] : run.tables)
    out.tables[path] = held(table);
  out.chain_text = without_passes(text_if_readable(run.folder + "/lumped_model.toml").value_or(""));
  return out;
}

// Refuses a target inside of the folder of the run, which would be copied into itself without end.
bool is_folder_of(const HeldRun &run, const std::string &target)
{
  const fs::path from = fs::weakly_canonical(run.folder), to = fs::weakly_canonical(fs::absolute(target));
  if (to == from)
    return true;
  if (const fs::path inside = to.lexically_relative(from); !inside.empty() && *inside.begin() != "..")
    throw InputError("the folder " + target + " is inside of the folder of the run, " + run.folder +
                     "; choose another");
  return false;
}

// The folder of the run under another name, by the rules of -o.
std::string report(const HeldRun &run, const py::handle where, const bool overwrite)
{
  const std::string target = path_of(where);
  if (run.folder.empty())
    throw InputError(
        "this run came out of a pickle, which holds results and curves but not the files of its page; "
        "call report() before, or give out= to run()");
  const std::string page = target + "/report.html";
  const auto the_case    = run.the_case.read();
  const py::gil_scoped_release others_run;
  if (!fs::is_directory(run.folder))
    throw InputError("the folder of this run, " + run.folder + ", has been removed; run the case again");
  if (is_folder_of(run, target))
    return page;
  const OutputDir out(target, *the_case, overwrite, run_id_of(*the_case, run.verb, ""));
  for (const std::string &name : mill::result_names())
    if (const fs::path part = fs::path(run.folder) / name; fs::exists(part))
      fs::copy(part, out.file(name), fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  out.publish();
  return page;
}

std::vector<std::string> result_names(const HeldRun &run)
{
  std::vector<std::string> names;
  for (const NamedResult &one : run.results)
    names.push_back(one.name);
  return names;
}

// "curves/contact-upper" is "contact-upper"; other folders keep their name.
std::string curve_name(const std::string &path)
{
  const std::string folder = curves_folder;
  return path.rfind(folder, 0) == 0 ? path.substr(folder.size()) : path;
}

struct HeldCurves {
  HeldTables tables;
};

std::vector<std::string> curve_names(const HeldCurves &curves)
{
  std::vector<std::string> names;
  for (const auto &[path, table] : curves.tables)
    names.push_back(curve_name(path));
  return names;
}

const std::shared_ptr<const HeldTable> &curve_named(const HeldCurves &curves, const std::string &name)
{
  for (const auto &[path, table] : curves.tables)
    if (curve_name(path) == name || path == name)
      return table;
  refuse_name("curve", name, curve_names(curves));
}

void add_curves(py::module_ &module)
{
  py::class_<HeldCurves>(module, "Curves", "Curves and responses of a run, by name.")
      .def(
          "__getitem__",
          [](const HeldCurves &c, const std::string &name) { return view_of(curve_named(c, name)); },
          py::arg("name"), "A structured view without a copy, one field for each column, SI.")
      .def(
          "units",
          [](const HeldCurves &c, const std::string &name) {
            const auto &table = curve_named(c, name);
            std::map<std::string, std::string> units;
            for (std::size_t i = 0; i < table->names.size(); ++i)
              units[table->names[i]] = table->units[i];
            return units;
          },
          py::arg("name"), "Unit of each column.")
      .def("keys", &curve_names)
      .def("__iter__", [](const HeldCurves &c) { return py::iter(py::cast(curve_names(c))); })
      .def("__len__", [](const HeldCurves &c) { return c.tables.size(); })
      .def("__contains__", [](const HeldCurves &c, const std::string &name) {
        const auto names = curve_names(c);
        return std::find(names.begin(), names.end(), name) != names.end();
      });
}

py::tuple state_of_run(const HeldRun &run)
{
  py::list results;
  for (const NamedResult &one : run.results)
    results.append(state_of(one));
  py::dict tables;
  for (const auto &[path, table] : run.tables)
    tables[py::str(path)] = state_of(*table);
  std::vector<std::string> warnings;
  for (const Warning &warning : run.warnings)
    warnings.push_back(json_of_record(warning));
  return py::make_tuple(py::cast(run.the_case), run.verb, results, py::cast(warnings), py::cast(run.assumptions),
                        run.verdict, run.summary, tables, run.chain_text);
}

HeldRun run_of_state(const py::tuple &state)
{
  HeldRun run{state[0].cast<HeldCase>()};
  run.verb = state[1].cast<std::string>();
  for (const py::handle one : state[2])
    run.results.push_back(result_of(one.cast<py::tuple>()));
  for (const std::string &text : state[3].cast<std::vector<std::string>>())
    run.warnings.push_back(record_of_json<Warning>(text));
  run.assumptions = state[4].cast<std::vector<std::string>>();
  run.verdict     = state[5].cast<std::string>();
  run.summary     = state[6].cast<std::string>();
  for (const auto &[path, table] : state[7].cast<py::dict>())
    run.tables[path.cast<std::string>()] = table_of(table.cast<py::tuple>());
  run.chain_text = state[8].cast<std::string>();
  return run;
}
}  // namespace

HeldRun run_case(const HeldCase &the_case, const Verb verb, const RunWishes &wishes)
{
  CommandLine command = the_case.command(verb);
  if (!wishes.force.is_none())
    command.force = path_of(wishes.force);
  if (!wishes.cache.is_none())
    command.cache = path_of(wishes.cache);
  command.threads = wishes.threads;
  command.fresh   = wishes.fresh;
  std::shared_ptr<const ScratchFolder> scratch;
  if (wishes.out.is_none()) {
    scratch                 = std::make_shared<ScratchFolder>("millstand-run");
    command.output          = scratch->path();
    command.force_overwrite = true;
  } else {
    command.output = fs::absolute(path_of(wishes.out)).string();  // the run is asked for its folder later
  }
  HeldRun held = long_call<HeldRun>(wishes.progress, [the_case, command, scratch](const Progress &shown) {
    const auto checked = the_case.checked(command.verb, command.force);
    return held_run(the_case, command, *checked, carry_out_run(command, *checked, shown));
  });
  held.scratch = scratch;
  return held;
}

const NamedResult &result_named(const HeldRun &run, const std::string &name)
{
  if (const NamedResult *result = run.find(name))
    return *result;
  refuse_name("result", name, result_names(run));
}

const NamedResult *HeldRun::find(const std::string &name) const
{
  const std::string full = full_result_name(name);
  const auto entry =
      std::find_if(results.begin(), results.end(), [&](const NamedResult &one) { return one.name == full; });
  return entry == results.end() ? nullptr : &*entry;
}

py::class_<HeldRun> add_run(py::module_ &module, py::class_<HeldCase> &the_case)
{
  add_curves(module);
  py::class_<HeldRun> type(module, "Run", "A run that has ended: results by name, curves, the page.");
  type.def_readonly("case", &HeldRun::the_case)
      .def_readonly("verb", &HeldRun::verb)
      .def_readonly("verdict", &HeldRun::verdict, "The sentence that a run says first.")
      .def_readonly("summary", &HeldRun::summary, "The last lines of a run on the terminal.")
      .def_property_readonly("warnings", [](const HeldRun &r) { return texts_of(r.warnings); })
      .def_property_readonly(
          "warning_records", [](const HeldRun &r) { return warning_list(r.warnings); },
          "The warnings by their parts.")
      .def_readonly("assumptions", &HeldRun::assumptions)
      .def_readonly("folder", &HeldRun::folder)
      .def_property_readonly("curves", [](const HeldRun &r) { return HeldCurves{r.tables}; })
      .def("report", &report, py::arg("out"), py::arg("overwrite") = false,
           "Publishes the folder with its page; returns the path of the page.")
      .def("__getitem__", &result_named, py::arg("name"), py::return_value_policy::copy)
      .def("__contains__", [](const HeldRun &r, const std::string &name) { return r.find(name) != nullptr; })
      .def("__iter__", [](const HeldRun &r) { return py::iter(py::cast(result_names(r))); })
      .def("__len__", [](const HeldRun &r) { return r.results.size(); })
      .def("keys", &result_names)
      .def("values", [](const HeldRun &r) { return r.results; })
      .def("items",
           [](const HeldRun &r) {
             py::list items;
             for (const NamedResult &one : r.results)
               items.append(py::make_tuple(one.name, one));
             return items;
           })
      .def("__repr__",
           [](const HeldRun &r) {
             return "<millstand.Run of " + r.the_case.path() + ", " + std::to_string(r.results.size()) +
                    " results>";
           })
      .def(py::pickle(&state_of_run, &run_of_state));
  for (const Verb verb : {Verb::run, Verb::stiffness, Verb::masses, Verb::modes, Verb::simulate}) {
    const char *name = word_of(verb);
    the_case.def(
        name,
        [verb](const HeldCase &c, const py::object &progress, const py::object &out, const py::object &force,
               const int threads, const bool fresh, const py::object &cache) {
          return run_case(c, verb, {progress, out, force, cache, threads, fresh});
        },
        py::arg("progress") = py::none(), py::kw_only(), py::arg("out") = py::none(),
        py::arg("force") = py::none(), py::arg("threads") = 0, py::arg("fresh") = false,
        py::arg("cache") = py::none(),
        (std::string("millstand ") + name + ".  progress(stage, fraction) is called on the way.").c_str());
  }
  return type;
}
}  // namespace mill::python
