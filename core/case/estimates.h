#pragma once
#include "core/case/fields.h"
#include "core/case/stand_rows.h"
#include "core/model/estimate.h"
#include "core/model/four_high.h"
#include <algorithm>
#include <set>

// estimate = true in a section: what a drawing hides and a required key asks for is estimated, marked and counted
// in the accuracy.  theory.md 34.3
namespace mill {
/// Keys of a section that may be estimated.
struct EstimateInput {
  bool estimate            = false;
  double modulus           = not_given;  ///< N/m, of the whole stand with touching work rolls, measured
  double modulus_tolerance = not_given;  ///< -, relative, of its calibration
};
/// [work_roll], [backup_roll]: the first row; [frame]: both.
const std::vector<Field<EstimateInput>> &estimate_rows();
std::vector<Field<EstimateInput>> roll_estimate_rows();

/// Keys of a section that estimates exist for.
const std::vector<std::string> &estimable_keys(const std::string &section);

/// What of these keys stands in a section.
EstimateInput read_estimate(const Section &section, const std::vector<Field<EstimateInput>> &rows,
                            Reading &reading);

/// Rows of a section whose values may be left out since they are estimated; NaN in `out`.
template <class T>
std::vector<Field<T>> beside_estimate(const std::string &section, std::vector<Field<T>> rows, const bool estimate,
                                      T &out)
{
  const auto &keys = estimable_keys(section);
  for (Field<T> &row : rows)
    if (row.fallback.kind == Fallback::Kind::required &&
        std::find(keys.begin(), keys.end(), row.key) != keys.end()) {
      if (!estimate) {
        row.instead += (row.instead.empty() ? "" : ", or ") + std::string("estimate = true");
        continue;
      }
      row.fallback = absent;
      set_member(row, Value(not_given), out);
    }
  return rows;
}

/// What each section asks to be estimated.
struct EstimateWishes {
  EstimateInput work_roll, backup_roll, frame;
  std::set<std::string> needless;  ///< full keys that a drawing or a given value replaces
};

/// Fills in what is NaN of necks, spans and bearing masses, chock masses and frame, and lists it.
void estimate_stand(FourHigh &stand, const EstimateWishes &wishes, Reading &reading);

/// Another value, SI, in the place of an estimated one.
void set_estimated(FourHigh &stand, const std::string &key, double value);

/// "# work_roll.neck_diameter = \"252 mm\" is estimated, ..": lines of resolved.toml.
std::string estimate_lines(const Estimates &estimates);
}  // namespace mill
