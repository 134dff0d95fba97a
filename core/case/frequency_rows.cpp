#include "core/case/stand_rows.h"

// Frequency response, Campbell diagram and orders of the drive.  Columns as in stand_rows.cpp.
namespace mill {
const std::vector<Field<FrequencyResponseSettings>> &frequency_response_rows()
{
  using T = FrequencyResponseSettings;
  static const std::vector<Field<T>> rows{
      {"range",
       &T::range,
       "Hz",
       {0.01, 100000},
       absent,
       R"(["20 Hz", "1000 Hz"])",
       "of the frequency response; when absent from half of the lowest mode to dynamics.frequency_limit, without "
       "detailed models to one and a half times the highest mode"},
      {"resolution",
       &T::resolution,
       "Hz",
       {0.001, 10000},
       absent,
       "0.5 Hz",
       "step between the frequencies; when absent a quarter of the half width of every resonance near it and "
       "wider between them"},
      {"damping_tolerance",
       &T::damping_tolerance,
       "%",
       {0, 100},
       absent,
       "30 %",
       "how far dynamics.modal_damping may be off; when absent the band of the response holds at the damping "
       "given and its peaks state no error"},
  };
  return rows;
}

namespace {
std::vector<Field<CampbellSettings>> speed_rows()
{
  using T = CampbellSettings;
  return {
      {"speeds",
       &T::speeds,
       "m/s",
       {0, 200},
       absent,
       R"(["0 m/s", "15 m/s"])",
       "range of the diagram, surface of the rolls; when absent from rest to one and a half times the largest "
       "working speed"},
      {"working_speeds",
       &T::working_speeds,
       "m/s",
       {0.001, 200},
       absent,
       R"(["2 m/s", "10 m/s"])",
       "range in which the mill rolls; when absent the speeds of the passes"},
      {"roll_orders",
       &T::roll_orders,
       "count",
       {0, 100},
       5,
       "5",
       "orders 1 to this of the turning of work and backup rolls"},
      {"bearing_harmonics",
       &T::bearing_harmonics,
       "count",
       {0, 20},
       2,
       "2",
       "harmonics of the cage and of the pass frequencies of every roll-neck bearing"},
  };
}
}  // namespace

const std::vector<Field<CampbellSettings>> &campbell_rows()
{
  static const std::vector<Field<CampbellSettings>> rows = speed_rows();
  return rows;
}

const std::vector<Field<CampbellSettings>> &chain_campbell_rows()
{
  using T                                                = CampbellSettings;
  static const std::vector<Field<CampbellSettings>> rows = [] {
    auto all = speed_rows();
    all.pop_back();  // a chain of given numbers has no bearings
    all.push_back({"work_roll_diameter",
                   &T::work_roll_diameter,
                   "mm",
                   {50, 2500},
                   absent,
                   "420 mm",
                   "for the turns of the work rolls at a speed; when absent their orders are left out"});
    all.push_back({"backup_roll_diameter",
                   &T::backup_roll_diameter,
                   "mm",
                   {50, 2500},
                   absent,
                   "1450 mm",
                   "likewise of the backup rolls"});
    return all;
  }();
  return rows;
}

const std::vector<Field<DriveOrder>> &drive_order_rows()
{
  using T = DriveOrder;
  static const std::vector<Field<T>> rows{
      {"name", &T::name, "text", any, required, "pinion teeth", "unique; names its line in the Campbell diagram"},
      {"per_turn_of", &T::per_turn_of, "choice", any, RollKind::work_roll, "work roll",
       "shaft whose turns are counted"},
      {"count",
       &T::count,
       "1",
       {0.001, 10000},
       required,
       "23",
       "events in one of its turns: teeth of a pinion, 2 of a universal joint, behind a gear the ratio"},
  };
  return rows;
}
}  // namespace mill
