#pragma once
#include "core/model/frame.h"
#include <string>
#include <vector>

namespace mill::reduce {
/// Springs of the screw-down as drawn, both sides of the stand together; NaN: not drawn.  theory.md 23.6
struct ScrewdownSprings {
  double oil_column = not_given;  ///< N/m, (23.13)
  double screw      = not_given;  ///< N/m, free length
  double nut        = not_given;  ///< N/m, thread: screw and nut over the height of the nut, (23.15)
  double piston     = not_given;  ///< N/m
  double load_cell  = not_given;  ///< N/m
};

/// @param steel  of screw, piston and load cell
/// @throws InputError  with everything that is missing, not positive or does not fit, named by its key
ScrewdownSprings screwdown_springs(const Screwdown &drawing, const Material &steel);

/// Flexibility of a screw held by a nut over its height, one side, m/N: the thread's load falls linearly from
/// where the screw enters to nothing at the far end, the nut stands on the face where the screw enters, (23.15).
/// @param screw  N, E A of the screw's core
/// @param nut    N, E A of the nut around it
double thread_flexibility(double height, double screw, double nut);

/// What was taken from the drawing into the frame.
struct Replacement {
  std::string key;                  ///< of the frame: "frame.oil_column_stiffness"
  double Frame::*member = nullptr;  ///< of the frame
  std::string parts;                ///< "screw, nut and piston in series"
  double before = 0;                ///< N/m, NaN: was not given
  double after  = 0;                ///< N/m
};
struct FrameWithScrewdown {
  Frame frame;
  std::vector<Replacement> replaced;  ///< empty: nothing is drawn
};

/// The frame with every stiffness that the drawing gives: oil column, piston (screw, nut and piston as far as they
/// are drawn, in series), load cell.  @throws as screwdown_springs
FrameWithScrewdown frame_with_screwdown(const Frame &frame, const Screwdown &drawing, const Material &steel);
}  // namespace mill::reduce
