#pragma once
#include "app/stages/bite/bite_results.h"
#include "app/stages/bite/bite_study.h"
#include "core/model/pass.h"

namespace mill {
struct BiteCase;
struct Case;
struct FourHigh;

/// Roll bite of one pass: what of the pass differs from the strip.
bite::RollBite bite_of(const Strip &strip, const Pass &pass, double roll_diameter, const Material &roll);

/// Refuses passes that the roll cannot draw in (except for a strip that is fitted), before anything long is
/// computed.
/// @throws InputError  with the place of every such pass
void check_bites(const Case &the_case);

/// What a run says of a pass for which only finite elements can have an answer (app/stages/bite/bite_study.h), at
/// its place; nothing where check_bites() refuses it, or where the strip is fitted.
std::optional<Warning> bite_without_theory(const bite::RollBite &bite, const BiteSetup &setup, const Pass &pass);

/// K4 of one pass of a stand, by the model of [bite]; its combined stiffness (plastic slope in series with both
/// arcs) is that of the chain.
/// @param pass    its place in the case; of the first one K4.* are results
/// @param curves  of the first one: write its curves
/// @param force   N, recorded, for comparison with the computed one
BiteSpring solve_bite_spring(RunContext &run, const FourHigh &stand, std::size_t pass, double force,
                             bool curves = true);

/// kind = "bite": every pass, K4 of the first.
void solve_bite_case(RunContext &run, const BiteCase &spec);
}  // namespace mill
