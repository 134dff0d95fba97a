#pragma once
#include "core/base/errors.h"
#include "core/model/advice.h"
#include "core/model/linearisation.h"
#include "core/model/lumped.h"
#include "core/model/lumped_model.h"
#include "core/model/material.h"
#include "core/model/strip.h"
#include <array>
#include <optional>
#include <string>
#include <vector>

// What a case says about chatter: the stand around the bite, the rolling conditions, the search.
namespace mill {
/// Free strip before and behind a stand.
struct StandSpan {
  double entry_distance = not_given;  ///< m, to the previous stand
  double exit_distance  = not_given;  ///< m, to the next stand
};

/// Stand of a tandem mill as [stand] and [variant.NAME] describe it.  Bodies from the top: upper housing, upper
/// backup roll, upper work roll, lower work roll, lower backup roll, lower housing.  theory.md 25
struct ChatterStand : StandSpan {
  std::array<double, 6> masses{not_given};       ///< kg, m0..m5
  std::array<double, 6> stiffnesses{not_given};  ///< N/m, k0 ground-0, k1 0-1, k2 1-2, k4 3-4, k5 4-5, k6 5-ground
  std::array<double, 6> dampings{not_given};     ///< N s/m, c0 0-1, c1 0-2, c2 1-2, c3 3-4, c4 3-5, c5 4-5
  std::string from;                              ///< path of a lumped_model.toml that replaces the three; or empty
};

/// Another reading of the stand: what it gives replaces what [stand] says.
struct ChatterVariant {
  std::string name;
  ChatterStand stand;  ///< as written: what it leaves open is absent and that of [stand]
  Place place;
};

/// What rolls at one working point.
struct RollingCondition {
  std::string name;                             ///< unique, names the files of its results
  Place place;                                  ///< of the [[condition]] header
  double entry_thickness = 0;                   ///< m
  double exit_thickness  = 0;                   ///< m
  double entry_tension   = 0;                   ///< Pa
  double exit_tension    = 0;                   ///< Pa
  double width           = 0;                   ///< m
  double speed           = 0;                   ///< m/s, working speed of the rolls' surface
  std::string after;                            ///< condition of the stand before this one in a tandem; or empty
  double published_critical_speed = not_given;  ///< m/s, of a published model
  double published_force          = not_given;  ///< N
  double published_friction       = not_given;  ///< -
  double measured_force           = not_given;  ///< N
  double measured_critical_speed  = not_given;  ///< m/s
  std::string note;  ///< what to know of the published values, for instance which were used to fit inputs
};

/// How stability is searched and shown.
struct ChatterAnalysis {
  Linearisation linearisation  = Linearisation::sequential;
  std::array<double, 2> speeds = {1, 30};  ///< m/s, range searched
  int map_points               = 60;       ///< along each side of the stability maps; 0: none
  double disturbance           = 1e-7;     ///< m, of both work rolls at the start of the histories
  double duration              = 0.6;      ///< s, of the histories
};

/// kind = "chatter"
struct ChatterCase {
  Material steel;                                             ///< of the rolls
  double roll_diameter = 0;                                   ///< m, work roll
  Strip strip;                                                ///< thicknesses, tensions and width: by condition
  bool oiled                       = false;                   ///< [oil] says the friction, else [strip]
  std::array<double, 2> film_range = {not_given, not_given};  ///< m, oil film over which the friction was measured
  ChatterStand stand;
  std::optional<LumpedModel> model;  ///< of stand.from, six masses
  std::optional<ModelFiles> files;   ///< of stand.from, a model of any number of unknowns
  double modal_damping = 0.01;       ///< -, of that model
  std::vector<ChatterVariant> variants;
  std::vector<RollingCondition> conditions;
  ChatterAnalysis analysis;
  ChatterAdvice advice;
};
}  // namespace mill
