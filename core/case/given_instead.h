#pragma once
#include "core/case/fields.h"
#include "core/model/material.h"
#include <set>
#include <string>
#include <vector>

// What is given makes what lies behind it optional: whoever knows K1 and M1 draws no upper frame.
namespace mill {
/// Keys of one section that nothing reads once all of `given` are there.
struct BehindGiven {
  std::vector<std::string> given;  ///< names in [given]
  std::string section;             ///< "frame"
  std::vector<std::string> keys;
};
const std::vector<BehindGiven> &behind_given();

/// Names that stand under [given], whatever they say.
std::set<std::string> given_names(const Node &root);

/// Are all values there that stand for this key?
bool is_needless(const std::string &section, const std::string &key, const std::set<std::string> &given);

/// What could be given in place of a key: "M1 in [given]", "Kzc1 and Kzc4, or K_Zy, in [given]"; empty: nothing.
std::string given_instead(const std::string &section, const std::string &key);

/// Rows of a section when a value is given: the rows from which the value would follow are optional, and not given
/// (masses zero) in `out`; the others name what could be given instead.
template <class T>
std::vector<Field<T>> beside_given(const std::string &section, std::vector<Field<T>> rows,
                                   const std::set<std::string> &given, T &out)
{
  for (Field<T> &row : rows) {
    row.instead = given_instead(section, row.key);
    if (row.fallback.kind != Fallback::Kind::required || !is_needless(section, row.key, given))
      continue;
    const bool mass = std::string(row.form) == "kg";
    row.fallback    = mass ? Fallback(0.) : absent;
    if (std::holds_alternative<double T::*>(row.member))
      set_member(row, Value(mass ? 0. : not_given), out);
  }
  return rows;
}
}  // namespace mill
