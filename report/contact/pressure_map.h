#pragma once
#include "core/records/csv.h"
#include <string>

namespace mill::report {
/// Pressure over a contact patch, written station by station: columns z [m] along the line, x [m] across it,
/// pressure [Pa].  Empty when the table is not such a grid.
/// @param along   what z is, for the axis
/// @param width   px
/// @param height  px
std::string pressure_map(const Table &table, const std::string &title, const std::string &along,
                         double width = 1000, double height = 300);

/// The same of another column of the patch.
/// @param quantity  as the legend calls it
struct PatchQuantity {
  const char *column, *quantity, *unit;
};
std::string patch_map(const Table &table, const PatchQuantity &what, const std::string &title,
                      const std::string &along, double width = 1000, double height = 300);
}  // namespace mill::report
