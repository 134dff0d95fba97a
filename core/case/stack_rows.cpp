#include "core/case/stack_rows.h"
#include <algorithm>

// Rolls that bend and flatten, their shafts and saddles, the strip between them.  Columns as in stand_rows.cpp.
namespace mill {
namespace {
constexpr Range place_on_roll{-6000, 6000};  // mm

// The keys of a barrel's profile are those of the backup roll of a four-high stand.
void add_stack_profile_rows(std::vector<Field<StackRollInput>> &rows)
{
  for (const Field<Roll> &row : backup_roll_rows())
    for (const char *key : {"crown", "crown_table", "crown_polynomial", "thermal_crown", "thermal_crown_table",
                            "end_chamfer_length", "end_chamfer_depth"})
      if (std::string(row.key) == key) {
        const auto member = std::visit([](auto of_roll) -> Member<StackRollInput> { return of_roll; }, row.member);
        rows.push_back({row.key, member, row.form, row.range, row.fallback, row.example, row.meaning});
      }
}
}  // namespace

const std::vector<Field<StackSettings>> &stack_settings_rows()
{
  using T = StackSettings;
  static const std::vector<Field<T>> rows{
      {"lower", &T::lower, "choice", any, LowerHalf::turned, "turned",
       "lower half: mirrored about the pass line; turned: also end for end, with the opposite shift and profile; "
       "listed: its rolls are listed too, after those of the upper half. The rolls that are made are called "
       "lower_NAME"},
      {"bending_at", &T::bending_at, "choice", any, BendingAt::chock, "chock",
       "place of the bending forces: chock: it moves with the shifted roll; window: it stays in the window"},
  };
  return rows;
}

const std::vector<Field<StackRollInput>> &stack_roll_rows()
{
  using T                                 = StackRollInput;
  static const std::vector<Field<T>> rows = [] {
    std::vector<Field<T>> all{
        {"name", &T::name, "text", any, required, "W", "letters, digits and _; names its contacts and results"},
        {"barrel_diameter",
         &T::barrel_diameter,
         "mm",
         {5, 2500},
         required,
         "420 mm",
         "ground diameter of the barrel, or of the rings of a backing shaft"},
        {"barrel_length", &T::barrel_length, "mm", {10, 6000}, required, "1400 mm", "length of the barrel"},
        {"neck_diameter",
         &T::neck_diameter,
         "mm",
         {1, 2500},
         absent,
         "266.7 mm",
         "of both necks, with total_length; without necks and sections the roll is its barrel"},
        {"total_length", &T::total_length, "mm", {10, 12000}, absent, "2320 mm", "of the roll with its necks"},
        {"sections",
         &T::shaft,
         "mm",
         {1, 2500},
         absent,
         R"([["-1160 mm", "-700 mm", "266.7 mm"], ["-700 mm", "700 mm", "420 mm"], ["700 mm", "1160 mm", "266.7 mm"]])",
         "from, to and diameter of each piece of a stepped roll, in place of neck_diameter and total_length"},
        {"bearing_span",
         &T::bearing_span,
         "mm",
         {10, 12000},
         absent,
         "2000 mm",
         "between the middles of both bearings, where bearings and chocks act"},
        {"on", &T::on, "text", any, absent, R"(["B"])",
         "rolls that it leans on, away from the strip: one or two; absent: it leans on none and its bearings or "
         "saddles hold it"},
        {"position",
         &T::position,
         "mm",
         {-10000, 10000},
         absent,
         R"(["-411 mm", "185 mm"])",
         "x and y of the axis of a roll that leans on none, in a stack in which a roll leans on two; elsewhere "
         "it follows from the pass line"},
        {"shift",
         &T::axial_shift,
         "mm",
         {-2000, 2000},
         0,
         "0 mm",
         "of the roll with its chocks, positive to the drive side"},
        {"bending_force",
         &T::bending_force,
         "kN",
         {-20000, 20000},
         absent,
         R"(["0 kN", "0 kN"])",
         "of each chock, drive and operator side; positive pushes the chock away from the strip. A made roll has "
         "that of its original on the same side of the mill"},
        {"bearing_stiffness",
         &T::bearing_stiffness,
         "kN/mm",
         {1, 1e7},
         absent,
         R"(["2070 kN/mm", "3030 kN/mm"])",
         "of bearing, chock and housing of one side, from the axis to the ground; two: of the roll and of the "
         "roll that is made of it; absent: rigid"},
        {"bearing", &T::bearing, "text", any, absent, "crb",
         "name of a [bearing.NAME] on either side, whose stiffness under its load replaces bearing_stiffness"},
        {"housing_stiffness",
         &T::housing_stiffness,
         "kN/mm",
         {1, 1e7},
         absent,
         R"(["2500 kN/mm"])",
         "of what carries the bearing on one side, from its outer ring to the ground, with the chock unless the "
         "bearing is solved in its chock; two: of the roll and of the roll that is made of it; absent: rigid"},
        {"chock_mass",
         &T::chock_mass,
         "kg",
         {0, 5e5},
         absent,
         R"(["970 kg"])",
         "of each chock, for the vibration; two: of the roll and of the roll that is made of it; absent: none"},
        {"material", &T::material, "text", any, absent, "carbide", "name of a [material.NAME]; absent: [steel]"},
    };
    add_stack_profile_rows(all);
    return all;
  }();
  return rows;
}

const std::vector<Field<StackSaddles>> &stack_saddle_rows()
{
  using T = StackSaddles;
  static const std::vector<Field<T>> rows{
      {"shaft_diameter",
       &T::shaft_diameter,
       "mm",
       {1, 2500},
       required,
       "130 mm",
       "of the shaft that bends, as long as the barrel"},
      {"positions", &T::positions, "mm", place_on_roll, required, R"(["-630 mm", "0 mm", "630 mm"])",
       "middle of each saddle"},
      {"stiffness",
       &T::stiffness,
       "kN/mm",
       {1, 1e7},
       required,
       R"(["2000 kN/mm"])",
       "from the axis to the ground, along x and y alike; one for all or one of each saddle"},
      {"eccentric",
       &T::eccentric,
       "mm",
       {-50, 50},
       absent,
       R"(["0 mm", "0.15 mm", "0 mm"])",
       "motion of each saddle towards the strip, along y; the roll that is made of it has none"},
      {"rings", &T::rings, "mm, mm", place_on_roll, absent, R"([["-615 mm", "-15 mm"], ["15 mm", "615 mm"]])",
       "from and to of each ring, where the roll touches; absent: the barrel"},
      {"ring_stiffness",
       &T::ring_stiffness,
       "MPa",
       {1, 1e9},
       absent,
       "3e5 MPa",
       "of the rings' own bearings per length; absent: rigid"},
  };
  return rows;
}

const std::vector<Field<StackStripInput>> &stack_strip_rows()
{
  using T = StackStripInput;
  static const std::vector<Field<T>> rows{
      {"width", &T::width, "mm", {1, 6000}, required, "1000 mm", "of the strip"},
      {"offset", &T::offset, "mm", {-3000, 3000}, 0, "0 mm", "of its middle, positive to the drive side"},
      {"force",
       &T::given_force,
       "kN",
       {1e-3, 1e6},
       absent,
       "976.2 kN",
       "rolling force; either force or gap is given"},
      {"gap",
       &T::gap,
       "mm",
       {-50, 2000},
       absent,
       "4.5 mm",
       "gap between the unloaded work rolls; the force then follows from exit_thickness"},
      {"law", &T::law, "choice", any, StackStripLaw::modulus, "modulus",
       "line load of the strip: uniform across the width; with the slopes modulus and entry_modulus; or with the "
       "slopes of its bite, which then replace modulus, entry_modulus and tension_modulus"},
      {"modulus",
       &T::modulus,
       "MPa",
       {0, 1e7},
       absent,
       "300 MPa",
       "-d(line load)/d(exit thickness) of the bite, law = \"modulus\""},
      {"entry_modulus",
       &T::entry_modulus,
       "MPa",
       {0, 1e7},
       absent,
       "300 MPa",
       "d(line load)/d(entry thickness); modulus when absent"},
      {"tension_modulus",
       &T::tension_modulus,
       "MPa",
       {0, 1e8},
       0,
       "2e5 MPa",
       "feedback of the tension: fall of the line load with the tension times Young's modulus over the exit "
       "thickness"},
      {"contact_length",
       &T::arc,
       "mm",
       {0.01, 1000},
       absent,
       "25 mm",
       "length of the arc; when absent sqrt(R' draft) with Hitchcock's radius R'"},
      {"entry_thickness", &T::entry_thickness, "mm", {1e-3, 1000}, absent, "8 mm", "mean over the width"},
      {"exit_thickness", &T::exit_thickness, "mm", {1e-3, 1000}, absent, "5 mm", "mean over the width"},
      {"entry_profile",
       &T::entry_profile,
       "mm, um",
       {-5000, 5000},
       absent,
       R"([["-500 mm", "-20 um"], ["0 mm", "0 um"], ["500 mm", "-20 um"]])",
       "place from the middle of the strip and thickness at entry; its mean is taken off"},
      {"crown_at",
       &T::crown_at,
       "mm",
       {0.1, 1000},
       25,
       "25 mm",
       "distance from the edge where crown and wedge are read"},
      {"edge_drop",
       &T::edge_drop,
       "mm",
       {0.1, 1000},
       absent,
       R"(["100 mm", "25 mm"])",
       "distances from the edge between which the edge drop is read; 100 mm and 25 mm when absent"},
      {"entry_tension", &T::entry_tension, "MPa", {0, 2000}, 0, "100 MPa", "back tension of the bite"},
      {"exit_tension", &T::exit_tension, "MPa", {0, 2000}, 0, "120 MPa", "front tension of the bite"},
      {"initial_thickness",
       &T::initial_thickness,
       "mm",
       {0.01, 1000},
       absent,
       "8 mm",
       "thickness of zero strain of the bite; the entry thickness when absent"},
      {"youngs_modulus", &T::youngs_modulus, "GPa", {1, 1000}, 210, "210 GPa", "of the strip"},
      {"poisson_ratio", &T::poisson_ratio, "1", {0, 0.49}, 0.3, "0.3", "of the strip"},
      {"friction",
       &T::coulomb,
       "1",
       {0, 1},
       absent,
       "0.05",
       "Coulomb friction in the bite, or a section [strip.friction]; needed for law = \"bite\" and for chatter"},
  };
  return rows;
}

// What belongs to a chain of a four-high stand is left out.
const std::vector<Field<DynamicsSettings>> &stack_dynamics_rows()
{
  static const std::vector<Field<DynamicsSettings>> rows = [] {
    std::vector<Field<DynamicsSettings>> some;
    for (const Field<DynamicsSettings> &row : dynamics_rows())
      for (const char *key : {"modal_damping", "force_meaning", "output_rate", "frequency_limit", "model_files"})
        if (std::string(row.key) == key)
          some.push_back(row);
    for (Field<DynamicsSettings> &row : some)
      if (std::string(row.key) == "force_meaning") {
        row.form = "measured | disturbance";
        row.meaning =
            "measured: total bite force, the stack without its strip; disturbance: the strip between the "
            "work rolls as a spring";
      }
    return some;
  }();
  return rows;
}

const std::vector<Field<StackEngine>> &stack_engine_rows()
{
  using T = StackEngine;
  static const std::vector<Field<T>> rows{
      {"model", &T::model, "choice", any, StackModel::condensed, "condensed",
       "which of the two engines gives the results; the other is the check next to each of them. condensed: "
       "elastic "
       "solids of revolution whose contact lines feel each other; beams: Timoshenko beams"},
      {"flattening", &T::flattening, "choice", any, StackFlattening::half_space, "half-space",
       "of the beams at the strip: half-space: each place feels the load "
       "on its neighbours; local: only its own, which loses a quarter of the edge drop"},
  };
  return rows;
}

const std::vector<Field<StackWindow>> &stack_window_rows()
{
  using T = StackWindow;
  static const std::vector<Field<T>> rows{
      {"bent", &T::bent, "text", any, absent, "W", "roll whose bending forces vary over bending_force"},
      {"bending_force",
       &T::bending,
       "kN",
       {-20000, 20000},
       absent,
       R"(["-200 kN", "600 kN"])",
       "smallest and largest bending force of each chock; together with shift it gives the crown over both"},
      {"shifted", &T::shifted, "text", any, absent, "I", "roll whose shift varies over shift"},
      {"shift", &T::shift, "mm", {-2000, 2000}, absent, R"(["0 mm", "150 mm"])", "smallest and largest shift"},
      {"force",
       &T::force,
       "kN",
       {1e-3, 1e6},
       absent,
       R"(["600 kN", "1400 kN"])",
       "smallest and largest rolling force; together with width it gives the operating window"},
      {"width",
       &T::width,
       "mm",
       {1, 6000},
       absent,
       R"(["700 mm", "1300 mm"])",
       "smallest and largest width of the strip"},
      {"points", &T::points, "count", {2, 60}, 9, "9", "settings along each of two ranges"},
  };
  return rows;
}

const std::vector<Field<StackMaterial>> &stack_material_rows()
{
  static const std::vector<Field<StackMaterial>> rows = [] {
    std::vector<Field<StackMaterial>> all;
    for (const Field<Material> &row : steel_rows()) {
      const auto member = std::visit([](auto of_steel) -> Member<StackMaterial> { return of_steel; }, row.member);
      all.push_back({row.key, member, row.form, row.range, row.fallback, row.example, row.meaning});
      if (std::string(row.key) == "youngs_modulus") {
        all.back().fallback = required;
        all.back().example  = "600 GPa";
        all.back().meaning  = "Young's modulus";
      }
    }
    return all;
  }();
  return rows;
}
}  // namespace mill
