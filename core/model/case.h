#pragma once
#include "core/base/errors.h"
#include "core/base/warning.h"
#include "core/model/bearing_case.h"
#include "core/model/bite_case.h"
#include "core/model/chatter.h"
#include "core/model/cluster_case.h"
#include "core/model/four_high.h"
#include "core/model/lumped.h"
#include "core/model/stack_case.h"
#include "core/model/two_cylinders.h"
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace mill {
/// A case file, read and checked.  SI inside.
struct Case {
  std::string path;  ///< of the file as given by the user
  std::string name;  ///< stem of the file name
  std::string kind;  ///< four-high | lumped | two-cylinders | bearing | bite | chatter | cluster | stack
  std::string title;
  std::variant<FourHigh, Lumped, TwoCylinders, BearingCase, BiteCase, ChatterCase, ClusterCase, StackCase> spec;
  std::vector<std::string> left_at_template;  ///< keys whose values are still those of the template
  std::vector<Warning> warnings;              ///< what is unlikely but not refused
  std::string resolved;                       ///< text of resolved.toml
  std::map<std::string, Place>
      places;  ///< "work_roll.barrel_diameter" -> where its value stands; defaults are absent
};

/// Bearing by name; the reader has checked that it exists.
const RollerBearing &bearing_of(const std::vector<RollerBearing> &bearings, const std::string &name);

/// The oil-film bearing of this name; nullptr when there is none.
const OilFilmBearing *oil_film_of(const std::vector<OilFilmBearing> &bearings, const std::string &name);

/// Reads, checks and converts a case.  `sets` are overrides "section.key=value" that go through the same rows.
/// @throws InputError with every problem of the case in one go, sorted by place
Case read_case(const std::string &path, const std::vector<std::string> &sets = {});
/// The same of a text that stands in the place of the file `path`: records are looked for from its folder.
Case read_case_of(const std::string &path, const std::string &text, const std::vector<std::string> &sets = {});
}  // namespace mill
