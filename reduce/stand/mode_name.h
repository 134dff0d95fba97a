#pragma once
#include <limits>
#include <string>

namespace mill::reduce {
/// How a mode moves the gap between the work rolls.  theory.md 22.9
enum class GapKind {
  none,   ///< too small a share of the gap's compliance
  first,  ///< work roll with its backup roll
  second  ///< work roll against its backup roll
};

/// What a mode of a stand is called in a rolling mill, and why.  theory.md 22.9
struct ModeName {
  std::string name;     ///< "gap mode, first kind (third octave)"
  std::string key;      ///< of results: "gap_first_kind"; empty: the mode has no result of its own
  std::string decided;  ///< "work roll with its backup roll in the lower stack (64 % of the kinetic energy); ..."
  /// Name by the shares of its own model, where the name is that of a more detailed model and differs; else empty.
  std::string own_name = {};
  GapKind kind         = GapKind::none;
  double gap_share = std::numeric_limits<double>::quiet_NaN();  ///< -, 0..1, share of the gap's static compliance
  bool listed      = true;  ///< the gap or a sensor sees it; else tables fold it
};
}  // namespace mill::reduce
