#include "core/case/estimates.h"
#include "core/base/units.h"
#include "core/case/provenance.h"
#include "core/case/stand_reader.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
const std::vector<Field<EstimateInput>> &estimate_rows()
{
  using T = EstimateInput;
  static const std::vector<Field<T>> rows{
      {"estimate", &T::estimate, "flag", any, 0, "true",
       "what is left out of this section is estimated by rules, marked in every result that depends on it, and "
       "included in the error estimate"},
      {"modulus",
       &T::modulus,
       "MN/mm",
       {0.5, 50},
       absent,
       "5 MN/mm",
       "slope of force over screw position with touching work rolls, of the whole stand: what rolls, contacts and "
       "bearings leave of it is shared by the parts of the frame that estimate = true finds"},
      {"modulus_tolerance",
       &T::modulus_tolerance,
       "%",
       {0.1, 50},
       absent,
       "3 %",
       "how far the modulus may be off, of its value: the error of its calibration; 3 % when absent"},
  };
  return rows;
}

std::vector<Field<EstimateInput>> roll_estimate_rows()
{
  return {estimate_rows().front()};
}

const std::vector<std::string> &estimable_keys(const std::string &section)
{
  static const std::vector<std::string> frame = [] {
    std::vector<std::string> keys;
    for (const Field<Frame> &row : frame_rows())
      keys.push_back(row.key);
    return keys;
  }();
  static const std::vector<std::string> roll{"neck_diameter",   "total_length", "neck_length",
                                             "bearing_span",    "bearing_mass", "chock_mass_upper",
                                             "chock_mass_lower"};
  static const std::vector<std::string> none;
  return section == "frame" ? frame : section == "work_roll" || section == "backup_roll" ? roll : none;
}

EstimateInput read_estimate(const Section &section, const std::vector<Field<EstimateInput>> &rows,
                            Reading &reading)
{
  EstimateInput wish;
  if (!section.node)
    return wish;
  for (const Field<EstimateInput> &field : rows)
    if (const auto value = read_row(row_of(field), section, reading))
      set_member(field, *value, wish);
  if (reading.places.count(section.key("modulus")) && !wish.estimate)
    contradict(reading, section.key("modulus"), "has no effect without estimate = true", {});
  if (reading.places.count(section.key("modulus_tolerance")) && std::isnan(wish.modulus))
    contradict(reading, section.key("modulus_tolerance"),
               "belongs to " + section.key("modulus") + ", which is not given; give both or neither", {});
  return wish;
}

void set_estimated(FourHigh &stand, const std::string &key, const double value)
{
  const auto dot            = key.find('.');
  const std::string section = key.substr(0, dot), name = key.substr(dot + 1);
  if (section == "frame") {
    for (const Field<Frame> &row : frame_rows())
      if (name == row.key)
        set_member(row, Value(value), stand.frame);
    return;
  }
  Roll &roll = section == "work_roll" ? stand.work_roll : stand.backup_roll;
  if (name == "total_length")
    roll.neck_length = (value - roll.barrel_length) / 2;
  for (const Field<Roll> &row : backup_roll_rows())
    if (name == row.key)
      set_member(row, Value(value), roll);
}

std::string estimate_lines(const Estimates &estimates)
{
  std::string text = estimates.empty() ? "" : "\n# Estimated, since their sections say estimate = true:\n";
  for (const Estimate &e : estimates)
    text += fmt::format("# {} = {:.4g} {} ({:.4g} .. {:.4g}): {}\n", e.key, from_si(e.value, unit(e.unit)), e.unit,
                        from_si(e.low, unit(e.unit)), from_si(e.high, unit(e.unit)), e.rule);
  return text;
}
}  // namespace mill
