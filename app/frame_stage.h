#pragma once
#include "app/run_context.h"
#include "core/lumped_model.h"
#include "core/stand.h"

namespace mill {
/// What the drawings of the frame are sure to, as shares of the frame's own flexibility and mass; NaN: not drawn.
struct FrameErrors {
  double K1 = not_given, K7 = not_given;  ///< -, of the drawn part's flexibility
  double M1 = not_given, M6 = not_given;  ///< -
};

/// Puts what [housing] and [screwdown] give into stand.frame: frame.* results with closed forms and the given
/// values beside them, fields/housing.vtu.
FrameErrors resolve_frame(RunContext &run, FourHigh &stand);

/// Error estimates of M1, M6, K1, K7 from those of the drawn parts.
void add_frame_errors(LumpedModel &model, const FourHigh &stand, const FrameErrors &errors);
}  // namespace mill
