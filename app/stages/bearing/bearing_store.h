#pragma once
#include "app/stages/bearing/bearing_study.h"
#include <optional>
#include <string>
#include <vector>

namespace mill {
/// Every state that was solved for one question to a bearing.
struct SolvedBearing {
  std::vector<bearing::AssemblyState> curve, standard_curve, rigid_curve;
  bearing::AssemblyState at, standard, rigid, palmgren;
  double slice_deviation = 0;
  std::vector<bearing::AssemblyState> companions, supports, arrangements;
};

/// Everything that they depend on, as text; its hash is the key of the cache.
/// @param largest_load  N, on one roller, that its mesh is made for
std::string bearing_inputs_text(const BearingQuestion &question, double largest_load);

/// @throws InputError  cannot be written
void save_bearing(const std::string &path, const std::string &key, const SolvedBearing &solved);
/// What was kept, or nothing; `note` says why an entry cannot be used.
std::optional<SolvedBearing> load_bearing(const std::string &path, const std::string &key, std::string *note);
}  // namespace mill
