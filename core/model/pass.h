#pragma once
#include "core/base/errors.h"
#include "core/model/material.h"
#include <array>
#include <string>

namespace mill {
/// One pass: a recorded rolling force, and what was measured with it.
struct Pass {
  std::string name;                                    ///< unique, names the response file
  std::string force_file;                              ///< path as usable from the working directory
  std::string measured_file;                           ///< same; empty: none
  Place place;                                         ///< of the [[pass]] header
  Place force_place, measured_place;                   ///< of the two path values
  double entry_thickness                 = not_given;  ///< m, absent: that of [strip]
  double exit_thickness                  = not_given;  ///< m
  double entry_tension                   = not_given;  ///< Pa, absent: that of [strip]
  double exit_tension                    = not_given;  ///< Pa
  double speed                           = not_given;  ///< m/s, of the rolls' surface
  std::array<double, 2> published_peak_g = {not_given,
                                            not_given};  ///< g, upper and lower work roll, a published model's
  std::array<double, 2> measured_peak_g  = {not_given,
                                            not_given};  ///< g, a measurement of which only peaks are known
  bool synthetic = false;      ///< the force record is synthetic, not measured; the results state this
  double load    = not_given;  ///< N, working load; absent: mean of the force record
  std::array<double, 2> synthetic_range = {not_given,
                                           not_given};  ///< N, without a file: white noise in this range
  double forward_slip                   = not_given;    ///< -, measured
  double torque                         = not_given;    ///< N m, measured, of one roll, over the strip width
  double force_deviation                = 0.02;         ///< -, standard deviation of the load over it
  double slip_deviation                 = 0.003;        ///< -, of the slip: 0.3 points
  double torque_deviation               = 0.05;         ///< -, of the torque over it
  double synthetic_duration             = 10;           ///< s
  double synthetic_bandwidth            = 1000;         ///< Hz
  int synthetic_seed                    = 1;
};
}  // namespace mill
