#pragma once
#include <functional>
#include <mutex>

namespace mill {
/// Calls task(i) for i = 0 .. n-1 from up to `threads` threads, the caller's among them; each i once, the lowest
/// first.  Fewer threads than asked for do the work where the system starts no more.  Tasks may share out work of
/// their own: all of it goes to the same threads (oneTBB's, no more than the machine has processors), and a thread
/// that waits takes up nothing but parts of what it waits for.
/// Tasks write to places of their own, so that the outcome is the same with any number of threads.
/// An exception of a task ends the work and comes out here, the first of several; so does Stopped, before the next
/// task, where the caller's work may be stopped (core/process/stop.h).
void share_tasks(long n, int threads, const std::function<void(long)> &task);

/// For libraries that seed and draw from rand() of the C library (METIS, Gmsh): one at a time, else what they make
/// would depend on the schedule.
std::mutex &rand_access();
}  // namespace mill
