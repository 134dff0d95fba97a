#pragma once
#include "core/numerics/gauss.h"
#include "reduce/bite/bite.h"

namespace mill::bite {
/// Rules on -1..1 for both sides of the neutral point, node -1 towards the exit.
struct HillRules {
  GaussRule exit_side, entry_side;
};

/// The same Gauss-Legendre rule of n points on both sides.
HillRules even_rules(int n);

/// Rules that reach rounding for the strip's flow stress: 12 points where it is smooth.  Where a power law starts
/// at the entry with little strain (its branch point within half the strain of the pass) the entry side takes 24
/// points graded towards the entry by u^5: the power eps^n becomes u^(5 n) there, and with u^4 from the step it is
/// as good as smooth.  Against 300 points: below 2e-12 for n from 0.1 to 0.5 and any pre-strain; 48 even points
/// leave 6e-6.
const HillRules &hill_rules(const RollBite &bite);
}  // namespace mill::bite
