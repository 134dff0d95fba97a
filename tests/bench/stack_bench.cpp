// Roll stacks of tests/reference/stack.json by both engines: one state from nothing, a thousand settings in a row,
// condensation of a roll, and settings of four actuators for a wanted profile.
// Prints one JSON object: wall and processor times in ms, the best of some runs, and the ratio of the processor
// time to what is asked (below 1: met); one thread, so that both are the same on a machine with nothing else to
// do. "cholesky_480" says how quick the machine is.
#include "app/stack/stack_optimise.h"
#include "core/case/case_file.h"
#include "core/model/case.h"
#include "core/numerics/eigen_instances.h"
#include "fem/stack/condensed_stack.h"
#include "reduce/stack/beam_stack.h"
#include "tests/support/condensed_rolls.h"
#include "tests/support/reference_stack.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <map>
#include <set>
#include <string>

namespace {
using namespace mill;
using Kernels = std::vector<std::shared_ptr<const fem::RollKernel>>;

struct Time {
  double wall = 1e300, processor = 1e300;  // ms
};

Time time_of(const std::function<void()> &work)
{
  const auto start       = std::chrono::steady_clock::now();
  const std::clock_t was = std::clock();
  work();
  return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count(),
          1e3 * double(std::clock() - was) / CLOCKS_PER_SEC};
}

Time best_of(const int runs, const std::function<std::function<void()>()> &prepared)
{
  Time best;
  for (int i = 0; i < runs; ++i) {
    const Time one = time_of(prepared());
    best           = {std::min(best.wall, one.wall), std::min(best.processor, one.processor)};
  }
  return best;
}

void print(const std::string &name, const Time &time, const double asked)
{
  std::printf("  \"%s\": {\"wall_ms\": %.2f, \"processor_ms\": %.2f, \"asked_ms\": %.0f, \"ratio\": %.2f},\n",
              name.c_str(), time.wall, time.processor, asked, time.processor / asked);
  std::fflush(stdout);
}

// As they come from the cache: nothing of a stack is known to them.
Kernels fresh(const Kernels &kernels)
{
  std::map<const fem::RollKernel *, std::shared_ptr<const fem::RollKernel>> made;
  Kernels out;
  for (const auto &kernel : kernels) {
    auto &one = made[kernel.get()];
    if (!one)
      one = kernel->roll ? std::make_shared<const fem::RollKernel>(fem::fourier_kernel(kernel->roll))
                         : std::make_shared<const fem::RollKernel>(*kernel);
    out.push_back(one);
  }
  return out;
}

// Force, bending, crown, shift and saddles as they change from one setting of a mill to the next.
Stack setting(const Stack &drawn, const int i)
{
  Stack stack       = drawn;
  const double turn = 2 * M_PI * i / 100.;
  stack.strip.force *= 1 + 0.1 * std::sin(turn);
  for (StackRoll &roll : stack.rolls) {
    for (StackLoad &load : roll.loads)
      load.force[1] += 2e4 * std::sin(2 * turn) * (roll.axis[1] > 0 ? 1 : -1);
    if (roll.supports.size() > 2)
      for (StackSupport &support : roll.supports)
        support.motion[1] += 5e-6 * std::cos(3 * turn) * (roll.axis[1] > 0 ? -1 : 1);
  }
  for (const std::size_t r : {stack.upper, stack.lower})
    stack.rolls[r].profile.crown += 5e-6 * std::sin(5 * turn);
  if (i % 10 == 9)  // shifts are slow: every tenth setting has another one
    for (const StackContact &contact : stack.contacts)
      if (contact.a == stack.upper || contact.a == stack.lower)
        stack.rolls[contact.b].shift += (stack.rolls[contact.b].axis[1] > 0 ? 1 : -1) * 1e-3 * std::sin(turn);
  return stack;
}

fem::CondensedStackSettings on_two_threads()
{
  fem::CondensedStackSettings settings;
  settings.threads = 2;
  return settings;
}

