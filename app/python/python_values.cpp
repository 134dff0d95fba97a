#include "app/python/python_values.h"
#include "app/python/python_results.h"
#include "core/base/errors.h"
#include "core/base/si_unit.h"
#include "core/base/units.h"
#include <fmt/format.h>

namespace py = pybind11;

namespace mill::python {
namespace {
bool is_pair(const py::handle value)
{
  return py::isinstance<py::tuple>(value) && py::len(value) == 2 &&
         py::isinstance<py::str>(value.cast<py::tuple>()[1]);
}

std::string number_of(const py::handle value)
{
  return number_text(py::float_(py::reinterpret_borrow<py::object>(value)));
}

bool is_number(const py::handle value)
{
  return PyNumber_Check(value.ptr()) != 0 && !py::isinstance<py::str>(value);
}

std::string quoted(const std::string &text)
{
  std::string out = "\"";
  for (const char c : text)
    out += (c == '"' || c == '\\') ? std::string("\\") + c : std::string(1, c);
  return out + '"';
}

std::string item_text(const py::handle value)
{
  const std::string text = text_of_value(value);
  const bool is_text     = py::isinstance<py::str>(value) || is_pair(value) || py::isinstance<NamedResult>(value);
  return is_text ? quoted(text) : text;
}
}  // namespace

std::string text_of_value(const py::handle value)
{
  if (py::isinstance<py::str>(value))
    return value.cast<std::string>();
  if (py::isinstance<py::bool_>(value))
    return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<NamedResult>(value)) {
    const Parameter &p = value.cast<const NamedResult &>().parameter;
    return number_text(p.value) + after_number(p.unit);
  }
  if (is_pair(value)) {
    const auto pair = value.cast<py::tuple>();
    return number_of(pair[0]) + " " + pair[1].cast<std::string>();
  }
  if (py::isinstance<py::int_>(value))
    return py::str(value).cast<std::string>();
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    std::string list;
    for (const py::handle item : value)
      list += (list.empty() ? "" : ", ") + item_text(item);
    return "[" + list + "]";
  }
  if (py::isinstance<py::dict>(value)) {
    std::string table;
    for (const auto &[key, item] : value.cast<py::dict>())
      table += (table.empty() ? "" : ", ") + key.cast<std::string>() + " = " + item_text(item);
    return "{ " + table + " }";
  }
  if (is_number(value))
    return number_of(value);
  throw py::type_error(
      "a key takes a text, a pair (number, unit), a number, True or False, a list or a dict, not " +
      py::str(py::type::of(value)).cast<std::string>());
}

double quantity(const py::handle value, const char *name, const char *example)
{
  const std::string text    = text_of_value(value);
  const ParsedQuantity read = parse_quantity(text);
  const Dimension wanted    = parse_quantity(example).unit->dimension;
  const auto refuse         = [&](const std::string &why) {
    throw InputError(fmt::format("{} = \"{}\" {}; for example {} = \"{}\"", name, text, why, name, example));
  };
  switch (read.fault) {
  case ParsedQuantity::Fault::no_number:
    refuse("is not a quantity");
    break;
  case ParsedQuantity::Fault::no_unit:
    refuse("has no unit");
    break;
  case ParsedQuantity::Fault::unknown_unit:
    refuse("has the unknown unit '" + read.unit_text + "'");
    break;
  case ParsedQuantity::Fault::none:
    if (!(read.unit->dimension == wanted))
      refuse(std::string("is ") + read.unit->quantity);
  }
  return read.value();
}

double quantity_or(const py::handle value, const char *name, const char *example, const double if_none)
{
  return value.is_none() ? if_none : quantity(value, name, example);
}

std::string path_of(const py::handle value)
{
  return py::module_::import("os").attr("fspath")(value).cast<std::string>();
}
}  // namespace mill::python
