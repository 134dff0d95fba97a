#pragma once
#include "core/base/choice.h"

namespace mill {
/// What an analysed record shows: the kind of a finding, and what becomes of a peak or pole that was looked at.
enum class FindingKind {
  mode,
  edge,  ///< of the band of a force
  resonance,
  line,
  family,
  lost_samples,
  locked,  ///< its frequency follows the speed
  near_instability,
  alarm,
  bearing,
  bearing_fault,
  fault_line,  ///< explained by a bearing
  severity,
  // of peaks and poles alone
  side_lobe,
  skirt,
  part_of_resonance,
  unconfirmed_pole,
  pole_of_line
};
constexpr auto words_of(FindingKind)
{
  return choice_words<FindingKind>("mode", "edge", "resonance", "line", "family", "lost samples",
                                   "locked to the speed", "near instability", "alarm", "bearing", "bearing fault",
                                   "fault line", "severity", "side lobe", "skirt of a line", "part of a resonance",
                                   "pole not confirmed", "pole of a line");
}

/// What asks to be acted on before all else.
constexpr bool is_urgent(const FindingKind kind)
{
  return kind == FindingKind::alarm || kind == FindingKind::near_instability || kind == FindingKind::bearing_fault;
}
}  // namespace mill
