#pragma once
#include "core/model/material.h"
#include <array>
#include <string>
#include <vector>

// What millstand advise may try and what it must keep: [advice].
namespace mill {
/// A damper between two places; dampers of one name are joined together.
struct DamperProposal {
  std::string name;      ///< empty: an action of its own
  std::string from, to;  ///< places, "upper_work_roll"
  double damper = 0;     ///< N s/m, whole stand
};

/// A mass on spring and damper at a place; its tuning is computed.
struct TunedDamperProposal {
  std::string at;                 ///< place; empty: that of the advice
  double mass       = not_given;  ///< kg; NaN: by its ratio
  double mass_ratio = 0.05;       ///< -, of the effective mass of the leading mode there
};

/// The level of vibration of a place is to fall.  Bounds are factors on the present value.
struct StandAdvice {
  std::string place          = "upper_work_roll";
  std::array<double, 2> band = {not_given, not_given};  ///< Hz; NaN: from 0 to dynamics.frequency_limit
  std::vector<std::string> springs;                     ///< "K1" ..; empty: all but K4
  std::array<double, 2> stiffness     = {0.8, 1.2};     ///< -, each of these springs
  std::array<double, 2> modal_damping = {1, 1};         ///< -, all modes at once
  double usual_damper   = 1e5;   ///< N s/m, of the dampers that are tried where `dampers` is empty; 0: none
  double tuned_mass     = 0.05;  ///< -, mass ratio of the one that is tried where `tuned` is empty; 0: none
  double rise_elsewhere = 0.10;  ///< -, most that the level of another roll may rise
  double softening      = 0.10;  ///< -, most that the stiffness of the stand may fall
  std::vector<DamperProposal> dampers;
  std::vector<TunedDamperProposal> tuned;
};

/// The critical speed is to rise.  Bounds are factors on the present value.
struct ChatterAdvice {
  std::string condition;  ///< empty: the one whose critical speed is the least multiple of its speed
  double margin                         = 0.10;       ///< -, critical speed >= (1 + margin) working speed
  double wanted_speed                   = not_given;  ///< m/s, at least as fast it shall roll; NaN: as now
  double force_rise                     = 0.05;       ///< -, most that the rolling force may rise
  double torque_rise                    = not_given;  ///< -, most that the rolling torque may rise; NaN: any
  std::array<double, 2> speed           = {0.9, 1};
  std::array<double, 2> entry_thickness = {0.95, 1.05};
  std::array<double, 2> entry_tension   = {0.8, 1.2};
  std::array<double, 2> exit_tension    = {0.8, 1.2};
  std::array<double, 2> viscosity       = {0.8, 1.2};
  std::array<double, 2> stiffness       = {1, 1.1};  ///< each spring of the stand
  std::array<double, 2> damping         = {1, 2};    ///< each damper of the stand, or its modal damping
};
}  // namespace mill
