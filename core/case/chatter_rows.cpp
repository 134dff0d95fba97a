#include "core/case/stand_rows.h"

// The stand around the bite, its oil, what rolls in it, and how stability is searched.  Columns as in
// stand_rows.cpp.
namespace mill {
namespace {

template <class T> void add_span_rows(std::vector<Field<T>> &rows, const Fallback &fallback)
{
  rows.push_back({"entry_distance",
                  &T::entry_distance,
                  "m",
                  {0.1, 100},
                  fallback,
                  "4.95 m",
                  "free strip to the stand before"});
  rows.push_back(
      {"exit_distance", &T::exit_distance, "m", {0.1, 100}, fallback, "4.95 m", "free strip to the stand behind"});
}
}  // namespace

const std::vector<Field<Material>> &chatter_steel_rows()
{
  static const std::vector<Field<Material>> rows = [] {
    std::vector<Field<Material>> all = steel_rows();
    for (Field<Material> &row : all)
      if (std::string(row.key) == "poisson_ratio") {
        row.fallback = 0.3;  // of the published passes
        row.example  = "0.3";
      }
    return all;
  }();
  return rows;
}

const std::vector<Field<StripInput>> &chatter_strip_rows()
{
  static const std::vector<Field<StripInput>> rows = [] {
    std::vector<Field<StripInput>> some;
    for (const Field<StripInput> &row : strip_rows())
      for (const char *key : {"initial_thickness", "youngs_modulus", "friction"})
        if (std::string(row.key) == key)
          some.push_back(row);
    for (Field<StripInput> &row : some) {
      const std::string key = row.key;
      if (key == "initial_thickness")
        row.example = "3.00 mm";
      if (key == "youngs_modulus")
        row.meaning = "of the strip between the stands";
      if (key == "friction") {
        row.fallback = absent;
        row.meaning  = "Coulomb friction without [oil]; or a section [strip.friction]";
      }
    }
    return some;
  }();
  return rows;
}

const std::vector<Field<OilInput>> &oil_rows()
{
  using T                                 = OilInput;
  static const std::vector<Field<T>> rows = [] {
    std::vector<Field<T>> all;
    const auto add = [&](const char *key, Member<T> member, const char *form, Range range, Fallback fallback,
                         const char *example, const char *meaning) {
      all.push_back({key, member, form, range, fallback, example, meaning});
    };
    add("viscosity", &T::viscosity, "Pa s", {1e-5, 100}, required, "0.005 Pa s",
        "at the temperature of the bite's inlet");
    add("pressure_viscosity", &T::pressure_viscosity, "1/Pa", {1e-12, 1e-6}, required, "2e-8 1/Pa",
        "exponent of the viscosity over pressure");
    add("film_factor", &T::film_factor, "1", {0.01, 100}, 3, "3",
        "factor of the inlet film; 3 in the source of the friction law, 3/2 by Wilson and Walowit");
    add("film_range", &T::film_range, "um", {0, 1000}, absent, R"(["0.05 um", "1.5 um"])",
        "films over which the friction was measured; outside it is warned of");
    return all;
  }();
  return rows;
}

const std::vector<Field<OilInput>> &oil_friction_rows()
{
  using T                                 = OilInput;
  static const std::vector<Field<T>> rows = [] {
    std::vector<Field<T>> all;
    const auto add = [&](const char *key, Member<T> member, const char *form, Range range, const char *example,
                         const char *meaning) {
      all.push_back({key, member, form, range, required, example, meaning});
    };
    add("mu0", &T::mu0, "1", {0, 1}, "0.012", "mu = mu0 + mu1 exp(-decay film thickness)");
    add("mu1", &T::mu1, "1", {0, 1}, "0.142", "part of the dry friction that a film removes");
    add("decay", &T::decay, "1/um", {0, 1000}, "2.43 1/um", "how fast friction falls with the film");
    return all;
  }();
  return rows;
}

const std::vector<Field<ChatterStand>> &chatter_stand_rows()
{
  using T                                 = ChatterStand;
  static const std::vector<Field<T>> rows = [] {
    std::vector<Field<T>> all;
    const auto add = [&](const char *key, Member<T> member, const char *form, Range range, const char *example,
                         const char *meaning) {
      all.push_back({key, member, form, range, absent, example, meaning});
    };
    add("masses", &T::masses, "t", {1e-3, 1e5}, R"(["119 t", "75 t", "9.2 t", "9.2 t", "75 t", "36.5 t"])",
        "upper housing, upper backup roll, upper work roll, lower work roll, lower backup roll, lower housing");
    add("stiffnesses", &T::stiffnesses, "N/m", {1e3, 1e15},
        R"(["6.9e10 N/m", "3.0e10 N/m", "6.06e10 N/m", "6.06e10 N/m", "4.4e10 N/m", "10.1e10 N/m"])",
        "k0 ground to upper housing, k1 to upper backup roll, k2 to upper work roll, k4 lower work roll to lower "
        "backup roll, k5 to lower housing, k6 to the ground");
    add("dampings", &T::dampings, "N s/m", {0, 1e13},
        R"(["6.05e5 N s/m", "4.25e5 N s/m", "6.05e5 N s/m", "6.05e5 N s/m", "4.25e5 N s/m", "6.05e5 N s/m"])",
        "c0 upper housing to backup roll, c1 upper housing to work roll, c2 upper rolls, c3 lower rolls, c4 lower "
        "work roll to housing, c5 lower backup roll to housing; with 'from' the modal damping of the model when "
        "absent");
    all.push_back({"from", &T::from, "path", any, absent, "out/four-high-1400/lumped_model.toml",
                   "a lumped model (kind = \"lumped\") instead of masses, stiffnesses and dampings"});
    add_span_rows(all, absent);
    return all;
  }();
  return rows;
}

const std::vector<Field<StandSpan>> &stand_span_rows()
{
  static const std::vector<Field<StandSpan>> rows = [] {
    std::vector<Field<StandSpan>> all;
    add_span_rows(all, absent);
    return all;
  }();
  return rows;
}

const std::vector<Field<RollingCondition>> &condition_rows()
{
  using T                                 = RollingCondition;
  static const std::vector<Field<T>> rows = [] {
    std::vector<Field<T>> all;
    const auto add = [&](const char *key, Member<T> member, const char *form, Range range, Fallback fallback,
                         const char *example, const char *meaning) {
      all.push_back({key, member, form, range, fallback, example, meaning});
    };
    add("name", &T::name, "text", any, required, "2", "names the results and files of this condition");
    add("entry_thickness", &T::entry_thickness, "mm", {0.01, 1000}, required, "0.789 mm", "before the bite");
    add("exit_thickness", &T::exit_thickness, "mm", {0.005, 1000}, required, "0.577 mm", "behind the bite");
    add("entry_tension", &T::entry_tension, "MPa", {0, 2000}, required, "180 MPa", "back tension");
    add("exit_tension", &T::exit_tension, "MPa", {0, 2000}, required, "189 MPa", "front tension");
    add("width", &T::width, "mm", {10, 6000}, required, "1206 mm", "width of the strip");
    add("speed", &T::speed, "m/s", {0.01, 100}, required, "18.2 m/s",
        "working speed of the rolls' surface, of the bite's results and of the distance to chatter");
    add("after", &T::after, "text", any, absent, "1",
        "name of the condition of the stand before this one, for a tandem with the delay of the strip");
    add("published_critical_speed", &T::published_critical_speed, "m/s", {0, 200}, absent, "18.2 m/s",
        "of a published model, for comparison with the computed one");
    add("published_force", &T::published_force, "kN", {0, 1e6}, absent, "8751 kN",
        "of a published model, for comparison with the computed one");
    add("published_friction", &T::published_friction, "1", {0, 1}, absent, "0.0283",
        "of a published model, for comparison with the computed one");
    add("measured_critical_speed", &T::measured_critical_speed, "m/s", {0, 200}, absent, "18.17 m/s",
        "of a mill, for comparison with the computed one");
    add("measured_force", &T::measured_force, "kN", {0, 1e6}, absent, "9002 kN",
        "of a mill, for comparison with the computed one");
    add("note", &T::note, "text", any, absent, "fitted on this condition",
        "note on the published values: which of them were used to fit inputs and therefore verify nothing");
    return all;
  }();
  return rows;
}

const std::vector<Field<ChatterAnalysis>> &chatter_analysis_rows()
{
  using T                                 = ChatterAnalysis;
  static const std::vector<Field<T>> rows = [] {
    std::vector<Field<T>> all;
    const auto add = [&](const char *key, Member<T> member, const char *form, Range range, Fallback fallback,
                         const char *example, const char *meaning) {
      all.push_back({key, member, form, range, fallback, example, meaning});
    };
    add("linearisation", &T::linearisation, "choice", any, Linearisation::sequential, "sequential",
        "what follows a disturbance: all but the strip speeds inside the film law, as published; everything; all "
        "but friction");
    add("speeds", &T::speeds, "m/s", {0.01, 200}, absent, R"(["5 m/s", "30 m/s"])",
        "range of roll speeds searched; 1 .. 30 m/s when absent");
    add("map_points", &T::map_points, "count", {0, 400}, 60, "60",
        "points along each side of the stability maps; 0: none");
    add("disturbance", &T::disturbance, "um", {1e-6, 1000}, 0.1, "0.1 um",
        "start of the histories: each work roll lifted off the strip by so much");
    add("duration", &T::duration, "s", {0.01, 60}, 0.6, "0.6 s", "of the histories");
    return all;
  }();
  return rows;
}
}  // namespace mill
