// Condensed contact against the full model on the same mesh, in one run: what condensation is worth.
// Prints one JSON object.  Slabs of rolls 400/1300 mm, 24 loads.
#include "tests/manual/solvers/full_contact.h"
#include "tests/support/closed_form.h"
#include "tests/support/roll_pair.h"
#include <chrono>
#include <cstdio>

int main()
{
  using namespace mill;
  const auto now     = [] { return std::chrono::steady_clock::now(); };
  const auto seconds = [](const auto from, const auto to) {
    return std::chrono::duration<double>(to - from).count();
  };
  const Material steel{210e9, 0.3, 7700};
  const auto b     = [](const double q) { return closed_form::line_contact(q, 0.4, 1.3, 210e9, 0.3).half_width; };
  const auto start = now();
  const auto upper = meshed_slab("upper", 0.4, b(200e3), b(5000e3), 8, 0.02, steel);
  const auto lower = meshed_slab("lower", 1.3, b(200e3), b(5000e3), 8, 0.02, steel);
  const auto ready = now();
  const auto pair  = slab_pair(upper, lower);
  const auto curve = fem::sweep(pair, fem::log_spaced(200e3, 5000e3, 24));
  const auto swept = now();
  const auto full =
      fem::solve_full_contact(*upper.body, *lower.body, pair.problem.initial_gap, curve.approach[12], true);
  const auto done = now();
  std::printf("{\"mesh_and_condense_s\": %.4f, \"sweep_24_loads_s\": %.5f, \"full_model_one_load_s\": %.4f,\n"
              " \"sweep_over_condensation\": %.4f, \"full_one_load_over_condensed_one_load\": %.1f,\n"
              " \"force_difference\": %.2e, \"unknowns\": [%d, %d]}\n",
              seconds(start, ready), seconds(ready, swept), seconds(swept, done),
              seconds(ready, swept) / seconds(start, ready), seconds(swept, done) / (seconds(ready, swept) / 24),
              full.force / (curve.load[12] / pair.multiplicity) - 1, upper.roll.n_unknowns, lower.roll.n_unknowns);
}
