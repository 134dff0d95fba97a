#pragma once
#include "twin/advice/advice.h"
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mill {
struct Case;
struct StandAdvice;

/// The stand of a case as advice is asked of it.
struct AdvisedModel {
  twin::AdvisedStand advised;
  std::string source;  ///< "six masses by closed forms at 976.2 kN"
  /// With rolls as beams and chocks on their bearings, where the case is a drawing; the actions of the chain are
  /// tried again here.
  std::optional<twin::VibratingStand> beam;
  /// The same with factors on K1, K3, K5, K7; none where a factor is on another spring, which beams hold in parts.
  std::function<std::optional<twin::VibratingStand>(const std::vector<std::pair<std::string, double>> &)>
      beam_with;
  std::map<std::string, double> spring_error;  ///< -, relative error of springs of the chain, as far as known
  std::vector<twin::UntoldParameter> untold;
  double limit = 1000;  ///< Hz, up to which its modes are right
  std::vector<std::string> notes;
};

/// Kind four-high by closed forms at the load of its first pass, kind lumped as given or as its files say.
/// Where a place of [advice] is none of the six masses but one of the beams, the beams are the stand.
/// @throws InputError  another kind; what the closed forms or the files refuse
/// Cost: some 0.1 s for the beams.
AdvisedModel advised_model(const Case &the_case, const StandAdvice &asked);
}  // namespace mill
