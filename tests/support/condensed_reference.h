#pragma once
#include "fem/stack/condensed_stack.h"
#include "reduce/stack/beam_stack.h"
#include "tests/support/condensed_rolls.h"
#include "tests/support/near.h"
#include "tests/support/reference_stack.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <string>

// Stacks of tests/reference/stack.json solved by the engine of condensed rolls.
namespace mill {
inline constexpr double um = 1e-6, mm = 1e-3;

inline Stack stack_named(const std::string &name)
{
  return reference_stack(reference(name, "stack"));
}

struct CondensedReference {
  Stack stack;
  fem::CondensedStack engine;
  reduce::StackState state;
  explicit CondensedReference(const Stack &of, const CondensedMesh mesh = CondensedMesh::as_run)
      : stack(of), engine(stack, condensed_rolls(stack, mesh)), state(engine.solve())
  {
  }
};

inline double load_between(const reduce::PairState &pair, const double z)
{
  const auto next = std::upper_bound(pair.z.begin(), pair.z.end(), z);
  const auto i    = std::clamp<Eigen::Index>(next - pair.z.begin(), 1, pair.z.size() - 1);
  const double t  = (z - pair.z[i - 1]) / (pair.z[i] - pair.z[i - 1]);
  return (1 - t) * pair.load[i - 1] + t * pair.load[i];
}

// Line loads away from the ends of contact, where the beams know no end.
inline void expect_line_loads(const CondensedReference &condensed, const reduce::StackState &beams,
                              const double reach = 0.9)
{
  for (std::size_t c = 0; c < beams.pairs.size(); ++c) {
    const reduce::PairState &pair = beams.pairs[c];
    for (const double share : {-reach, -0.5, 0., 0.5, reach}) {
      const double z = share * std::min(pair.z.maxCoeff(), -pair.z.minCoeff());
      EXPECT_TRUE(near(load_between(condensed.state.pairs[c], z), load_between(pair, z),
                       within(0.05, "shoulders and cross influence", pair.peak_load)))
          << "contact " << c << " at " << z;
    }
  }
}
}  // namespace mill
