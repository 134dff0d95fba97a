#include "app/python/python_errors.h"
#include "app/process/out_of_memory.h"
#include "core/base/problem_parts.h"
#include <filesystem>
#include <new>
#include <string>

namespace py = pybind11;

namespace mill::python {
namespace {
py::object error_class(const char *name)
{
  return py::module_::import("millstand._errors").attr(name);
}

// A file may hold bytes that are no text.
py::object text_object(const std::string &text)
{
  PyObject *made = PyUnicode_DecodeUTF8(text.data(), Py_ssize_t(text.size()), "backslashreplace");
  if (!made)
    throw py::error_already_set();
  return py::reinterpret_steal<py::object>(made);
}

py::object place_object(const Place &place)
{
  return error_class("Place")(text_object(place.file), place.line, place.column);
}

void raise(const char *name, const py::tuple &arguments)
{
  const py::object type = error_class(name);
  PyErr_SetObject(type.ptr(), type(*arguments).ptr());
}

// As on the terminal: every problem with its line and a caret.
std::string rendered(const InputError &error)
{
  std::string text;
  for (const Problem &problem : error.problems)
    text += (text.empty() ? "" : "\n") + render(problem);
  return text.empty() ? error.what() : text;
}

void raise_input(const char *name, const InputError &error)
{
  raise(name, py::make_tuple(text_object(rendered(error)), problem_tuple(error.problems)));
}

void translate(std::exception_ptr thrown)
{
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const SystemError &e) {
    raise_input("SystemError", e);
  } catch (const InputError &e) {
    raise_input("InputError", e);
  } catch (const SolverError &e) {
    const SolverError::Report &r = e.report;
    raise("SolverError", py::make_tuple(text_object(r.what), text_object(r.where), text_object(r.cause),
                                        text_object(r.remedy), text_object(r.kept)));
  } catch (const std::filesystem::filesystem_error &e) {
    const std::string path = e.path1().string();
    PyErr_SetObject(PyExc_OSError, py::make_tuple(e.code().value(), e.code().message(), path).ptr());
  } catch (const std::string &message) {  // what Gmsh throws
    PyErr_SetString(PyExc_RuntimeError, ("Gmsh: " + message).c_str());
  }
}
}  // namespace

namespace {
py::object problem_object(const Problem &p, const std::string &remedy)
{
  py::tuple related(p.related.size());
  for (std::size_t r = 0; r < p.related.size(); ++r)
    related[r] = place_object(p.related[r]);
  return error_class("Problem")(place_object(p.place), text_object(p.message),
                                text_object(value_in_message(p.message)), text_object(remedy), related);
}

py::object warning_object(const Warning &w)
{
  py::tuple concerns(w.concerns.size());
  for (std::size_t i = 0; i < w.concerns.size(); ++i)
    concerns[i] = text_object(w.concerns[i]);
  return error_class("WarningRecord")(id_of(w.id), text_object(w.subject), text_object(w.fact),
                                      text_object(w.detail), text_object(w.remedy), concerns, text_object(w.key),
                                      place_object(w.place));
}
}  // namespace

py::tuple problem_tuple(const std::vector<Problem> &problems)
{
  py::tuple all(problems.size());
  for (std::size_t i = 0; i < problems.size(); ++i)
    all[i] = problem_object(problems[i], remedy_in_message(problems[i].message));
  return all;
}

py::tuple problem_tuple(const std::vector<Warning> &remarks)
{
  py::tuple all(remarks.size());
  for (std::size_t i = 0; i < remarks.size(); ++i)
    all[i] = problem_object(problem_of(remarks[i]), remarks[i].remedy);
  return all;
}

py::list warning_list(const std::vector<Warning> &warnings)
{
  py::list all;
  for (const Warning &warning : warnings)
    all.append(warning_object(warning));
  return all;
}

void register_errors()
{
  py::register_exception_translator(&translate);
}
}  // namespace mill::python
