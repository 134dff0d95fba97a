#include "core/case/stand_rows.h"

// What is rolled, by which friction, and how the bite is computed.  Columns as in stand_rows.cpp.
namespace mill {
namespace {
// "coulomb | factor"
template <class Law> std::string names_of(const std::vector<Law> &laws)
{
  std::string names;
  for (const Law law : laws)
    names += (names.empty() ? "" : " | ") + name_of(law);
  return names;
}
}  // namespace

const std::vector<Field<StripInput>> &strip_rows()
{
  using T = StripInput;
  static const std::vector<Field<T>> rows{
      {"width", &T::width, "mm", {10, 6000}, required, "1000 mm", "width of the strip"},
      {"entry_thickness", &T::entry_thickness, "mm", {0.01, 1000}, required, "8 mm", "before the bite"},
      {"exit_thickness",
       &T::exit_thickness,
       "mm",
       {0.005, 1000},
       required,
       "5 mm",
       "behind the bite; with bite.arc = \"elastic\" the smallest thickness under load"},
      {"entry_tension", &T::entry_tension, "MPa", {0, 2000}, 0, "0 MPa", "back tension"},
      {"exit_tension", &T::exit_tension, "MPa", {0, 2000}, 0, "0 MPa", "front tension"},
      {"initial_thickness",
       &T::initial_thickness,
       "mm",
       {0.01, 1000},
       absent,
       "8 mm",
       "thickness of zero strain; the entry thickness when absent"},
      {"youngs_modulus",
       &T::youngs_modulus,
       "GPa",
       {1, 1000},
       210,
       "210 GPa",
       "of the strip, for its elastic zones before and behind the bite"},
      {"poisson_ratio", &T::poisson_ratio, "1", {0, 0.49}, 0.3, "0.3", "of the strip"},
      {"friction",
       &T::coulomb,
       "1",
       {0, 1},
       required,
       "0.2",
       "Coulomb friction between roll and strip, or a section [strip.friction]"},
  };
  return rows;
}

const std::vector<Field<FlowStressInput>> &flow_stress_rows()
{
  using T                                 = FlowStressInput;
  static const std::string names          = names_of(flow_stress_laws());
  static const std::vector<Field<T>> rows = [] {
    std::vector<Field<T>> all{
        {"law", &T::name, names.c_str(), any, required, "constant", "law of the plane-strain flow stress"}};
    for (const FlowStressConstant &c : flow_stress_constants())
      all.push_back(
          {c.key, static_cast<double T::*>(c.member), c.unit, {c.range[0], c.range[1]}, 0, c.example, c.meaning});
    all.push_back({"table",
                   &T::table,
                   "1, MPa",
                   {0.001, 10000},
                   absent,
                   R"([[0.0, "28 MPa"], [1.0, "28 MPa"]])",
                   "strain and stress, law table"});
    return all;
  }();
  return rows;
}

const std::vector<Field<FrictionInput>> &friction_rows()
{
  using T                                 = FrictionInput;
  static const std::string names          = names_of(friction_laws());
  static const std::vector<Field<T>> rows = [] {
    std::vector<Field<T>> all{{"law", &T::name, names.c_str(), any, required, "film", friction_laws_in_words}};
    for (const FrictionConstant &c : friction_constants())
      all.push_back({c.key,
                     static_cast<double T::*>(c.member),
                     c.unit,
                     {c.range[0], c.range[1]},
                     c.fallback,
                     c.example,
                     c.meaning});
    return all;
  }();
  return rows;
}

const std::vector<Field<BiteSetup>> &bite_rows()
{
  using T = BiteSetup;
  static const std::vector<Field<T>> rows{
      {"method", &T::method, "choice", any, BiteMethod::fe, "fe",
       "source of K4: finite elements compared with slab theories, or a slab theory alone"},
      {"theory", &T::theory, "choice", any, SlabTheory::karman, "karman",
       "slab theory that is compared with the finite elements, or gives K4"},
      {"arc", &T::arc, "choice", any, BiteArc::automatic, "auto",
       "shape of the loaded roll: its own circle, a larger circle, or any; auto: any for an elastic-plastic "
       "strip"},
      {"strip", &T::strip, "choice", any, BiteStrip::automatic, "auto",
       "strip of the finite-element bite; auto: elastic-plastic for thin hard strip and light passes"},
      {"elements_along",
       &T::elements_along,
       "count",
       {8, 200},
       48,
       "48",
       "finite elements along the arc of contact; the elastic-plastic strip takes two thirds of them"},
      {"elements_through",
       &T::elements_through,
       "count",
       {2, 60},
       12,
       "12",
       "finite elements through half the thickness; the elastic-plastic strip takes half of them"},
      {"samples", &T::samples, "count", {3, 101}, 9, "9", "points of each curve of K4"},
      {"path_trim",
       &T::path_trim,
       "%",
       {0, 45},
       20,
       "20 %",
       "share of the contact path left out at each end for K4.path_plateau"},
      {"fit", &T::fit, "choice", any, absent, R"(["force", "slip"])",
       "measured values of the passes (load, forward_slip, torque) from which friction and flow stress are found; "
       "when absent they are those of [strip]"},
      {"fit_for", &T::fit_for,
       "friction | flow_stress | mu0 | mu1 | decay | viscosity | at_unit_speed | per_log_speed", any, absent,
       R"(["friction", "flow_stress"])",
       "what is found: a factor on the friction, on the flow stress, on constants of strip.friction; when absent "
       "the first two, with one kind of measured value the one that it determines best"},
  };
  return rows;
}

const std::vector<Field<BiteRollInput>> &bite_roll_rows()
{
  using T = BiteRollInput;
  static const std::vector<Field<T>> rows{
      {"diameter", &T::diameter, "mm", {10, 3000}, required, "420 mm", "of the barrel"},
  };
  return rows;
}

const std::vector<Field<PassInput>> &bite_pass_rows()
{
  static const std::vector<Field<PassInput>> rows = [] {
    std::vector<Field<PassInput>> some;
    for (const Field<PassInput> &row : pass_rows())
      for (const char *key :
           {"name", "load", "entry_thickness", "exit_thickness", "entry_tension", "exit_tension", "speed",
            "forward_slip", "torque", "force_deviation", "slip_deviation", "torque_deviation"})
        if (std::string(row.key) == key)
          some.push_back(row);
    for (Field<PassInput> &row : some)
      if (std::string(row.key) == "load")
        row.meaning = "measured or published force for comparison with the computed one";
    return some;
  }();
  return rows;
}
}  // namespace mill
