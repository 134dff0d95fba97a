#include "app/python/long_call.h"
#include "app/python/python_errors.h"
#include "app/python/python_parts.h"
#include "app/python/python_values.h"
#include "app/stages/bearing/loaded_bearing.h"
#include "core/numerics/sparse.h"
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace mill::python {
namespace {
struct HeldBearing {
  std::shared_ptr<const LoadedBearing> bearing;
};

NamedResult result_of_bearing(const LoadedState &state, const std::string &name)
{
  for (const std::string &full : {name, "Kzc." + name, "bearing." + state.name + "." + name})
    if (const Parameter *result = state.results.find(full))
      return {full, *result};
  std::vector<std::string> known;
  for (const auto &[other, parameter] : state.results.values)
    known.push_back(other);
  refuse_name("result", name, known);
}

void add_state(py::module_ &module)
{
  const auto matrix = [](auto member) { return [member](const LoadedState &s) { return s.at.*member; }; };
  const auto result = [](const char *name) {
    return [name](const LoadedState &s) { return result_of_bearing(s, name); };
  };
  py::class_<LoadedState>(module, "BearingState", "A bearing under one load.  Arrays are SI.")
      .def_property_readonly("roller_loads", matrix(&bearing::AssemblyState::roller_load), "(rows, rollers) N")
      .def_property_readonly("stiffness", matrix(&bearing::AssemblyState::tangent),
                             "(5, 5) N/m, N, N m: d load / d motion in x, y, z, rotation about x, about y.")
      .def_property_readonly("motion", matrix(&bearing::AssemblyState::motion), "(5) m, rad, of the inner ring")
      .def_property_readonly("load", matrix(&bearing::AssemblyState::load), "(5) N, N m, on the inner ring")
      .def_property_readonly("azimuth", matrix(&bearing::AssemblyState::azimuth),
                             "(rollers) rad, from the support")
      .def_property_readonly("row_share", matrix(&bearing::AssemblyState::row_share), "(rows) of the radial load")
      .def_property_readonly("tangent", result("tangent"))
      .def_property_readonly("secant", result("secant"))
      .def_property_readonly("L10", result("L10"))
      .def_property_readonly("L10r", result("L10r"))
      .def_property_readonly("L10mr", result("L10mr"), "Modified reference life, revolutions.")
      .def("__getitem__", &result_of_bearing, py::arg("name"))
      .def("keys",
           [](const LoadedState &s) {
             std::vector<std::string> names;
             for (const auto &[name, parameter] : s.results.values)
               names.push_back(name);
             return names;
           })
      .def_property_readonly("warnings", [](const LoadedState &s) { return texts_of(s.results.warnings); })
      .def_property_readonly(
          "warning_records", [](const LoadedState &s) { return warning_list(s.results.warnings); },
          "The warnings by their parts.")
      .def_property_readonly("assumptions", [](const LoadedState &s) { return s.results.assumptions; });
}
}  // namespace

void add_bearing(py::module_ &module, py::class_<HeldCase> &the_case)
{
  add_state(module);
  py::class_<HeldBearing>(module, "Bearing", "A roller bearing of a case.")
      .def_property_readonly("name", [](const HeldBearing &b) { return b.bearing->bearing().name; })
      .def(
          "solve",
          [](const HeldBearing &b, const py::handle radial, const py::handle axial, const py::handle tilt,
             const py::object &progress) {
            const BearingLoading load{quantity(radial, "radial", "488 kN"),
                                      quantity_or(axial, "axial", "20 kN", 0),
                                      quantity_or(tilt, "tilt", "0.2 mrad", 0)};
            return long_call<LoadedState>(progress, [bearing = b.bearing, load](const Progress &shown) {
              set_blas_threads(1);
              return bearing->solve(load, shown);
            });
          },
          py::arg("radial"), py::kw_only(), py::arg("axial") = py::none(), py::arg("tilt") = py::none(),
          py::arg("progress") = py::none(), "Equilibrium, stiffness and life under a load.");
  the_case.def(
      "bearing",
      [](const HeldCase &c, const std::string &which, const int threads, const py::object &cache) {
        return HeldBearing{std::make_shared<const LoadedBearing>(c.read(), which, cache_or_usual(cache),
                                                                 threads_or_all(threads))};
      },
      py::arg("which"), py::kw_only(), py::arg("threads") = 0, py::arg("cache") = py::none(),
      "A bearing by its name, or that of the \"backup\" or the \"work\" roll.");
}
}  // namespace mill::python
