#include "reduce/stack/beam_stack.h"
#include "reduce/stack/moving_stack.h"
#include "reduce/stack/stack_mode_names.h"
#include "reduce/stand/stand_modes.h"
#include "tests/support/near.h"
#include "tests/support/reference_stack.h"
#include <chrono>
#include <cstdio>
#include <gtest/gtest.h>

using namespace mill;
using namespace mill::reduce;

namespace {
struct Moved {
  Stack stack;
  BeamStack engine;
  StackState state;
  MovingStack moving;
  explicit Moved(const std::string &name, const int bending = 8, const int elements = 60)
      : stack(reference_stack(reference(name, "stack"))), engine(stack, {elements}), state(engine.solve()),
        moving(moving_stack(engine, bending))
  {
  }
};
}  // namespace

TEST(StackMotion, Try)
{
  for (const char *name : {"four-high", "six-high", "twenty-high"}) {
    const auto t0 = std::chrono::steady_clock::now();
    const Moved m(name);
    const auto t1 = std::chrono::steady_clock::now();
    const auto modes = stand_modes(m.moving.model);
    const auto t2 = std::chrono::steady_clock::now();
    const auto full = m.engine.frequencies(8);
    std::printf("%s n %d, build %.3f s modes %.3f s strip %.4g modulus %.6g\n", name, int(m.moving.model.M.rows()),
                std::chrono::duration<double>(t1 - t0).count(), std::chrono::duration<double>(t2 - t1).count(),
                m.moving.strip_stiffness, 1 / m.moving.model.b.dot(static_displacement(m.moving.model)));
    for (int i = 0; i < 8; ++i)
      std::printf("  %9.3f %9.3f", modes.frequency[i], full[i]);
    std::printf("\n");
    const auto lumped = lumped_stack(m.engine, m.state);
    const auto lm = stand_modes(lumped.model);
    for (int i = 0; i < std::min<int>(8, int(lm.frequency.size())); ++i)
      std::printf("  %9.3f", lm.frequency[i]);
    std::printf("\n");
    const auto names = gap_mode_names(gap_motions(m.stack, m.state, m.moving, m.moving.model, modes));
    for (int i = 0; i < 14; ++i)
      std::printf("  %9.3f %-40s %.4f %s\n", modes.frequency[i], names[i].name.c_str(), names[i].gap_share, names[i].decided.c_str());
    const auto rolling = with_strip(m.moving);
    const auto rm = stand_modes(rolling);
    const auto rn = gap_mode_names(gap_motions(m.stack, m.state, m.moving, rolling, rm));
    for (int i = 0; i < 14; ++i)
      std::printf("  R %9.3f %-40s %.4f %s\n", rm.frequency[i], rn[i].name.c_str(), rn[i].gap_share, rn[i].decided.c_str());
    const auto ln = gap_mode_names(gap_motions(m.stack, m.state, lumped, lumped.model, lm));
    for (int i = 0; i < int(lm.frequency.size()) && i < 8; ++i)
      std::printf("  L %9.3f %-40s %.4f %s\n", lm.frequency[i], ln[i].name.c_str(), ln[i].gap_share, ln[i].decided.c_str());
  }
}
