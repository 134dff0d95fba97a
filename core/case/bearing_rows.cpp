#include "core/case/stand_rows.h"

// Rows of [bearing.*] and of the other sections of kind = "bearing".
namespace mill {
namespace {
constexpr Range chock_size{20, 6000};

// The rows of a drawing with those of catalogue and rating behind them.
std::vector<Field<RollerBearing>> with_catalogue_rows(std::vector<Field<RollerBearing>> rows)
{
  const auto &more = bearing_catalogue_rows();
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}
}  // namespace

const std::vector<Field<RollerBearing>> &bearing_rows()
{
  using T = RollerBearing;
  static const std::vector<Field<T>> drawn{
      {"type", &T::type, "choice", any, required, "four-row tapered",
       "decides whether the contact angles are used; an oil film has other keys"},
      {"bore", &T::bore, "mm", {20, 2500}, absent, "266.7 mm", "bore of the inner ring"},
      {"outside_diameter", &T::outside_diameter, "mm", {30, 3500}, absent, "355.6 mm", "of the outer ring"},
      {"width", &T::width, "mm", {5, 3000}, absent, "230.188 mm", "over all rows"},
      {"pitch_diameter",
       &T::pitch_diameter,
       "mm",
       {20, 3000},
       absent,
       "311.15 mm",
       "of the roller set at mid-roller; when absent the mean of bore and outside diameter"},
      {"rows", &T::rows, "count", {1, 8}, 4, "4", "rows of rollers"},
      {"rollers_per_row", &T::rollers_per_row, "count", {3, 300}, required, "39", "rollers in one row"},
      {"roller_length", &T::roller_length, "mm", {1, 1000}, required, "33.4 mm", "effective length"},
      {"roller_total_length",
       &T::roller_total_length,
       "mm",
       {1, 1100},
       absent,
       "33.4 mm",
       "of the roller from end to end; when absent the effective length"},
      {"roller_diameter",
       &T::roller_diameter,
       "mm",
       {1, 500},
       absent,
       "21.5 mm",
       "mean diameter; when absent from the apex condition, if cone and cup angle are given"},
      {"roller_cone_angle",
       &T::roller_cone_angle,
       "deg",
       {0, 20},
       0,
       "2.5 deg",
       "included angle of the roller; tapered, when absent: from the apex condition"},
      {"cup_angle",
       &T::cup_angle,
       "deg",
       {0, 60},
       0,
       "19.66 deg",
       "contact angle on the outer ring; it closes the apex condition with the roller and the pitch diameter, and "
       "is computed from it when absent"},
      {"rib_angle",
       &T::rib_angle,
       "deg",
       {0, 90},
       absent,
       "70 deg",
       "of the rib's face normal against the radial plane; when absent along the roller's axis"},
      {"arrangement", &T::arrangement, "back-to-back | face-to-face | +-+- | -+-+ | ++-- | --++ | +- | -+ | + | -",
       any, absent, "face-to-face",
       "arrangement of the rows of a tapered bearing: a word, or the axial direction in which the cup of each row "
       "carries, repeated over the rows. back-to-back is +- (of four rows: two double cups, TQI), face-to-face "
       "is -+ (of four rows: two double cones, TQO). It decides the row shares under tilt, the axial forces of "
       "the "
       "rows and the tilting stiffness; when absent +-+- is assumed and the run warns"},
      {"radial_clearance",
       &T::radial_clearance,
       "mm",
       {-1, 5},
       0,
       "0 mm",
       "diametral clearance in the radial plane, negative for preload"},
      {"end_play",
       &T::end_play,
       "mm",
       {0, 10},
       absent,
       "0.1 mm",
       "axial clearance of opposed rows, in place of radial_clearance"},
      {"preload",
       &T::preload,
       "kN",
       {0, 1e4},
       absent,
       "10 kN",
       "axial, of each row, in place of radial_clearance"},
      {"profile", &T::profile, "choice", any, RollerProfile::none, "iso", "profile of the roller"},
      {"crown_drop",
       &T::crown_drop,
       "um",
       {0.01, 2000},
       absent,
       "20 um",
       "drop of the roller end, profiles crown and three-parameter"},
      {"profile_load",
       &T::profile_load,
       "kN",
       {0.001, 1e4},
       absent,
       "30 kN",
       "load of one roller for which a logarithmic profile is ground; when absent that of a pressure of 2 GPa"},
      {"profile_share",
       &T::profile_share,
       "1",
       {0.01, 1},
       1,
       "0.8",
       "crowned part of the length, profile three-parameter"},
      {"profile_table",
       &T::profile_table,
       "mm, um",
       {0, 2000},
       absent,
       "[[\"-16.7 mm\", \"20 um\"], [\"0 mm\", \"0 um\"], [\"16.7 mm\", \"20 um\"]]",
       "drop of one contact over the distance from mid-roller, straight between the points, profile table"},
      {"youngs_modulus",
       &T::youngs_modulus,
       "GPa",
       {1, 1000},
       206,
       "206 GPa",
       "of rollers and rings, and of neck and chock where they are elastic"},
      {"poisson_ratio", &T::poisson_ratio, "1", {0, 0.49}, 0.3, "0.3", "of the same"},
      {"yield_pressure",
       &T::yield_pressure,
       "MPa",
       {100, 20000},
       4000,
       "4000 MPa",
       "contact pressure a raceway bears without a lasting dent (static rating of roller bearings)"},
      {"roller_law", &T::roller_law, "choice", any, absent, "fe",
       "law of one roller between two raceways; when absent fe if bore, outside diameter, width and roller "
       "diameter "
       "are given, else iso"},
      {"rings", &T::rings, "choice", any, absent, "elastic",
       "whether rings, neck and chock deflect; when absent elastic if their sizes are given, else rigid"},
      {"slices", &T::slices, "count", {1, 1001}, 41, "41", "laminae along one roller"},
      {"chock", &T::chock, "choice", any, absent, "block",
       "what holds the cup when the rings are elastic: a block with a bore, supported on one face; a round "
       "housing as large as it; a rigid support. When absent a block; with its sizes absent too, a rigidly held "
       "cup is part of the error estimate"},
      {"chock_width", &T::chock_width, "mm", chock_size, absent, "600 mm",
       "across the load; when absent 1.7 outside diameters, assumed"},
      {"chock_height", &T::chock_height, "mm", chock_size, absent, "560 mm",
       "along the load; when absent 1.6 outside diameters, assumed"},
      {"chock_length", &T::chock_length, "mm", chock_size, absent, "260 mm",
       "along the axis; when absent the width of the bearing, assumed"},
      {"chock_support_width", &T::chock_support_width, "mm", chock_size, absent, "600 mm",
       "of the face that carries the chock, centred on the line of the load; when absent the width of the chock, "
       "assumed, and other supports count in the accuracy"},
      {"chock_support_gap",
       &T::chock_support_gap,
       "mm",
       {0, 6000},
       absent,
       "400 mm",
       "middle part of that face, which carries no load: a chock on two feet; when absent none, or two thirds of "
       "an assumed support that is not a backup roll's"},
  };
  static const std::vector<Field<T>> rows = with_catalogue_rows(drawn);
  return rows;
}

const std::vector<Field<BearingLoad>> &bearing_load_rows()
{
  using T = BearingLoad;
  static const std::vector<Field<T>> rows{
      {"bearing", &T::bearing, "text", any, required, "trb", "name of the [bearing.*] that is loaded"},
      {"radial",
       &T::radial,
       "kN",
       {0, 1e6},
       required,
       "1000 kN",
       "radial load, towards the support of the chock and on the line of one roller; zero for a bearing that is "
       "only loaded along its axis or tilted"},
      {"axial",
       &T::axial,
       "kN",
       {-1e6, 1e6},
       0,
       "0 kN",
       "axial load on the inner ring; zero: the ring keeps its axial place"},
      {"tilt", &T::tilt, "mrad", {-20, 20}, 0, "0 mrad", "of the inner ring in the plane of the load"},
      {"loads",
       &T::loads,
       "kN",
       {0.001, 1e6},
       absent,
       "[\"100 kN\", \"4000 kN\"]",
       "swept range of the radial load; when absent a tenth to four times radial"},
      {"samples", &T::samples, "count", {2, 200}, 20, "20", "loads in the sweep, logarithmically spaced"},
      {"cage_angle",
       &T::cage_angle,
       "deg",
       {-360, 360},
       0,
       "0 deg",
       "turns the rollers from the line of the load"},
      {"axial_displacement",
       &T::axial_displacement,
       "um",
       {-1e4, 1e4},
       absent,
       "20 um",
       "of the inner ring, imposed in place of an axial load"},
      {"moment",
       &T::moment,
       "kN m",
       {-1e4, 1e4},
       absent,
       "20 kN m",
       "on the inner ring in the plane of the load, in place of a tilt"},
      {"speed",
       &T::speed,
       "rpm",
       {0, 1e5},
       absent,
       "300 rpm",
       "of the shaft: an oil film carries no load at rest; of rollers the centrifugal forces and the hours of "
       "life"},
      {"tilt_across",
       &T::tilt_across,
       "mrad",
       {-20, 20},
       0,
       "0 mrad",
       "oil film: of the sleeve across the plane of the load"},
      {"speeds",
       &T::speeds,
       "rpm",
       {1e-3, 1e5},
       absent,
       "[\"10 rpm\", \"200 rpm\"]",
       "oil film: swept range of the speed; when absent a quarter to four times speed"},
  };
  return rows;
}

const std::vector<Field<BearingModelInput>> &bearing_model_rows()
{
  using T = BearingModelInput;
  static const std::vector<Field<T>> rows{
      {"roller_law", &T::roller_law, "choice", any, absent, "fe", "as in [bearing.*], for the loaded bearing"},
      {"rings", &T::rings, "choice", any, absent, "elastic", "as in [bearing.*]"},
      {"slices", &T::slices, "count", {1, 1001}, absent, "41", "as in [bearing.*]"},
  };
  return rows;
}

const std::vector<Field<BearingExcitation>> &bearing_motion_rows()
{
  using T = BearingExcitation;
  static const std::vector<Field<T>> rows{
      {"mass",
       &T::mass,
       "kg",
       {1e-3, 1e7},
       absent,
       "900 kg",
       "carried by the bearing; without it no motion is computed"},
      {"damping",
       &T::damping,
       "N s/m",
       {0, 1e9},
       0,
       "1.0e5 N s/m",
       "in parallel with the bearing, both directions"},
      {"amplitude", &T::amplitude, "kN", {0, 1e6}, 0, "100 kN", "of the harmonic force on top of the load"},
      {"frequency", &T::frequency, "Hz", {0.01, 1e5}, 100, "100 Hz", "of that force"},
      {"direction", &T::direction, "deg", {-360, 360}, 0, "0 deg", "of that force from the line of the load"},
      {"duration", &T::duration, "s", {1e-4, 100}, 0.5, "0.5 s", "of the record"},
      {"output_rate", &T::output_rate, "kHz", {0.01, 1000}, 20, "20 kHz", "of the record"},
  };
  return rows;
}
}  // namespace mill
