#pragma once
#include <pybind11/pybind11.h>
#include <string>

// Values that cross the border.  A quantity is a text, "976 kN", a pair (976, "kN") or a result of a run.
namespace mill::python {
/// As a case file or --set has it: "150 um", 0.2, true, ["100 kN", "2000 kN"].
/// @throws pybind11::type_error  a type that no key takes
std::string text_of_value(pybind11::handle value);

/// A quantity in SI.
/// @param name     of the argument, for messages
/// @param example  "976 kN": a quantity of the dimension that is wanted
/// @throws InputError  no unit, a unit of another dimension, not a number
double quantity(pybind11::handle value, const char *name, const char *example);
double quantity_or(pybind11::handle value, const char *name, const char *example, double if_none);

/// "out" of a str or a pathlib.Path.
std::string path_of(pybind11::handle value);
}  // namespace mill::python
