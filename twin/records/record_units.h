#pragma once
#include <string>
#include <string_view>

// Units of the columns of a record, in the spellings of data loggers.
namespace mill::twin {
/// What a column holds, recognised from its unit and its name.
enum class Quantity {
  acceleration,  ///< m/s2
  velocity,      ///< m/s, of a vibration
  displacement,  ///< m
  force,         ///< N
  speed,         ///< m/s, of the rolls' surface or of the strip
  voltage,       ///< V, of a sensor without calibration
  other          ///< as in the file; it is analysed and takes part in no comparison
};
const char *name_of(Quantity quantity);

/// What a unit is in SI.
struct ColumnUnit {
  std::string si;         ///< "m/s2", "N"; the text itself where the unit is unknown
  double factor     = 1;  ///< -, SI value over the number in the file
  Quantity quantity = Quantity::other;
  bool known        = false;
};

/// Unit by its spelling: those of a case file, V and mV, the usual spellings of m/s2, and in, ft, mil, in/s, ft/s,
/// in/s2, ft/s2, lbf, kip, psi and ksi.
/// @param name  of the column: distinguishes a roll's surface speed from the velocity of a vibration
ColumnUnit unit_of_column(const std::string &unit, const std::string &name);

/// Could this text be a unit, known or not: "Nm", "\u00b0C", "l/min", "U/min"?  Words and numbers are not.
bool looks_like_unit(std::string_view text);

/// Seconds in one unit of a time column: s, ms, us, ns, min, h in several languages; 0 for another unit.
double seconds_per(const std::string &unit);

/// Without blanks, tabs, carriage returns and double quotes at both ends.
std::string trimmed_cell(std::string_view text);

/// Lower case of ASCII letters.
std::string lower(std::string_view text);
}  // namespace mill::twin
