#pragma once
#include "core/records/campbell_record.h"
#include "core/records/marks_record.h"
#include <array>
#include <string>
#include <vector>

// Marks at equal distances on the strip: which roll, which event of a turn, which mode.  theory.md 40
namespace mill::dynamics {
/// Frequency at which marks of a spacing (m) are made on a strip of a speed (m/s), Hz, and the other way round.
/// (40.1)
double mark_frequency(double speed, double spacing);
double mark_spacing(double speed, double frequency);
/// Turns of a roll in a second, Hz: surface speed m/s, diameter m.
double rotation_of(double surface_speed, double diameter);
/// Marks on one turn of a roll whose surface is slower than the strip by the forward slip.  (40.2)
double marks_per_turn(double spacing, double diameter, double forward_slip = 0);

/// A roll that touches the strip or another roll without slipping.
struct MarkRoll {
  std::string name;             ///< "control roll"
  double diameter = not_given;  ///< m
  std::string diameter_key;     ///< of the case, "work_roll.barrel_diameter"
};

/// What in a stand could make marks; a roll without a diameter is left out with a note.
struct MarkSources {
  std::vector<MarkRoll> rolls;
  std::vector<CampbellLine> events;  ///< once per event, without their harmonics
  std::vector<CampbellMode> modes;
  std::string model;      ///< whose modes
  double damping = 0.01;  ///< -, modal
};

/// All but the maps.
/// @throws InputError  spacing, speed or accuracy that is not positive, a forward slip of -1 or less, a side band
///                     that is not positive, no roll with a diameter
/// Cost: microseconds.
MarksRecord marks_of(const MarksQuestion &question, const MarkSources &sources);

/// Axes of a map: speeds from half to one and a half times the strip's; waves from one up to twice the asked ones
/// and beyond the highest mode, at most `rows` of them.  Where more are asked for, those around them if a mode is
/// met there, else the first ones.
struct MapAxes {
  Eigen::VectorXd speed;  ///< (n) m/s
  Eigen::VectorXd waves;  ///< (m)
};
MapAxes map_axes(const MarksQuestion &question, double diameter, const std::vector<CampbellMode> &modes,
                 int columns = 400, int rows = 400);

/// Magnification of the waves of a roll by the modes.  (40.5)
/// Cost: modes x columns x rows, 10 ms for six modes and 400 x 400.
MarkMap mark_map(const MarksQuestion &question, const MarkRoll &roll, const MarkSources &sources,
                 const MapAxes &axes);
}  // namespace mill::dynamics
