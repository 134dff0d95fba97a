#pragma once
#include "live/engine/twin_model.h"
#include "live/page/event_text.h"

namespace mill {
struct Case;

/// The chain of a case as `millstand live` steps it: kind lumped as given, kind four-high by closed forms.
/// @throws InputError  a case without a chain
live::TwinModel live_model(const Case &the_case);

/// What the page draws of it.
live::PageStand page_stand(const Case &the_case, const live::TwinModel &model);
/// Factors and frequencies as they now are.
live::PageParameters page_parameters(const live::TwinModel &model, const live::Tuning &tuning,
                                     const std::string &origin, const std::string &place);
}  // namespace mill
