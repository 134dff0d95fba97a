#pragma once
#include "core/base/warning.h"
#include <pybind11/pybind11.h>
#include <vector>

namespace mill::python {
/// Errors of the program become exceptions of the package: InputError, SystemError and SolverError of _errors.py,
/// MemoryError, OSError, RuntimeError.
void register_errors();

/// Tuple of Problem of _errors.py.
pybind11::tuple problem_tuple(const std::vector<Problem> &problems);
/// The same of what check remarks; the remedy is that of the warning.
pybind11::tuple problem_tuple(const std::vector<Warning> &remarks);

/// List of WarningRecord of _errors.py.
pybind11::list warning_list(const std::vector<Warning> &warnings);
}  // namespace mill::python
