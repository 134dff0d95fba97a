#pragma once
#include <string>

namespace mill {
/// Options of millstand calibrate as the user wrote them.
struct CalibrateOptions {
  std::string measured;     ///< --measured: folder of the records
  std::string free;         ///< --free: "K1, M2/M5, frame, zeta"; empty: all
  std::string model_error;  ///< --model-error: "5 %", of the level of a third octave
  bool plan   = false;
  bool accept = false;
  bool align  = false;         ///< --align: the delay of two clocks is one more unknown
  std::string sensors;         ///< --sensors, of the plan; empty: both work rolls
  std::string duration;        ///< --duration, of the plan
  std::string noise;           ///< --noise, of the plan, per root Hz
  std::string force;           ///< --force-rms, of the plan
  std::string highest;         ///< --force-up-to, of the plan
  bool without_force = false;  ///< --without-force, of the plan
};
}  // namespace mill
