#pragma once
#include "core/case/fields.h"
#include <string>
#include <vector>

// Quantities as they stand on drawings of other countries and in sheets of other locales.  They are refused and
// not read: the case file then shows the number the program works with, "ton" is not guessed, and no one has to
// know which of two commas was meant.  The message holds the line that is right.
namespace mill {
/// A unit that is not in the list of this program, with what one of it is.
struct ForeignUnit {
  const char *spelling;  ///< "in"
  const char *name;      ///< in words, "inches"
  double factor;         ///< SI value of one
  const char *like;      ///< a unit of the list with its dimension, "mm"
};
const std::vector<ForeignUnit> &foreign_units();

/// What a number with a decimal comma, thousands separators or gaps may mean, with a decimal point: "1450,5 mm" ->
/// "1450.5 mm"; "1,450 mm" -> "1.450 mm" and "1450 mm".  Empty when there is nothing of the kind in it.
std::vector<std::string> with_decimal_point(const std::string &text);

/// Is the one comma of its number a decimal comma, whatever the locale: "1450,5 mm", "1.450,5 mm", not "1,450 mm"?
bool has_decimal_comma(const std::string &text);

/// Both readings of a number whose point stands before three digits, "1.230 mm": with a point, "1.230 mm", and
/// with thousands, "1230 mm".  Empty where there is one reading.
std::vector<std::string> readings_of_point(const std::string &text);

/// The remedy for a text that is not a quantity of the wanted unit: "has a decimal comma; write \"1450.5 mm\"",
/// "is in inches; 57.1 in = 1450.34 mm: write \"1450.34 mm\"".  Empty when it is not such a slip.
/// @param form   unit of the row; "1" for a pure number
/// @param range  in that unit; readings outside are not proposed
std::string quantity_remedy(const std::string &text, const std::string &form, const Range &range);

/// Is the number within the range?  Both carry the rounding of a conversion of units.
bool inside(double number, const Range &range);
}  // namespace mill
