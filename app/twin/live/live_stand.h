#pragma once
#include "twin/drift/mode_watch.h"
#include "twin/live/engine/twin_model.h"
#include "twin/live/page/event_text.h"

namespace mill {
struct Case;

/// The stand of a case as `millstand live` steps it: kind lumped as given, kind four-high by closed forms.  Its
/// springs have the errors that the case or its last run states.
/// @param six_masses  of kind four-high: the chain instead of rolls as beams
/// @throws InputError  a case without a stand
live::TwinModel live_model(const Case &the_case, bool six_masses);

/// What the page draws of it.
live::PageStand page_stand(const Case &the_case, const live::TwinModel &model);
/// Frequencies over the rolling force: of a four-high by closed forms at several loads, K3 and K5 stiffen with it;
/// of a lumped case the same at every load.  The deviation of a mode is the error that the last run of the case
/// states for it, else what the errors of the springs leave open; 10 % for a spring without one.
twin::ModesAtLoad modes_at_load(const Case &the_case, const live::TwinModel &model, const live::Tuning &tuning);

/// Springs whose error nothing states, and what is assumed of them, as a sentence; empty: there are none.
std::string assumed_errors_note(const live::TwinModel &model);

/// The chain at another rolling force, N, as modes_at_load() takes it.
LumpedModel chain_at_load(const Case &the_case, const live::TwinModel &model, double load);

/// Factors and frequencies as they now are.
live::PageParameters page_parameters(const live::TwinModel &model, const live::Tuning &tuning,
                                     const std::string &origin, const std::string &place);
}  // namespace mill
