#pragma once
#include "core/model/given.h"
#include "core/model/material.h"
#include "core/model/oil_film_bearing.h"
#include "core/model/roller_bearing.h"
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace mill {
/// [load] of kind = "bearing".
struct BearingLoad {
  std::string bearing;                                    ///< name of a [bearing.*]
  double radial                = 0;                       ///< N, towards the support of the chock
  double axial                 = 0;                       ///< N, on the inner ring; 0: it keeps its axial place
  double tilt                  = 0;                       ///< rad, of the inner ring in the plane of the load
  std::array<double, 2> loads  = {not_given, not_given};  ///< N, swept range of the radial load
  int samples                  = 20;
  double cage_angle            = 0;          ///< rad
  double axial_displacement    = not_given;  ///< m, imposed on the inner ring in place of an axial load
  double moment                = not_given;  ///< N m, in the plane of the load, in place of a tilt
  double speed                 = not_given;  ///< 1/s, of the shaft or sleeve; absent: nothing turns
  double tilt_across           = 0;          ///< rad, oil film: of the sleeve across the plane of the load
  std::array<double, 2> speeds = {not_given, not_given};  ///< 1/s, oil film: swept range
};

template <class Io> void each_member(Io &&io, const BearingLoad &record)
{
  const auto &[bearing, radial, axial, tilt, loads, samples, cage_angle, axial_displacement, moment, speed,
               tilt_across, speeds] = record;
  io("bearing", bearing);
  io("radial", radial);
  io("axial", axial);
  io("tilt", tilt);
  io("loads", loads);
  io("samples", samples);
  io("cage_angle", cage_angle);
  io("axial_displacement", axial_displacement);
  io("moment", moment);
  io("speed", speed);
  io("tilt_across", tilt_across);
  io("speeds", speeds);
}

/// Whether the load tilts the bearing or pushes it along its axis: then the places of the rows count.
inline bool loaded_askew(const BearingLoad &load)
{
  return load.tilt != 0 || load.axial != 0 || std::isfinite(load.axial_displacement) || std::isfinite(load.moment);
}

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

template <class Io> void each_member(Io &&io, const BearingExcitation &record)
{
  const auto &[mass, damping, amplitude, frequency, direction, duration, output_rate] = record;
  io("mass", mass);
  io("damping", damping);
  io("amplitude", amplitude);
  io("frequency", frequency);
  io("direction", direction);
  io("duration", duration);
  io("output_rate", output_rate);
}

/// kind = "bearing": one roller bearing in its chock, or one oil-film bearing.
struct BearingCase {
  std::vector<RollerBearing> bearings;
  std::vector<OilFilmBearing> oil_films;
  BearingLoad load;
  BearingExcitation motion;
  GivenValues published;  ///< only compared with the computed values
};
}  // namespace mill
