#pragma once
#include "core/process/progress.h"
#include <functional>
#include <memory>
#include <optional>
#include <pybind11/pybind11.h>

namespace mill::python {
/// Carries out long work in a thread of its own without the lock of the interpreter.  The calling thread waits,
/// calls `progress(stage, fraction)` where it is not None, and looks for signals ten times a second: after Ctrl-C,
/// or an exception of `progress`, the work is asked to stop (core/process/stop.h) and the exception is raised
/// within a second.  Work that has not come to its next stop by then ends there in the background.
/// @param work  owns what it needs; holds no object of Python
void call_long(const pybind11::object &progress, std::function<void(const Progress &)> work);

/// The same with a result.
template <class Result>
Result long_call(const pybind11::object &progress, std::function<Result(const Progress &)> work)
{
  auto result = std::make_shared<std::optional<Result>>();
  call_long(progress, [result, work = std::move(work)](const Progress &shown) { result->emplace(work(shown)); });
  return std::move(**result);
}

/// Waits for work that was left in the background, at the end of the interpreter.
void finish_left_work();
}  // namespace mill::python
