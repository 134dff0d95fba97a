#include "core/case/stand_rows.h"

// Rows of [bearing.*] that a catalogue fills and that life and limits are rated with.
namespace mill {
const std::vector<Field<RollerBearing>> &bearing_catalogue_rows()
{
  using T = RollerBearing;
  static const std::vector<Field<T>> rows{
      {"designation", &T::designation, "text", any, absent, "LM761649D/LM761610/LM761610D",
       "of a catalogue, which then gives type, bore, outside_diameter, width, rows and ratings where they are "
       "left "
       "out (required keys too); rollers and contact angle that no key gives are estimated from the ratings, and "
       "the "
       "run says so"},
      {"catalogue", &T::catalogue, "path", any, absent, "my-bearings.csv",
       "own catalogue, searched before the one of the program: a table with the columns designation, type, d "
       "[mm], D "
       "[mm], B [mm], rows, C [kN], C0 [kN], source, and e where it is known"},
      {"dynamic_rating",
       &T::dynamic_rating,
       "kN",
       {1, 1e6},
       absent,
       "2370 kN",
       "basic dynamic rating C as published; when absent by ISO 281 from the rollers"},
      {"static_rating",
       &T::static_rating,
       "kN",
       {1, 1e6},
       absent,
       "6910 kN",
       "basic static rating C0 as published; when absent by ISO 76 from the rollers"},
      {"viscosity_ratio",
       &T::viscosity_ratio,
       "1",
       {0.1, 4},
       absent,
       "1",
       "viscosity of the oil at its temperature over the one that the speed requires, kappa of ISO 281; when "
       "absent 1 "
       "is assumed, known to a factor of two"},
      {"contamination",
       &T::contamination,
       "1",
       {0.001, 1},
       absent,
       "0.3",
       "contamination factor e_C of ISO 281: 1 clean, 0.4 .. 0.2 typical, less where heavily soiled; when absent "
       "0.3 is "
       "assumed, known to 0.2 .. 0.4"},
      {"raceway_flow_stress",
       &T::raceway_flow,
       "MPa",
       {100, 10000},
       absent,
       "2000 MPa",
       "flow stress of the raceway; yield_pressure is then where the first point below a line contact yields"},
      {"raceway_flow_state", &T::raceway_state, "choice", any, RacewayTest::uniaxial, "uniaxial",
       "test that raceway_flow_stress comes from: uniaxial, sqrt(3) times the flow stress in shear, or plane "
       "strain, "
       "twice that"},
  };
  return rows;
}
}  // namespace mill
