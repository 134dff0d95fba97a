#include "app/python/python_results.h"
#include "app/run/run_summary.h"
#include "core/base/errors.h"
#include "core/base/short_number.h"
#include "core/base/units.h"
#include "core/case/fields.h"
#include "report/results/names.h"
#include <cmath>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace mill::python {
namespace {
struct NamedCheck {
  Check check;
  std::string unit;
};

double in_unit(const NamedResult &result, const std::string &symbol)
{
  const Unit *const wanted = find_unit(symbol), *const has = find_unit(result.parameter.unit);
  if (!wanted)
    throw InputError("unknown unit '" + symbol + "'" + (has ? "; known are " + units_like(*has) : std::string()));
  if (!has || !(has->dimension == wanted->dimension))
    throw InputError(result.name + " in " + result.parameter.unit + " cannot be given in " + symbol +
                     (has ? "; known are " + units_like(*has) : std::string("; it has no unit")));
  return from_si(result.parameter.value, *wanted);
}

// "K3 = 40200 kN/mm +- 1 % (computed: contact FEM)"
std::string text_of(const NamedResult &result)
{
  const Parameter &p = result.parameter;
  return result.name + " = " + engineering(p) +
         (std::isnan(p.error_estimate) ? "" : " +- " + percent_text(p.error_estimate)) + " (" + source_text(p) +
         ")";
}

template <class List> py::list list_of(const List &all)
{
  py::list out;
  for (const auto &one : all)
    out.append(one);
  return out;
}

std::vector<NamedCheck> checks_of(const NamedResult &result)
{
  std::vector<NamedCheck> all;
  for (const Check &check : result.parameter.checks)
    all.push_back({check, result.parameter.unit});
  return all;
}
}  // namespace

void refuse_name(const std::string &what, const std::string &name, const std::vector<std::string> &known)
{
  const std::string nearest = nearest_word(name, known);
  throw py::key_error("no " + what + " '" + name + "'" +
                      (nearest.empty() ? std::string() : "; did you mean '" + nearest + "'?"));
}

std::shared_ptr<const HeldTable> held(const Table &table)
{
  auto out            = std::make_shared<HeldTable>();
  out->names          = table.names;
  out->units          = table.units;
  const std::size_t m = table.columns.size(), n = m == 0 ? 0 : std::size_t(table.columns[0].size());
  out->rows.resize(n * m);
  for (std::size_t c = 0; c < m; ++c)
    for (std::size_t r = 0; r < n; ++r)
      out->rows[r * m + c] = table.columns[c][Eigen::Index(r)];
  return out;
}

py::object view_of(const std::shared_ptr<const HeldTable> &table)
{
  py::list fields;
  py::dict units, metadata;
  for (std::size_t c = 0; c < table->names.size(); ++c) {
    fields.append(py::make_tuple(table->names[c], "f8"));
    units[py::str(table->names[c])] = table->units[c];
  }
  metadata["units"]     = units;
  const py::object type = py::module_::import("numpy").attr("dtype")(fields, py::arg("metadata") = metadata);
  auto *share           = new std::shared_ptr<const HeldTable>(table);
  const py::capsule owner(share, [](void *held) { delete static_cast<std::shared_ptr<const HeldTable> *>(held); });
  const std::size_t m = table->names.size(), n = m == 0 ? 0 : table->rows.size() / m;
  py::array view(py::reinterpret_borrow<py::dtype>(type), {n}, {m * sizeof(double)}, table->rows.data(), owner);
  view.attr("setflags")(py::arg("write") = false);
  return std::move(view);
}

py::tuple state_of(const NamedResult &result)
{
  const Parameter &p = result.parameter;
  py::list checks;
  for (const Check &check : p.checks)
    checks.append(py::make_tuple(check.name, check.value, check.note));
  return py::make_tuple(result.name, p.value, p.unit, int(p.source), p.method, p.at.text(), p.error_estimate,
                        list_of(p.error_lacks), list_of(p.inputs), checks, list_of(p.estimated));
}

