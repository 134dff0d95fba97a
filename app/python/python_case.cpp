#include "app/python/python_case.h"
#include "app/python/python_errors.h"
#include "app/python/python_values.h"
#include "app/trace/trace_key.h"
#include "core/base/files.h"
#include "core/base/save_in_place.h"
#include "core/base/units.h"
#include "core/case/fields.h"
#include "core/case/input_reference.h"
#include <algorithm>
#include <filesystem>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace mill::python {
// Absolute, since the file is read again later, when the working folder may be another one.
HeldCase::HeldCase(const std::string &path) : file(path.empty() ? path : std::filesystem::absolute(path).string())
{
  read_case_file(file);
}

HeldCase::HeldCase(const std::string &name, const std::string &text)
    : scratch(std::make_shared<ScratchFolder>("millstand-case"))
{
  std::filesystem::create_directories(scratch->path());
  file = scratch->path() + "/" + name + ".toml";
  write_atomically(file, text);
}

const std::string &HeldCase::path() const
{
  return file;
}

std::string HeldCase::text() const
{
  return read_text(file);
}

std::vector<std::string> HeldCase::sets() const
{
  std::vector<std::string> all;
  for (const auto &[key, value] : values)
    all.push_back(key + "=" + value);
  return all;
}

void HeldCase::set(const std::string &key, const std::string &value)
{
  HeldCase changed = *this;
  changed.known.reset();
  auto &all = changed.values;
  all.erase(std::remove_if(all.begin(), all.end(), [&](const auto &one) { return one.first == key; }), all.end());
  all.emplace_back(key, value);
  try {
    changed.read();
  } catch (const InputError &e) {
    const std::string mine = "--set " + key + "=" + value;
    std::vector<Problem> of_it;
    std::copy_if(e.problems.begin(), e.problems.end(), std::back_inserter(of_it),
                 [&](const Problem &problem) { return problem.place.file == mine; });
    if (!of_it.empty())
      throw InputError(of_it);
  }
  *this = changed;
}

std::shared_ptr<const Case> HeldCase::read() const
{
  if (!known)
    known = std::make_shared<const Case>(read_case(file, sets()));
  return known;
}

std::shared_ptr<const CheckedCase> HeldCase::checked(const Verb verb, const std::string &force) const
{
  CommandLine asked = command(verb);
  asked.force       = force;
  return std::make_shared<const CheckedCase>(checked_case(asked));
}

CommandLine HeldCase::command(const Verb verb) const
{
  CommandLine command;
  command.verb   = verb;
  command.target = file;
  command.sets   = sets();
  command.quiet  = true;
  return command;
}

