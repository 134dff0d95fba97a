#pragma once
#include "core/model/given.h"
#include "core/model/material.h"
#include "core/model/roller_bearing.h"
#include <array>
#include <string>
#include <vector>

namespace mill {
/// [load] of kind = "bearing".
struct BearingLoad {
  std::string bearing;                                   ///< name of a [bearing.*]
  double radial               = 0;                       ///< N, towards the support of the chock
  double axial                = 0;                       ///< N, on the inner ring; 0: it keeps its axial place
  double tilt                 = 0;                       ///< rad, of the inner ring in the plane of the load
  std::array<double, 2> loads = {not_given, not_given};  ///< N, swept range of the radial load
  int samples                 = 20;
  double cage_angle           = 0;  ///< rad
};

/// [dynamics] of kind = "bearing": a mass on the bearing's curve.
struct BearingExcitation {
  double mass        = not_given;  ///< kg; absent: nothing is driven
  double damping     = 0;          ///< N s/m
  double amplitude   = 0;          ///< N, of the harmonic force
  double frequency   = 100;        ///< Hz
  double direction   = 0;          ///< rad, from the line of the load
  double duration    = 0.5;        ///< s
  double output_rate = 20e3;       ///< Hz
};

/// kind = "bearing": one roller bearing in its chock.
struct BearingCase {
  std::vector<RollerBearing> bearings;
  BearingLoad load;
  BearingExcitation motion;
  GivenValues published;  ///< only shown beside the computed values
};
}  // namespace mill
