#pragma once
#include "core/base/note.h"
#include "core/model/process_advice.h"
#include "reduce/stand/component_stand.h"
#include "twin/advice/advice.h"
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mill {
struct Case;

/// A drawing in more detail than six masses, with chocks on their bearings.
struct DetailedStand {
  std::string name;  ///< "beams", "component modes"
  twin::VibratingStand as_it_is;
  /// It after a change of K1, K3, K5, K7, damping and rolling force, as the case means its force or without the
  /// bite; nothing for a change of another spring, which it holds in parts.
  std::function<std::optional<twin::VibratingStand>(const twin::StandChange &, bool with_bite)> after;
};

/// The rolls of a drawing as component modes, when they are wanted.
using Components = std::function<reduce::StandComponents()>;

/// The stand of a case as advice is asked of it.
struct AdvisedModel {
  twin::AdvisedStand advised;
  std::string source;  ///< "six masses by closed forms at 976.2 kN"
  std::optional<DetailedStand>
      detailed;  ///< where the case is a drawing; actions of the chain are tried again here
  std::optional<twin::RolledPass> pass;        ///< where the case says enough of it
  std::map<std::string, double> spring_error;  ///< -, relative error of springs of the chain, as far as known
  std::vector<twin::UnidentifiedParameter> unidentified;
  double limit = 1000;  ///< Hz, up to which its modes are right
  std::vector<Note> notes;
};

/// Kind four-high by closed forms at the load of its first pass, kind lumped as given or as its files say.
/// @param rolled  read for kind four-high
/// The detailed stand where a place of [advice] exists in it and not in the six masses.
/// @throws InputError  another kind; what the closed forms, the files or the meshes refuse
/// Cost: some 0.1 s for the beams.
AdvisedModel advised_model(const Case &the_case, const StandAdvice &asked, const RolledAdvice &rolled,
                           const Components &components);
}  // namespace mill
