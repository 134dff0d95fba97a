#pragma once
#include "core/case/fields.h"
#include "core/case/stand_rows.h"
#include <string>

// Keys of a kind of case by their full names, and what of the drawing they are.
namespace mill::studio {
/// Row of a full key, "pass.0.load", "bearing.trb.bore"; nullptr: the kind has no such key.
const Row *row_of_key(const std::string &kind, const std::string &key);

/// Entry of the geometry record that a key of a four-high stand is drawn by: "work_roll.barrel_diameter" ->
/// "work_roll_diameter"; empty: none.
std::string picture_of(const std::string &key);

/// GET /schema: the rows of a kind of case with unit, range, default, help and place in the picture, its drawing
/// values in their order, and the units.
std::string schema_json(const std::string &kind);
}  // namespace mill::studio