namespace {
py::object value_object(const Node &node)
{
  switch (node.kind) {
  case Node::Kind::text:
    return py::str(node.text);
  case Node::Kind::integer:
    return py::int_((long long)(node.number));
  case Node::Kind::real:
    return py::float_(node.number);
  case Node::Kind::flag:
    return py::bool_(node.flag);
  case Node::Kind::array: {
    py::list list;
    for (const Node &item : node.items)
      list.append(value_object(item));
    return std::move(list);
  }
  case Node::Kind::table: {
    py::dict table;
    for (const Node::Entry &entry : node.entries)
      table[py::str(entry.key)] = value_object(entry.value);
    return std::move(table);
  }
  case Node::Kind::other:
    break;
  }
  return py::none();
}

py::object value_of_key(const HeldCase &held, const std::string &key)
{
  const TraceKey known = find_key(*held.read(), held.sets(), key, {});
  if (!known.value)
    return py::none();
  return known.stands_in ? py::str(known.shown) : value_object(*known.value);
}

bool takes_text(const HeldCase &held, const std::string &key)
{
  try {
    const Kind kind = find_key(*held.read(), held.sets(), key, {}).row.kind;
    return kind == Kind::text || kind == Kind::choice || kind == Kind::path;
  } catch (const InputError &) {  // an unknown key, which set() refuses, or a case with other errors
    return false;
  }
}

// "12", "true" and "1979-05-27" are a number, a flag and a date of TOML.
bool reads_as_another_type(const std::string &value)
{
  try {
    const Node root = read_case_text("the value", "value = " + value);
    const auto kind = root.entries.empty() ? Node::Kind::text : root.entries.front().value.kind;
    return kind != Node::Kind::text && kind != Node::Kind::array && kind != Node::Kind::table;
  } catch (const InputError &) {  // what is not TOML is a text
    return false;
  }
}

// A text for a key of texts stays one, whatever it looks like; --set would need quotes in it.
void set_value(HeldCase &held, const std::string &key, const py::handle value)
{
  const std::string text = text_of_value(value);
  const bool in_quotes   = py::isinstance<py::str>(value) && reads_as_another_type(text) && takes_text(held, key);
  held.set(key, in_quotes ? quoted(text) : text);
}

std::vector<std::string> key_names(const HeldCase &held)
{
  std::vector<std::string> names;
  for (const TraceKey &key : keys_of(*held.read()))
    names.push_back(key.name);
  return names;
}

// What millstand check says next to "no errors".
py::tuple check(const HeldCase &held)
{
  std::shared_ptr<const CheckedCase> checked;
  const HeldCase unchanging = held;  // another thread may set a value meanwhile
  {
    const py::gil_scoped_release others_run;
    checked = unchanging.checked(Verb::check);
  }
  return problem_tuple(remarks_of(*checked));
}

// With every value, since records are known by paths from the folder of the file.
void save(const HeldCase &held, const py::handle path)
{
  save_in_place(path_of(path), held.read()->resolved);
}
}  // namespace

py::class_<HeldCase> add_case(py::module_ &module)
{
  py::class_<HeldCase> type(module, "Case", "A case file, and values set on top of it.");
  type.def_property_readonly("path", &HeldCase::path)
      .def_property_readonly("name", [](const HeldCase &c) { return c.read()->name; })
      .def_property_readonly("kind", [](const HeldCase &c) { return c.read()->kind; })
      .def_property_readonly("title", [](const HeldCase &c) { return c.read()->title; })
      .def_property_readonly("sets", &HeldCase::sets, "What was set, \"KEY=VALUE\".")
      .def_property_readonly(
          "resolved", [](const HeldCase &c) { return c.read()->resolved; },
          "Every value with its defaults, as a case file.")
      .def("__getitem__", &value_of_key, py::arg("key"), "As written, or the default; None: not given.")
      .def("__setitem__", &set_value, py::arg("key"), py::arg("value"),
           "A text \"150 um\", a pair (150, \"um\"), a number, a flag or a list.")
      .def("keys", &key_names, "Every key that a case of this kind may have.")
      .def("copy", [](const HeldCase &c) { return c; })
      .def("check", &check, "Finds every error; returns the warnings.  Raises InputError.")
      .def("save", &save, py::arg("path"))
      .def("__repr__", [](const HeldCase &c) { return "<millstand.Case " + c.path() + ">"; })
      .def(py::pickle(
          [](const HeldCase &c) {
            py::list sets;
            for (const std::string &set : c.sets())
              sets.append(set);
            return py::make_tuple(c.path(), c.text(), sets);
          },
          [](const py::tuple &state) {
            // A file of the user is read again where it still is: its records are known by paths from its folder.
            const auto path = state[0].cast<std::string>();
            HeldCase held   = std::filesystem::exists(path) ? HeldCase(path)
                                                            : HeldCase(std::filesystem::path(path).stem().string(),
                                                                       state[1].cast<std::string>());
            for (const std::string &set : state[2].cast<std::vector<std::string>>())
              held.set(set.substr(0, set.find('=')), set.substr(set.find('=') + 1));
            return held;
          }));
  module.def(
      "new", [](const std::string &kind) { return HeldCase(kind, template_of(kind)); }, py::arg("kind"),
      "The template of a kind: \"four-high\", \"lumped\", \"chatter\" ..");
  module.def(
      "load", [](const py::handle path) { return HeldCase(path_of(path)); }, py::arg("path"), "A case file.");
  return type;
}
}  // namespace mill::python
