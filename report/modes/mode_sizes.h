#pragma once
#include "report/modes/model_data.h"
#include <map>
#include <string>

// What the drawing of a stand takes from the stored geometry.
namespace mill::report {
struct RollSizes {
  double radius, half_barrel, neck, half_total,
      seat;  ///< m; neck: its radius, seat: place of the bearing's centre
};

struct StandSizes {
  RollSizes backup, work;
  double half_strip;  ///< m
};

/// From run.json; without the rolls' sizes the proportions of a stand of 1400 mm, as long as the model's longest
/// axis.
StandSizes sizes_of(const ComparedModel &model, const std::map<std::string, double> &geometry);
}  // namespace mill::report
