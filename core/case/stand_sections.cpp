#include "core/case/stand_sections.h"
#include <fmt/format.h>

namespace mill {
using Repeat = SectionRows::Repeat;

namespace {
// Published values of the 1400 mm four-high stand, doi 10.21203/rs.3.rs-1441429/v1, are the examples of [given].
Row stiffness_beside(const std::string &key, const char *unit, const Range &range, const char *example,
                     const std::string &meaning)
{
  return {key, Kind::quantity, unit, range, absent, example, meaning};
}

void add_roller_rows(std::vector<Row> &rows)
{
  const char *rollers[] = {"6.78395e5 N/mm", "6.37958e5 N/mm", "6.23286e5 N/mm", "6.47685e5 N/mm"};
  for (int i = 0; i < 4; ++i)
    rows.push_back(stiffness_beside(fmt::format("row{}_roller", i + 1), "N/mm", {1, 1e9}, rollers[i],
                                    fmt::format("stiffness of one roller in row {}", i + 1)));
}

std::vector<Row> chain_rows(const bool lumped)
{
  const char *masses[]       = {"9321.943 kg", "59716.884 kg", "1888.705 kg",
                                "3094.684 kg", "42200.563 kg", "4663.290 kg"};
  const char *springs[]      = {"6.3086e3 kN/mm",  "1.0233e4 kN/mm", "7.53399e5 kN/mm", "1.91141e5 kN/mm",
                                "6.58293e5 kN/mm", "2.9301e4 kN/mm", "6.8789e3 kN/mm"};
  const char *mass_text[]    = {"upper frame",     "upper backup roll", "upper work roll",
                                "lower work roll", "lower backup roll", "lower frame"};
  const char *spring_text[]  = {"ground to M1",
                                "M1 to M2",
                                "M2 to M3, contact of the upper rolls",
                                "M3 to M4, bite",
                                "M4 to M5, contact of the lower rolls",
                                "M5 to M6",
                                "M6 to ground"};
  const char *bearing_text[] = {"upper backup roll", "upper work roll", "lower work roll", "lower backup roll"};
  const Fallback chain       = lumped ? required : absent;
  std::vector<Row> rows;
  const auto number = [](const int i) { return std::to_string(i + 1); };
  for (int i = 0; i < 6; ++i)
    rows.push_back({"M" + number(i),
                    Kind::quantity,
                    "kg",
                    {0.001, 1e7},
                    chain,
                    masses[i],
                    std::string("equivalent mass, ") + mass_text[i]});
  for (int i = 0; i < 7; ++i)
    rows.push_back({"K" + number(i),
                    Kind::quantity,
                    "kN/mm",
                    {i == 3 ? 0 : 0.001, 1e9},
                    chain,
                    springs[i],
                    spring_text[i]});  // an open bite is a case of its own, any other open spring a torn stand
  for (int i = 0; i < 4; ++i)
    rows.push_back({"Kzc" + number(i),
                    Kind::quantity,
                    "kN/mm",
                    {0.001, 1e9},
                    absent,
                    "2.01e4 kN/mm",
                    std::string("radial stiffness of one bearing along its load, ") + bearing_text[i]});
  for (int i = 0; i < 4; ++i)
    rows.push_back(
        {"Kzc" + number(i) + "_across",
         Kind::quantity,
         "kN/mm",
         {0.001, 1e9},
         absent,
         "2.01e4 kN/mm",
         std::string("the same across its load, for the horizontal motion; when absent that along the load, ") +
             bearing_text[i]});
  rows.push_back(
      {"C", Kind::quantity, "N s/m", {0, 1e12}, absent, "1.91141e5 N s/m", "damper in parallel with K4"});
  if (!lumped) {
    rows.push_back({"K_Zy",
                    Kind::quantity,
                    "kN/mm",
                    {0.001, 1e9},
                    absent,
                    "1.0229e5 kN/mm",
                    "two backup-roll bearings together"});
    rows.push_back({"K_ZW",
                    Kind::quantity,
                    "kN/mm",
                    {0.001, 1e9},
                    absent,
                    "6.8123e4 kN/mm",
                    "bending and shear of a backup roll"});
  }
  return rows;
}

}  // namespace

std::vector<Row> bite_published_rows()
{
  return {stiffness_beside("K4", "kN/mm", {0.001, 1e9}, "1.91141e5 kN/mm", "stiffness between the work rolls")};
}

std::vector<Row> bearing_published_rows()
{
  std::vector<Row> rows{
      stiffness_beside("Kzc", "kN/mm", {0.001, 1e9}, "2.01e4 kN/mm", "radial stiffness of the bearing")};
  add_roller_rows(rows);
  return rows;
}

std::vector<Row> stand_given_rows()
{
  return chain_rows(false);
}

std::vector<Row> lumped_given_rows()
{
  return chain_rows(true);
}

std::vector<Row> stand_published_rows()
{
  auto rows = chain_rows(false);
  add_roller_rows(rows);
  return rows;
}

std::vector<Row> with_tolerances(std::vector<Row> rows)
{
  const auto tolerances = tolerance_rows(rows);
  rows.insert(rows.end(), tolerances.begin(), tolerances.end());
  return rows;
}

SectionRows head_section()
{
  return {"", Repeat::once, true, "what the file is", rows_of(head_rows())};
}

SectionRows steel_section()
{
  return {"steel", Repeat::once, false, "material of every solid", rows_of(steel_rows())};
}

std::vector<SectionRows> strip_sections()
{
  return {{"strip", Repeat::once, true, "the strip in the bite", rows_of(strip_rows())},
          {"strip.flow_stress", Repeat::once, true, "plane-strain flow stress of the strip",
           rows_of(flow_stress_rows())},
          {"strip.friction", Repeat::once, false, "friction between roll and strip, if it is not a single number",
           rows_of(friction_rows())}};
}

SectionRows oil_film_section()
{
  return {"bearing",
          Repeat::named,
          false,
          "an oil-film bearing, of backup rolls: a sleeve that turns in a bush",
          rows_of(oil_film_rows()),
          "oil-film"};
}

SectionRows bite_section()
{
  return {"bite", Repeat::once, false, "how the roll bite is computed", rows_of(bite_rows())};
}

SectionRows pass_section(const bool needed)
{
  return {"pass", Repeat::list, needed, "one pass: its rolling force and what is known of it",
          rows_of(pass_rows())};
}

SectionRows dynamics_section(const std::vector<Field<DynamicsSettings>> &rows)
{
  return {"dynamics", Repeat::once, false, "runs of the lumped model", rows_of(rows)};
}

SectionRows frequency_response_section()
{
  return {"frequency_response", Repeat::once, false, "acceleration of rolls and chocks per force on them",
          rows_of(frequency_response_rows())};
}

SectionRows campbell_section(const std::vector<Field<CampbellSettings>> &rows)
{
  return {"campbell", Repeat::once, false, "modes over the rolling speed with the orders of what turns",
          rows_of(rows)};
}

SectionRows drive_order_section()
{
  return {"drive.order", Repeat::list, false, "an order of the drive in the Campbell diagram",
          rows_of(drive_order_rows())};
}

TemplateNote drive_order_note()
{
  return {"drive.order", "", {}, {}, true};
}

SectionRows given_section(const std::vector<Row> &rows, const bool needed)
{
  return {"given", Repeat::once, needed,
          "values that replace computed ones, each a quantity or { value, source, ... }; "
          "KEY_tolerance states the uncertainty of a value",
          with_tolerances(rows)};
}

SectionRows published_section(const std::vector<Row> &rows)
{
  return {"published", Repeat::once, false,
          "published or measured values for comparison with the computed ones; they replace nothing", rows};
}
}  // namespace mill
