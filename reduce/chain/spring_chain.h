#pragma once
#include "core/model/frame.h"
#include <string>
#include <vector>

namespace mill::reduce {
/// Springs of the load path that are not part of the frame, whole stand.
struct PathSprings {
  double K_Zy_upper = 0;  ///< N/m, both bearings of the upper backup roll
  double K_Zy_lower = 0;  ///< N/m, both bearings of the lower backup roll
  double K_ZW       = 0;  ///< N/m, backup roll on its bearing centres
};

/// Springs of the chain that are parts in series.  theory.md 4.1
struct SeriesSprings {
  double K1 = 0;  ///< N/m, upper frame, (4.1a)
  double K2 = 0;  ///< N/m, upper frame to upper backup roll, (4.1b)
  double K6 = 0;  ///< N/m, lower backup roll to lower frame, (4.1c)
  double K7 = 0;  ///< N/m, lower frame, (4.1d)
};

/// A mass or stiffness of the frame, with its error.
struct FrameValue {
  double Frame::*member;
  double error;               ///< -, relative; NaN: not stated
  std::string tolerance_key;  ///< key of that error, "frame.piston_mass_tolerance"
  std::string source;         ///< of an estimated one: those of one source move together; empty: not estimated
};

/// All of [frame] that is there.
std::vector<FrameValue> frame_values(const Frame &frame);

/// Series springs of the stand.  @throws InputError  a spring not positive, named
SeriesSprings series_springs(const Frame &frame, const PathSprings &path);

/// A frame whose posts and beams are reduced to screw and seat of a drawn housing, with their masses moved to the
/// points of M1 and M6, which deflect more: behind screw, piston and packing above, packing and load cell below.
/// The kinetic energy stays, (4.13a).
/// @param K1, K7  N/m, of the chain, where given; NaN: the frame's own series
Frame with_masses_at_the_chain(Frame frame, double K1 = not_given, double K7 = not_given);

/// A frame whose parts between M1 and M2 (or M6 and M5) are not drawn, since K2 (K6) is given: those that are
/// NaN share evenly what the given spring leaves after the known parts, bearing and bending of the roll, (34.2).
/// @param K2, K6  N/m, of the chain, where given; NaN: the frame is complete there
/// @throws InputError  the given spring is stiffer than the parts behind it alone
Frame with_given_springs(Frame frame, const PathSprings &path, double K2, double K6);

/// Displacement of the parts of the load path under a bite force of 1 N, measured from the ground.  theory.md
/// (4.2)
struct Flexibilities {
  double frame_upper   = 0;  ///< m/N, M1: 1/K1
  double cylinder      = 0;  ///< m/N, u_yg
  double chock_upper   = 0;  ///< m/N, u_Zt
  double bearing_upper = 0;  ///< m/N, u_r: centre of the upper backup bearings
  double roll_upper    = 0;  ///< m/N, u2: upper backup roll, 1/K1 + 1/K2
  double frame_lower   = 0;  ///< m/N, M6 and lower chock: 1/K7
  double bearing_lower = 0;  ///< m/N
  double roll_lower    = 0;  ///< m/N, 1/K7 + 1/K6
};

/// Flexibilities for K1 and K7 as they enter the chain (computed or given).
Flexibilities flexibilities(const Frame &frame, const PathSprings &path, double K1, double K7);
}  // namespace mill::reduce
