#include "app/command/option_words.h"
#include "app/process/console.h"
#include "app/python/long_call.h"
#include "app/python/python_parts.h"
#include "app/python/python_values.h"
#include "app/study/study_command.h"
#include "app/study/sweep_command.h"
#include "app/study/varied_key.h"
#include "app/twin/analyse/analyse_command.h"
#include "app/twin/calibrate/calibrate_command.h"
#include "core/records/short_names.h"
#include <algorithm>
#include <fmt/ranges.h>
#include <pybind11/stl.h>

namespace py = pybind11;

// Verbs that leave a folder.  The package reads tables and JSON from it (millstand/_tables.py, _records.py).
namespace mill::python {
namespace {
using Texts = std::vector<std::string>;

template <class Value> Value value_of(const std::string &name, const py::handle &value, const char *needed)
{
  try {
    return value.cast<Value>();
  } catch (const py::cast_error &) {
    throw InputError(name + " = " + py::str(value).cast<std::string>() + ": " + needed + " is needed");
  }
}

long count_of(const std::string &name, const py::handle &value)
{
  const long count = value_of<long>(name, value, "a whole number");
  if (count < 0)
    throw InputError(name + " = " + std::to_string(count) + ": a number that is not negative is needed");
  return count;
}

// What the command line checks by itself.
void require_known_words(const CommandLine &command)
{
  const auto require = [](const char *what, const std::string &word, const std::vector<std::string> &known) {
    if (!word.empty() && std::find(known.begin(), known.end(), word) == known.end())
      throw InputError(fmt::format("{} '{}' is not known; there are {}", what, word, fmt::join(known, ", ")));
  };
  require("method", command.study.method, word_list<StudyMethod>());
  require("engine", command.study.engine, word_list<StudyEngine>());
  require("model", command.sweep.model, word_list<ModelKind>());
  if (command.verb == Verb::sweep && command.sweep.vary.empty())
    throw InputError(
        "sweep needs a key with its values, for example {\"backup_roll.crown\": [\"0 um\", \"50 um\"]}");
}

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
  const std::map<std::string, std::function<void(const py::handle)>> numbers{
      {"threads", [&](const py::handle value) { command.threads = int(count_of("threads", value)); }},
      {"samples", [&](const py::handle value) { command.study.samples = count_of("samples", value); }},
      {"seed",
       [&](const py::handle value) { command.study.seed = value_of<int>("seed", value, "a whole number"); }},
      {"jobs", [&](const py::handle value) { command.study.jobs = int(count_of("jobs", value)); }}};
  for (const auto &[key, value] : options) {
    const auto name = key.cast<std::string>();
    if (const auto text = texts.find(name); text != texts.end())
      *text->second = value_of<std::string>(name, value, "a text");
    else if (const auto list = lists.find(name); list != lists.end())
      *list->second = value_of<Texts>(name, value, "a list of texts");
    else if (const auto flag = flags.find(name); flag != flags.end())
      *flag->second = value_of<bool>(name, value, "True or False");
    else if (const auto number = numbers.find(name); number != numbers.end())
      number->second(value);
    else
      throw py::key_error("option " + name);
  }
}

int carry_out_verb(const std::string &word, const py::object &the_case, const py::dict &options,
                   const py::object &progress)
{
  CommandLine command;
  const Verb verb = choice_named<Verb>(word).value();
  if (!the_case.is_none())
    command = the_case.cast<const HeldCase &>().command(verb);
  command.verb  = verb;
  command.quiet = true;
  take_options(command, options);
  require_known_words(command);
  return long_call<int>(progress, [command](const Progress &shown) {
    const console::HeardProgress heard(shown.step);
    if (command.verb == Verb::sweep)
      return sweep_command(command);
    if (command.verb == Verb::study)
      return study_command(command);
    if (command.verb == Verb::analyse)
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
  module.def("_list_items", &list_items, py::arg("text"));
  module.def("_text_of_value", &text_of_value, py::arg("value"));
}
}  // namespace mill::python
