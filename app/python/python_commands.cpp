#include "app/process/console.h"
#include "app/python/long_call.h"
#include "app/python/python_parts.h"
#include "app/python/python_values.h"
#include "app/study/study_command.h"
#include "app/study/sweep_command.h"
#include "app/twin/analyse/analyse_command.h"
#include "app/twin/calibrate/calibrate_command.h"
#include "core/records/short_names.h"
#include <pybind11/stl.h>

namespace py = pybind11;

// Verbs that leave a folder.  The package reads tables and JSON from it (millstand/_tables.py, _records.py).
namespace mill::python {
namespace {
using Texts = std::vector<std::string>;

// Options by their names on the command line; a name that is not here is our bug.
void take_options(CommandLine &command, const py::dict &options)
{
  const std::map<std::string, std::string *> texts{{"out", &command.output},
                                                   {"cache", &command.cache},
                                                   {"model", &command.model},
                                                   {"row_model", &command.sweep.model},
                                                   {"rate", &command.record_rate},
                                                   {"zone", &command.zone},
                                                   {"speed", &command.speed},
                                                   {"limit", &command.limit},
                                                   {"case_file", &command.case_file},
                                                   {"measured", &command.calibrate.measured},
                                                   {"free", &command.calibrate.free},
                                                   {"model_error", &command.calibrate.model_error},
                                                   {"method", &command.study.method},
                                                   {"list", &command.study.list},
                                                   {"engine", &command.study.engine},
                                                   {"action", &command.study.action},
                                                   {"target", &command.target},
                                                   {"minimise", &command.study.minimise},
                                                   {"maximise", &command.study.maximise},
                                                   {"cache_limit", &command.sweep.cache_limit}};
  const std::map<std::string, Texts *> lists{
      {"vary", &command.sweep.vary}, {"watch", &command.sweep.watch}, {"correlate", &command.study.correlate},
      {"names", &command.names},     {"channels", &command.channels}, {"units", &command.channel_units},
      {"scales", &command.scales},   {"severity", &command.severity}};
  const std::map<std::string, bool *> flags{{"accept", &command.calibrate.accept},
                                            {"fresh", &command.fresh},
                                            {"keep", &command.study.keep},
                                            {"overwrite", &command.force_overwrite},
                                            {"allow_failed", &command.study.allow_failed},
                                            {"align", &command.align}};
  for (const auto &[key, value] : options) {
    const auto name = key.cast<std::string>();
    if (const auto text = texts.find(name); text != texts.end())
      *text->second = value.cast<std::string>();
    else if (const auto list = lists.find(name); list != lists.end())
      *list->second = value.cast<Texts>();
    else if (const auto flag = flags.find(name); flag != flags.end())
      *flag->second = value.cast<bool>();
    else if (name == "threads")
      command.threads = value.cast<int>();
    else if (name == "samples")
      command.study.samples = value.cast<long>();
    else if (name == "seed")
      command.study.seed = value.cast<int>();
    else if (name == "jobs")
      command.study.jobs = value.cast<int>();
    else
      throw py::key_error("option " + name);
  }
}

int carry_out_verb(const std::string &verb, const py::object &the_case, const py::dict &options,
                   const py::object &progress)
{
  CommandLine command;
  if (!the_case.is_none())
    command = the_case.cast<const HeldCase &>().command(verb);
  command.verb  = verb;
  command.quiet = true;
  take_options(command, options);
  return long_call<int>(progress, [command](const Progress &shown) {
    const console::HeardProgress heard(shown.step);
    if (command.verb == "sweep")
      return sweep_command(command);
    if (command.verb == "study")
      return study_command(command);
    if (command.verb == "analyse")
      return analyse_command(command);
    return calibrate_command(command);
  });
}
}  // namespace

void add_commands(py::module_ &module)
{
  module.def("_carry_out", &carry_out_verb, py::arg("verb"), py::arg("case"), py::arg("options"),
             py::arg("progress") = py::none());
  module.def("_full_name", &full_result_name, py::arg("name"));
  module.def("_text_of_value", &text_of_value, py::arg("value"));
}
}  // namespace mill::python