NamedResult result_of(const py::tuple &state)
{
  NamedResult result;
  Parameter &p     = result.parameter;
  result.name      = state[0].cast<std::string>();
  p.value          = state[1].cast<double>();
  p.unit           = state[2].cast<std::string>();
  p.source         = Source(state[3].cast<int>());
  p.method         = state[4].cast<std::string>();
  p.at             = OperatingPoint(state[5].cast<std::string>());
  p.error_estimate = state[6].cast<double>();
  p.error_lacks    = state[7].cast<std::vector<std::string>>();
  p.inputs         = state[8].cast<std::vector<std::string>>();
  for (const py::handle one : state[9]) {
    const auto check = one.cast<py::tuple>();
    p.checks.push_back({check[0].cast<std::string>(), check[1].cast<double>(), check[2].cast<std::string>()});
  }
  p.estimated = state[10].cast<std::vector<std::string>>();
  return result;
}

py::tuple state_of(const HeldTable &table)
{
  const py::bytes rows(reinterpret_cast<const char *>(table.rows.data()), table.rows.size() * sizeof(double));
  return py::make_tuple(list_of(table.names), list_of(table.units), rows);
}

std::shared_ptr<const HeldTable> table_of(const py::tuple &state)
{
  auto table            = std::make_shared<HeldTable>();
  table->names          = state[0].cast<std::vector<std::string>>();
  table->units          = state[1].cast<std::vector<std::string>>();
  const std::string raw = state[2].cast<std::string>();
  table->rows.resize(raw.size() / sizeof(double));
  std::copy(raw.begin(), raw.end(), reinterpret_cast<char *>(table->rows.data()));
  return table;
}

void add_results(py::module_ &module)
{
  py::class_<NamedCheck>(module, "Check", "A value that a result is compared with.")
      .def_property_readonly("name", [](const NamedCheck &c) { return c.check.name; })
      .def_property_readonly(
          "value", [](const NamedCheck &c) { return c.check.value; }, "In the unit of the result.")
      .def_property_readonly("unit", [](const NamedCheck &c) { return c.unit; })
      .def_property_readonly(
          "note", [](const NamedCheck &c) { return c.check.note; }, "Why it may differ; may be empty.")
      .def("__repr__", [](const NamedCheck &c) {
        return "<" + c.check.name + ": " + short_number(c.check.value, 6) + " " + c.unit + ">";
      });
  const auto parameter = [](auto member) {
    return [member](const NamedResult &r) { return r.parameter.*member; };
  };
  py::class_<NamedResult>(module, "Result", "A number of a run with its unit and its proof.")
      .def_readonly("name", &NamedResult::name)
      .def_property_readonly("value", parameter(&Parameter::value), "In SI: `unit`.")
      .def_property_readonly("unit", parameter(&Parameter::unit), "SI unit, \"N/m\"; \"1\" of a pure number.")
      .def_property_readonly("error", parameter(&Parameter::error_estimate), "Relative; nan where none is stated.")
      .def_property_readonly("error_lacks", parameter(&Parameter::error_lacks),
                             "Inputs whose unknown error is why none is stated.")
      .def_property_readonly(
          "source", [](const NamedResult &r) { return std::string(name_of(r.parameter.source)); },
          "computed, given, published, measured, assumed or estimated.")
      .def_property_readonly("method", parameter(&Parameter::method))
      .def_property_readonly(
          "at", [](const NamedResult &r) { return r.parameter.at.text(); }, "Load or state, \"976.2 kN\".")
      .def_property_readonly("inputs", parameter(&Parameter::inputs), "Keys of the case it is made from.")
      .def_property_readonly("estimated", parameter(&Parameter::estimated), "Those of them that are estimates.")
      .def_property_readonly("checks", &checks_of)
      .def_property_readonly("meaning", [](const NamedResult &r) { return report::meaning_of(r.name); })
      .def("to", &in_unit, py::arg("unit"), "The value in another unit, \"kN/mm\".")
      .def("__float__", parameter(&Parameter::value))
      .def("__repr__", [](const NamedResult &r) { return "<" + text_of(r) + ">"; })
      .def("__str__", &text_of)
      .def(py::pickle([](const NamedResult &r) { return state_of(r); }, &result_of));
}
}  // namespace mill::python
