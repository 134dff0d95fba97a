// The dense contact solver at about 2000 nodes: cold, warm along 20 loads, and event by event.
// Prints one JSON object; times are wall times in ms, the best of three runs where a run is cheap.
#include "fem/contact/active_set.h"
#include "fem/contact/continuation.h"
#include "tests/support/contact_problems.h"
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

namespace {
using namespace mill::contact;
using namespace contact_problems;

template <class Work> double milliseconds(const Work &work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

struct Sweep {
  double mean = 0, worst = 0;
  int iterations = 0;
};

// Each load the best of three whole sweeps: other work on the machine only ever adds time.
Sweep warm(ActiveSet &solver, std::vector<Loading> loads)
{
  std::vector<double> best(loads.size(), 1e300);
  Sweep out;
  for (int run = 0; run < 3; ++run) {
    solver.solve(loads.front());
    for (std::size_t i = 1; i < loads.size(); ++i)
      best[i] = std::min(best[i], milliseconds([&] {
                           out.iterations = std::max(out.iterations, solver.solve(loads[i]).iterations);
                         }));
  }
  for (std::size_t i = 1; i < loads.size(); ++i) {
    out.mean += best[i] / double(loads.size() - 1);
    out.worst = std::max(out.worst, best[i]);
  }
  return out;
}

void report(const std::string &name, const Problem &p, const std::vector<Loading> &loads, const bool last)
{
  double first = 1e300, cold = 1e300;
  State s;
  for (int run = 0; run < 3; ++run) {
    ActiveSet fresh(p);
    first = std::min(first, milliseconds([&] { s = fresh.solve(loads.back()); }));
    fresh.forget();
    cold = std::min(cold, milliseconds([&] { fresh.solve(loads.back()); }));
  }
  ActiveSet solver(p);
  const Sweep up   = warm(solver, loads);
  const Sweep down = warm(solver, {loads.rbegin(), loads.rend()});
  solver.solve(loads[9]);
  Path path;
  const double events = milliseconds([&] { path = follow(solver, loads[9], loads[10]); });
  std::printf(" \"%s\": {\"nodes\": %d, \"touching\": %d, \"modes\": %d, \"residual\": %.1e,\n"
              "  \"first_ms\": %.1f, \"cold_ms\": %.1f, \"cold_iterations\": %d,\n"
              "  \"warm_up_ms\": [%.2f, %.2f], \"warm_down_ms\": [%.2f, %.2f], \"warm_iterations\": [%d, %d],\n"
              "  \"events_between_two_loads\": %d, \"ms_per_event\": %.2f}%s\n",
              name.c_str(), int(p.C.rows()), int(std::count(s.active.begin(), s.active.end(), 1)), int(p.G.cols()),
              s.residual, first, cold, s.iterations, up.mean, up.worst, down.mean, down.worst, up.iterations,
              down.iterations, int(path.events.size()) - 2, events / std::max(1, int(path.events.size()) - 2),
              last ? "" : ",");
}
}  // namespace

int main()
{
  std::vector<Loading> ball, rolls;
  for (int i = 1; i <= 20; ++i) {
    ball.push_back({one(50. * i), {}});
    rolls.push_back({Eigen::Vector2d(50e3 * i, 50e3 * i * 0.02), {}});
  }
  std::printf("{\n");
  report("sphere", sphere(45, 0.45e-3), ball, false);
  report("rolls", roll_pair(25, 80, 1.6e-3), rolls, false);
  report("flat", grid(45, 45, 1e-5, 1e-5), ball, true);
  std::printf("}\n");
}
