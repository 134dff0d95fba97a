#pragma once
#include "core/base/errors.h"
#include <pybind11/pybind11.h>
#include <vector>

namespace mill::python {
/// Errors of the program become exceptions of the package: InputError, SystemError and SolverError of _errors.py,
/// MemoryError, OSError, RuntimeError.
void register_errors();

/// Tuple of Problem of _errors.py.
pybind11::tuple problem_tuple(const std::vector<Problem> &problems);
}  // namespace mill::python
