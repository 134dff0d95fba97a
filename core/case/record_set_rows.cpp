#include "core/case/record_set_rows.h"

namespace mill {
const std::vector<Field<RecordSet>> &record_set_rows()
{
  using S = RecordSet;
  static const std::vector<Field<S>> rows{
      {"band",
       &S::band,
       "Hz",
       {1, 1e5},
       absent,
       "[\"20 Hz\", \"900 Hz\"]",
       "band of the fit; when absent 20 to 900 Hz"},
      {"level_force",
       &S::level_force,
       "kN",
       {1e-6, 1e5},
       absent,
       "1 kN",
       "rms of the force behind the levels, where it is known"},
      {"level_bandwidth",
       &S::level_bandwidth,
       "Hz",
       {1, 1e5},
       1000,
       "1000 Hz",
       "bandwidth of the force behind the levels"},
  };
  return rows;
}

const std::vector<Field<RecordEntry>> &record_rows()
{
  using E = RecordEntry;
  static const std::vector<Field<E>> rows{
      {"file", &E::file, "path", {}, required, "pass-1.csv", "record, relative to the folder"},
      {"role",
       &E::role,
       "choice",
       {},
       absent,
       "check",
       "without any role the last third of each record is the check"},
      {"load",
       &E::load,
       "kN",
       {1, 1e5},
       absent,
       "976 kN",
       "mean rolling force, where the force channel of the record does not hold it"},
      {"between",
       &E::between,
       "choice",
       {},
       BetweenSamples::smooth,
       "smooth",
       "course of the force between its samples: a simulated record was driven by straight lines"},
  };
  return rows;
}

const std::vector<Field<MeasuredLevel>> &level_rows()
{
  using L = MeasuredLevel;
  static const std::vector<Field<L>> rows{
      {"place", &L::place, "text", {}, required, "upper_work_roll", "place of the sensor"},
      {"rms",
       &L::rms,
       "g",
       {1e-6, 1e4},
       absent,
       "0.4 g",
       "root mean square of the acceleration; either rms or peak"},
      {"peak", &L::peak, "g", {1e-6, 1e4}, absent, "1.2 g", "0-peak acceleration, where no rms was measured"},
      {"error", &L::error, "1", {1e-4, 1}, 0.03, "0.03", "relative standard deviation of the level"},
  };
  return rows;
}

std::vector<SectionRows> record_set_sections()
{
  using Repeat = SectionRows::Repeat;
  return {
      {"", Repeat::once, true, "of all records and levels of the folder", rows_of(record_set_rows())},
      {"record", Repeat::list, false,
       "a record of the folder; a table `channels = { \"AI_07\" = \"upper_work_roll\" }` names its columns",
       rows_of(record_rows())},
      {"level", Repeat::list, false, "a level that was measured without its record: one number of a pass",
       rows_of(level_rows())},
  };
}
}  // namespace mill
