#pragma once
#include "app/stages/chatter_study.h"

namespace mill {
/// bite.<condition>.* and chatter.<condition>.* with their checks, and what has to be said of the condition.
void add_chatter_results(RunContext &run, const ChatterStudy &study);

/// "condition 2: stable below 18.21 m/s and unstable above (128.1 Hz)"
std::string verdict_sentence(const ChatterStudy &study);

/// Computed beside published and measured values of one condition.
struct PublishedRow {
  std::string quantity, unit;
  double here = not_given, published = not_given, measured = not_given;  ///< in the unit
};
std::vector<PublishedRow> published_rows(const ChatterStudy &study);

/// The comparison of all conditions as text; empty when nothing is published of any.
std::string published_table(const std::vector<ChatterStudy> &studies);

/// What a conclusion rests on: does it hold in every reading of the stand?
struct Conclusion {
  std::string text;    ///< "the upper work roll moves more than the lower"
  bool holds = false;  ///< the same in all variants
  std::string detail;
};
std::vector<Conclusion> conclusions(const ChatterStudy &study);
}  // namespace mill
