#pragma once
#include "app/python/python_case.h"
#include "app/python/python_run.h"
#include <pybind11/pybind11.h>

// Parts of a stand, each solved by itself: roll pairs, bearings, the chain of six masses.
namespace mill::python {
void add_roll_pair(pybind11::module_ &module, pybind11::class_<HeldCase> &the_case);
void add_bearing(pybind11::module_ &module, pybind11::class_<HeldCase> &the_case);
void add_chain(pybind11::module_ &module, pybind11::class_<HeldRun> &run);
void add_chatter(pybind11::module_ &module, pybind11::class_<HeldCase> &the_case);

/// sweep, study, analyse and calibrate: functions of the package read what they leave in their folder.
void add_commands(pybind11::module_ &module);

/// Folder of kept parts: the one named, or that of the user.
std::string cache_or_usual(const pybind11::object &cache);
/// As many threads as are asked for and start; the BLAS works with one in each.
int threads_or_all(int threads);
}  // namespace mill::python
