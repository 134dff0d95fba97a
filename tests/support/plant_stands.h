#pragma once

#include "tests/support/calibration_record.h"
#include "tests/support/near.h"
#include "twin/calibration/calibration_parts.h"
#include "twin/calibration/words.h"
#include <cmath>
#include <map>
#include <string>
#include <vector>

/// Stands of a plant for tests of the calibration: the stated errors of a drawing, right stands drawn within them
/// and wrong ones.
namespace mill::twin {
/// Errors of a case that was made from a drawing with estimates: 82 % of a spring is 82 %.
inline std::vector<Unknown> stated_errors_of_a_drawing()
{
  return {{"K1", 0.15}, {"K2", 0.82}, {"K3", 0.09},          {"K5", 0.09}, {"K6", 0.40},
          {"K7", 0.15}, {"M1", 0.10}, {"M2", 0.05},          {"M3", 0.04}, {"M4", 0.04},
          {"M5", 0.05}, {"M6", 0.10}, {"zeta", std::log(2.)}};
}

inline CalibrationInput calibration_of(const calibration::Recipe &recipe, const std::vector<Unknown> &unknowns)
{
  CalibrationInput input;
  input.stand    = calibration::stand_r();
  input.unknowns = unknowns;
  input.places   = recipe.places;
  input.sensors  = {"upper_work_roll", "lower_work_roll"};
  input.rate     = recipe.rate;
  input.threads  = 2;
  for (const auto &[from, into] : {std::pair{recipe, &input.fit}, std::pair{recipe.check(), &input.check}}) {
    const auto made = calibration::record(from);
    into->push_back({made.force, made.acceleration});
  }
  return input;
}

inline calibration::Recipe recipe_of(const std::uint64_t seed)
{
  calibration::Recipe recipe = calibration::recipe("two");
  recipe.truth.clear();
  recipe.seed = seed;
  return recipe;
}

inline void expect_values_inside_their_intervals(const Calibration &done)
{
  for (const bool written : {false, true})
    for (const Calibrated &u : done.unknowns) {
      if (!u.identified)
        continue;
      const ChangeInterval change = change_interval(u, written);
      EXPECT_LE(change.low, change.value) << u.name;
      EXPECT_GE(change.high, change.value) << u.name;
    }
}

struct WrongStand {
  std::string name;
  std::map<std::string, double> truth;  // ln of factors on the case
  mill::FrameForm frame = mill::FrameForm::open;
};

inline std::vector<WrongStand> wrong_stands()
{
  const double lost = std::log(0.05), heavy = std::log(1.5), light = std::log(0.6);
  return {
      {"closed frame", {}, mill::FrameForm::closed},
      {"lost contact, upper", {{"K3", lost}}},
      {"lost contact, lower", {{"K5", lost}}},
      {"work roll of another mill, upper", {{"M3", heavy}}},
      {"work roll of another mill, lower", {{"M4", light}}},
      {"backup rolls of another mill", {{"M2", heavy}, {"M5", heavy}}},
      {"light backup rolls", {{"M2", light}, {"M5", light}}},
      {"half a contact, upper", {{"K3", std::log(0.5)}}},
      {"half a contact, lower", {{"K5", std::log(0.5)}}},
      {"housing of another mill", {{"K1", std::log(2.5)}, {"K7", std::log(2.5)}}},
  };
}

/// A wrong stand is refused after 1.5 s: more of a record only makes it plainer.
inline void expect_refused(const WrongStand &wrong, const int repeat)
{
  calibration::Recipe recipe = recipe_of(8000 + 100 * std::uint64_t(repeat));
  recipe.truth               = wrong.truth;
  recipe.frame               = wrong.frame;
  recipe.n                   = 30000;
  const Calibration done     = calibrate(calibration_of(recipe, stated_errors_of_a_drawing()), {});
  EXPECT_FALSE(done.refusals.empty()) << wrong.name;
  expect_values_inside_their_intervals(done);
}
}  // namespace mill::twin
