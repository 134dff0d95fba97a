#pragma once
#include "app/run/run_context.h"
#include "core/case/provenance.h"
#include "core/model/campbell.h"
#include "core/model/pass.h"
#include "core/model/roller_bearing.h"
#include "core/records/campbell_record.h"
#include "reduce/stand/stand_comparison.h"
#include <vector>

namespace mill {
/// A kind of roll of a stand that turns, with one of its bearings.
struct TurningRoll {
  RollKind kind;
  double diameter = not_given;             ///< m; NaN: unknown, it has no lines
  std::string diameter_key;                ///< "work_roll.barrel_diameter"
  const RollerBearing *bearing = nullptr;  ///< null: none drawn, or an oil film
};

/// What a Campbell diagram is made of.
struct TurningStand {
  const reduce::StandWithModes *model = nullptr;  ///< of the rolling state, whose named modes are in the results
  std::vector<TurningRoll> rolls;
  const std::vector<Pass> &passes;
  const std::vector<DriveOrder> &drive;
};

/// m/s: the range that the settings give, or that of the passes; NaN: neither.
std::array<double, 2> working_speeds(const CampbellSettings &settings, const std::vector<Pass> &passes);

/// Lines of what turns in a stand: orders of its rolls, events of their bearings, orders of the drive; notes where
/// one is left out.  Nothing else of the record is filled.
CampbellRecord turning_lines(const CampbellSettings &settings, const TurningStand &stand);

/// Named modes over the rolling speed with the orders of what turns: curves/campbell.json, campbell.csv,
/// campbell.<mode>.speed and .distance of the crossing nearest to the working range.  Nothing without a speed and
/// the size of a roll.  theory.md 32.4
void add_campbell(RunContext &run, const CampbellSettings &settings, const TurningStand &stand);
}  // namespace mill
