#include "app/python/long_call.h"
#include "core/process/stop.h"
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace py = pybind11;
using namespace std::chrono_literals;

namespace mill::python {
namespace {
constexpr auto between_looks = 50ms, patience = 500ms;

struct Work {
  std::atomic<bool> stop{false};
  std::mutex access;
  std::condition_variable changed;
  bool ended = false;
  std::exception_ptr failure;
  std::optional<std::pair<std::string, double>> step;  // not yet shown

  template <class Duration> bool wait(const Duration duration)
  {
    std::unique_lock lock(access);
    return changed.wait_for(lock, duration, [&] { return ended; });
  }
};

// Threads that went on after their call had ended.
struct LeftThreads {
  std::mutex access;
  std::vector<std::pair<std::shared_ptr<Work>, std::thread>> all;
};

LeftThreads &left_threads()
{
  static LeftThreads left;
  return left;
}

void leave(std::shared_ptr<Work> state, std::thread thread)
{
  const std::lock_guard lock(left_threads().access);
  left_threads().all.emplace_back(std::move(state), std::move(thread));
}

void join_ended()
{
  auto &[access, all] = left_threads();
  const std::lock_guard lock(access);
  for (auto one = all.begin(); one != all.end();)
    if (one->first->wait(0ms)) {
      one->second.join();
      one = all.erase(one);
    } else {
      ++one;
    }
}

void carry_out(const std::shared_ptr<Work> &state, const std::function<void(const Progress &)> &work)
{
  const Stoppable stoppable(&state->stop);
  Progress progress;
  progress.step = [&](const std::string &stage, const double fraction) {
    stop_if_asked();
    const std::lock_guard lock(state->access);
    state->step.emplace(stage, fraction);
  };
  progress.log = [](const std::string &) { stop_if_asked(); };
  try {
    work(progress);
  } catch (...) {
    const std::lock_guard lock(state->access);
    state->failure = std::current_exception();
  }
}

void show_step(Work &state, const py::object &progress)
{
  std::optional<std::pair<std::string, double>> step;
  {
    const std::lock_guard lock(state.access);
    step.swap(state.step);
  }
  if (step && !progress.is_none())
    progress(step->first, step->second);
}
}  // namespace

void call_long(const py::object &progress, std::function<void(const Progress &)> work)
{
  join_ended();
  const auto state = std::make_shared<Work>();
  std::thread thread([state, work = std::move(work)]() mutable {
    carry_out(state, work);
    work = nullptr;  // what it owns goes before the caller reads the result
    const std::lock_guard lock(state->access);
    state->ended = true;
    state->changed.notify_all();
  });
  try {
    for (bool ended = false; !ended;) {
      {
        const py::gil_scoped_release others_run;
        ended = state->wait(between_looks);
      }
      show_step(*state, progress);
      if (PyErr_CheckSignals() != 0)
        throw py::error_already_set();
    }
  } catch (...) {
    state->stop = true;
    bool ended  = false;
    {
      const py::gil_scoped_release others_run;
      ended = state->wait(patience);
    }
    if (ended)
      thread.join();
    else
      leave(state, std::move(thread));
    throw;
  }
  {
    const py::gil_scoped_release others_run;
    thread.join();
  }
  if (state->failure)
    std::rethrow_exception(state->failure);
}

void finish_left_work()
{
  const py::gil_scoped_release others_run;
  auto &[access, all] = left_threads();
  const std::lock_guard lock(access);
  for (auto &[state, thread] : all)
    thread.join();
  all.clear();
}
}  // namespace mill::python