void time_engines(const std::string &name, const double asked)
{
  const Stack stack     = reference_stack(reference(name, "stack"));
  const Kernels kernels = condensed_rolls(stack, CondensedMesh::as_run);
  print(name + ", condensed, cold",
        best_of(10,
                [&] { return [&stack, unused = fresh(kernels)] { fem::CondensedStack(stack, unused).solve(); }; }),
        asked);
  print(name + ", condensed, cold, two threads",
        best_of(10,
                [&] {
                  return [&stack, unused = fresh(kernels)] {
                    fem::CondensedStack(stack, unused, on_two_threads()).solve();
                  };
                }),
        asked);
  print(name + ", beams, cold", best_of(10, [&] { return [&] { reduce::BeamStack(stack).solve(); }; }), asked);
}

Time tenfold(const Time &time)
{
  return {10 * time.wall, 10 * time.processor};
}

void time_settings(const std::string &name)
{
  const Stack stack      = reference_stack(reference(name, "stack"));
  const Kernels kernels  = condensed_rolls(stack, CondensedMesh::as_run);
  constexpr int settings = 1000;
  print(name + ", condensed, 1000 settings, each from nothing", tenfold(time_of([&] {
          for (int i = 0; i < settings / 10; ++i)
            fem::CondensedStack(setting(stack, i), kernels).solve();
        })),
        1e4);
  fem::CondensedStack engine(stack, kernels, on_two_threads());
  int steps = 0;
  print(name + ", condensed, 1000 settings in a row, two threads", time_of([&] {
          for (int i = 0; i < settings; ++i) {
            if (!engine.change(setting(stack, i)))
              std::abort();
            steps += engine.solve().newton_steps;
          }
        }),
        1e4);
  std::fprintf(stderr, "%s: %.1f steps a setting\n", name.c_str(), steps / double(settings));
}

void time_condensation(const std::string &name)
{
  const Stack stack = reference_stack(reference(name, "stack"));
  std::set<std::string> known;
  for (const StackRoll &roll : stack.rolls) {
    const auto solid = fem::solid_of(roll);
    if (!solid || roll.axis[1] < 0 || !known.insert(std::to_string(roll.diameter)).second)
      continue;
    Stack alone;
    alone.rolls = {roll};
    print(name + ", condensation of " + roll.name, time_of([&] { condensed_rolls(alone, CondensedMesh::as_run); }),
          2000);
  }
}

void time_optimum()
{
  const Case read         = read_case(std::string(MILLSTAND_SOURCE_DIR) + "/cases/stack-six-high.toml");
  const auto &spec        = std::get<StackCase>(read.spec);
  const StackInput &input = *spec.input;
  const Kernels kernels   = condensed_rolls(*spec.stack, CondensedMesh::as_run);
  std::vector<StackActuator> actuators;
  for (const auto &[name, low, high] : {std::tuple("W.bending_force", -2e5, 6e5),
                                        {"I.bending_force", -2e5, 6e5},
                                        {"I.shift", 0., 0.15},
                                        {"W.shift", 0., 0.05}}) {
    actuators.push_back(stack_actuator(input, *spec.stack, name));
    actuators.back().low  = low;
    actuators.back().high = high;
  }
  int steps           = 0;
  const Time measured = time_of([&] {
    steps = optimise_stack(input, *spec.stack, condensed_of(kernels, 40), actuators,
                           {{"crown", 20e-6}, {"edge_drop", 15e-6}})
                .steps;
  });
  print("six-high, optimum of four actuators in " + std::to_string(steps) + " steps", measured, 1000);
}
}  // namespace

// stack_bench [condensation | engines | settings | optimum]: that part alone.
int main(const int count, char **words)
{
  const auto wanted = [&](const char *part) { return count < 2 || std::string(words[1]) == part; };
  std::printf("{\n");
  if (wanted("condensation"))
    for (const char *name : {"four-high", "twenty-high"})
      time_condensation(name);
  if (wanted("engines")) {
    time_engines("four-high", 5);
    time_engines("six-high", 50);
    time_engines("twenty-high", 50);
  }
  if (wanted("settings"))
    for (const char *name : {"four-high", "twenty-high"})
      time_settings(name);
  if (wanted("optimum"))
    time_optimum();
  const Eigen::MatrixXd square = Eigen::MatrixXd::Random(480, 480);
  const Eigen::MatrixXd matrix = square * square.transpose() + Eigen::MatrixXd::Identity(480, 480);
  const Time cholesky          = best_of(20, [&] { return [&] { Eigen::LLT<Eigen::MatrixXd> f(matrix); }; });
  std::printf("  \"cholesky_480_ms\": %.2f\n}\n", cholesky.processor);
}
