#include "core/case/cluster_rows.h"

// Rolls that lean on each other, what holds them, their passes.  Columns as in stand_rows.cpp.
namespace mill {
const std::vector<Field<StripInput>> &cluster_strip_rows()
{
  static const std::vector<Field<StripInput>> rows = [] {
    std::vector<Field<StripInput>> some;
    for (const Field<StripInput> &row : strip_rows())
      for (const char *key : {"width", "initial_thickness", "youngs_modulus", "poisson_ratio", "friction"})
        if (std::string(row.key) == key)
          some.push_back(row);
    for (Field<StripInput> &row : some) {
      const std::string key = row.key;
      if (key == "initial_thickness")
        row.meaning = "thickness of zero strain; the entry thickness of the first pass when absent";
      if (key == "friction") {
        row.fallback = absent;
        row.meaning  = "Coulomb friction between roll and strip, or a section [strip.friction]; needed where the "
                       "force of a pass is to be computed";
      }
    }
    return some;
  }();
  return rows;
}

const std::vector<Field<ClusterSettings>> &cluster_stack_rows()
{
  using T = ClusterSettings;
  static const std::vector<Field<T>> rows{
      {"strip", &T::strip, "text", any, required, "W",
       "roll at the strip, which pushes it up; \"S-T\": the upper and the lower one, both halves of the mill"},
      {"strip_stiffness",
       &T::strip_stiffness,
       "kN/mm",
       {0, 1e9},
       absent,
       "1e4 kN/mm",
       "spring of the strip between those two rolls, K4; when absent that of the bite of the pass, or, without "
       "one, the "
       "rolling force is imposed"},
      {"gravity", &T::gravity, "flag", any, 1, "true", "weight of the rolls, along -y"},
      {"spin", &T::spin, "choice", any, ClusterSpin::free, "free",
       "coupled: friction in the contacts lets a vibration turn the rolls, by a tangential spring in each "
       "contact"},
      {"tangential_ratio",
       &T::tangential_ratio,
       "1",
       {0.01, 1},
       1,
       "1",
       "tangential over normal stiffness of a contact, spin = \"coupled\"; 1 for equal materials in line contact "
       "without slip"},
      {"flattening_modulus",
       &T::flattening_modulus,
       "GPa",
       {1, 1000},
       absent,
       "210 GPa",
       "Young's modulus of the roll at the strip in the formula of its flattening; that of the roll when absent"},
      {"flattening_poisson",
       &T::flattening_poisson,
       "1",
       {0, 0.49},
       absent,
       "0.3",
       "Poisson's ratio there; that of the roll when absent"},
  };
  return rows;
}

const std::vector<Field<ClusterRoll>> &cluster_roll_rows()
{
  using T = ClusterRoll;
  static const std::vector<Field<T>> rows{
      {"name", &T::name, "text", any, required, "W",
       "letters, digits, _, . and /; names its contacts and supports"},
      {"barrel_diameter",
       &T::barrel_diameter,
       "mm",
       {5, 2500},
       required,
       "69.6 mm",
       "ground diameter of the barrel"},
      {"barrel_length",
       &T::barrel_length,
       "mm",
       {10, 6000},
       required,
       "505 mm",
       "length of the barrel, and of its contacts"},
      {"mass",
       &T::mass,
       "kg",
       {1e-3, 1e6},
       absent,
       "15 kg",
       "of the roll with all that moves with it; that of the solid barrel when absent"},
      {"density", &T::density, "kg/m3", {1000, 20000}, absent, "7801 kg/m3", "that of [steel] when absent"},
      {"youngs_modulus", &T::youngs_modulus, "GPa", {1, 1000}, absent, "207 GPa", "that of [steel] when absent"},
      {"poisson_ratio", &T::poisson_ratio, "1", {0, 0.49}, absent, "0.29", "that of [steel] when absent"},
      {"position",
       &T::position,
       "mm",
       {-1e5, 1e5},
       absent,
       R"(["0 mm", "34.8 mm"])",
       "axis of the unloaded roll, x along the rolling direction and y up; when absent it is found from contacts "
       "with rolls that have their place: from one with its direction, from two without"},
      {"side", &T::side, "choice", any, PositionSide::below, "below",
       "side of the two rolls on which it lies, when its position follows from contacts"},
  };
  return rows;
}

const std::vector<Field<ClusterContact>> &cluster_contact_rows()
{
  using T = ClusterContact;
  static const std::vector<Field<T>> rows{
      {"pair", &T::pair, "text", any, required, "W-I", "names of the two rolls"},
      {"like", &T::like, "text", any, absent, "W-R",
       "pair of which this one is the mirror image about the vertical: law and direction are taken from there"},
      {"direction",
       &T::direction,
       "deg",
       {-180, 360},
       absent,
       "90 deg",
       "from the first axis to the second, from the rolling direction upwards; places a roll that has no "
       "position"},
      {"law", &T::law, "choice", any, ClusterLaw::johnson, "johnson",
       "johnson, foeppl: closed forms of the line contact of two cylinders; power: Palmgren's for rollers of "
       "bearings; computed: finite elements of this pair; spring: stiffness, exponent"},
      {"coefficient",
       &T::coefficient,
       "1",
       {1e-7, 1e-2},
       3.84e-5,
       "3.84e-5",
       "of the law power, in mm and N; 3.84e-5 is steel"},
      {"length",
       &T::length,
       "mm",
       {1, 6000},
       absent,
       "505 mm",
       "length of contact; the shorter barrel when absent"},
      {"stiffness",
       &T::stiffness,
       "N/m",
       {1, 1e14},
       absent,
       "1.5e10 N/m",
       "tangent of the law spring, at the load"},
      {"load",
       &T::load,
       "kN",
       {1e-3, 1e6},
       absent,
       "1148 kN",
       "where the stiffness of a law spring belongs that is curved"},
      {"exponent", &T::exponent, "1", {1, 3}, 1, "1", "of the force over the approach, law spring"},
      {"loss_factor",
       &T::loss_factor,
       "1",
       {0, 2},
       absent,
       "0.08",
       "of the material; that of [response] when absent"},
      {"damping",
       &T::damping,
       "N s/m",
       {0, 1e9},
       0,
       "0 N s/m",
       "viscous damping of impacts in a history; if a loss factor is given too, the larger of both is used"},
      {"damping_depth",
       &T::damping_depth,
       "um",
       {0, 1e4},
       0,
       "0 um",
       "approach at which that damping acts in full"},
  };
  return rows;
}

const std::vector<Field<ClusterSupport>> &cluster_support_rows()
{
  using T = ClusterSupport;
  static const std::vector<Field<T>> rows{
      {"roll", &T::roll, "text", any, required, "E", "roll that it holds from the ground"},
      {"name", &T::name, "text", any, absent, "saddle",
       "its name where a roll has several; that of the roll when absent"},
      {"like", &T::like, "text", any, absent, "R",
       "support of which this one is the mirror image about the vertical"},
      {"type", &T::type, "choice", any, SupportType::radial, "radial",
       "radial: force along the displacement; isotropic: the law upwards, its tangent sideways; guide: along one "
       "direction; rollers: two behind a roll, with preload"},
      {"stiffness",
       &T::stiffness,
       "N/m",
       {1, 1e14},
       absent,
       "1.08e10 N/m",
       "tangent at the load; of each roller at the preload"},
      {"load", &T::load, "kN", {1e-3, 1e6}, absent, "1148 kN", "where the stiffness of a bearing belongs"},
      {"exponent",
       &T::exponent,
       "1",
       {0.4, 1},
       0.9,
       "0.9",
       "q of displacement = constant force^q: 0.9 rollers, 0.667 balls, 1 a straight spring; a guide is straight"},
      {"direction",
       &T::direction,
       "deg",
       {-180, 360},
       0,
       "0 deg",
       "of a guide, from the rolling direction upwards"},
      {"half_angle",
       &T::half_angle,
       "deg",
       {0, 85},
       absent,
       "36 deg",
       "between the normal of the contact and either roller"},
      {"preload", &T::preload, "kN", {1e-4, 1e4}, absent, "4.5 kN", "of each roller, set under the rolling force"},
      {"against", &T::against, "text", any, absent, "W", "roll that the rollers press theirs against"},
      {"guard",
       &T::guard,
       "N/m",
       {1, 1e9},
       1e4,
       "1e4 N/m",
       "weak springs across and along that hold a roll out of contact"},
      {"loss_factor", &T::loss_factor, "1", {0, 2}, absent, "0.08", "that of [response] when absent"},
      {"fitted", &T::fitted, "flag", any, 0, "false",
       "the stiffness follows only from a fit to frequencies; the results state this"},
  };
  return rows;
}

const std::vector<Field<ClusterPass>> &cluster_pass_rows()
{
  using T = ClusterPass;
  static const std::vector<Field<T>> rows{
      {"name", &T::name, "text", any, required, "pass 1", "names its results"},
      {"load",
       &T::load,
       "kN",
       {1e-3, 1e6},
       absent,
       "1148 kN",
       "rolling force; computed from the strip when absent"},
      {"entry_thickness",
       &T::entry_thickness,
       "mm",
       {0.001, 1000},
       absent,
       "0.260 mm",
       "before the bite; needed where the force is computed"},
      {"exit_thickness", &T::exit_thickness, "mm", {0.001, 1000}, absent, "0.180 mm", "behind the bite"},
      {"entry_pull",
       &T::entry_pull,
       "kN",
       {0, 1e5},
       absent,
       "38 kN",
       "whole tension force of the strip before the bite"},
      {"exit_pull", &T::exit_pull, "kN", {0, 1e5}, absent, "35 kN", "behind the bite"},
      {"entry_tension",
       &T::entry_tension,
       "MPa",
       {0, 2000},
       absent,
       "289 MPa",
       "stress of the strip before the bite, in place of entry_pull"},
      {"exit_tension", &T::exit_tension, "MPa", {0, 2000}, absent, "385 MPa", "behind the bite"},
      {"speed", &T::speed, "m/s", {0.001, 100}, absent, "178 m/min", "of the rolls' surface"},
      {"horizontal_force",
       &T::horizontal_force,
       "kN",
       {-1e5, 1e5},
       0,
       "0 kN",
       "on the roll at the strip, along the rolling direction"},
      {"dynamic_force",
       &T::dynamic_force,
       "kN",
       {0, 1e5},
       absent,
       "0.4 kN",
       "amplitude of a harmonic part of the rolling force"},
      {"dynamic_frequency", &T::dynamic_frequency, "Hz", {0.1, 1e6}, absent, "610 Hz", "of that part"},
      {"loss_factor",
       &T::loss_factor,
       "1",
       {0, 2},
       absent,
       "0.08",
       "of the contacts in this pass; that of [response] when absent"},
      {"measured_force",
       &T::measured_force,
       "kN",
       {0, 1e6},
       absent,
       R"(["1150 kN", "1200 kN"])",
       "range of the measured force, only shown next to the computed one"},
      {"published_force",
       &T::published_force,
       "kN",
       {0, 1e6},
       absent,
       "1148 kN",
       "of a published model, only shown"},
      {"published_dynamic",
       &T::published_dynamic,
       "kN",
       {0, 1e5},
       absent,
       "0.40 kN",
       "dynamic part of the force of a published model, only shown"},
      {"common_fit", &T::common_fit, "flag", any, 1, "true",
       "is used for the hardening law and the constant of the dynamic force that all passes have in common; "
       "false: a blind test of them"},
  };
  return rows;
}

const std::vector<Field<ClusterResponse>> &cluster_response_rows()
{
  using T = ClusterResponse;
  static const std::vector<Field<T>> rows{
      {"loss_factor", &T::loss_factor, "1", {0, 2}, 0, "0.08", "of all contacts"},
      {"support_loss_factor", &T::support_loss_factor, "1", {0, 2}, 0, "0", "of all supports"},
      {"frequencies",
       &T::frequencies,
       "Hz",
       {0.1, 1e6},
       absent,
       R"(["50 Hz", "12000 Hz"])",
       "range of the response; from 50 Hz to beyond the highest mode when absent"},
      {"points",
       &T::points,
       "count",
       {10, 100000},
       600,
       "600",
       "number of frequencies in that range; the frequencies of the modes are added"},
      {"duration", &T::duration, "s", {1e-5, 100}, 0.02, "0.02 s", "of a history under the dynamic force"},
      {"force_factor", &T::force_factor, "1", {0, 1e6}, 1, "1", "on the dynamic force in a history"},
      {"depth_share",
       &T::depth_share,
       "1",
       {0, 1},
       0.2,
       "0.2",
       "approach at which the damping of a history acts in full, over the approach at rest"},
  };
  return rows;
}

const std::vector<Field<ClusterMode>> &cluster_mode_rows()
{
  using T = ClusterMode;
  static const std::vector<Field<T>> rows{
      {"name", &T::name, "text", any, required, "E vertical", "of the motion"},
      {"shape", &T::shape, "text", any, required, "E y, I y, W y",
       "rolls, directions and weights of the motion, by which the mode is recognised: \"W y, I y 0.8, L x -1\""},
      {"frequency",
       &T::frequency,
       "Hz",
       {0.1, 1e6},
       absent,
       "621 Hz",
       "published or measured, for comparison with the computed one; a variant is fitted to it"},
  };
  return rows;
}

const std::vector<Field<ClusterVariant>> &cluster_variant_rows()
{
  using T = ClusterVariant;
  static const std::vector<Field<T>> rows{
      {"name", &T::name, "text", any, required, "C", "names its results"},
      {"set", &T::set, "text", any, absent, R"(["contact.W-R.law = spring"])",
       "keys that differ from the case: contact.PAIR.KEY, support.NAME.KEY, roll.NAME.KEY, stack.KEY"},
      {"unknowns", &T::unknowns, "text", any, absent, R"(["support.E.stiffness"])",
       "numbers that are fitted; their start is the value of the case, or that of set"},
      {"modes", &T::modes, "text", any, absent, R"(["E vertical"])",
       "names of [[mode]] whose frequencies they are fitted to; all with a frequency when absent"},
      {"pass", &T::pass, "text", any, absent, "pass 1",
       "at which the frequencies are compared; the first when absent"},
  };
  return rows;
}
}  // namespace mill
