#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace mill {
/// Exponents of the base dimensions.  The angle is kept apart so that "2.5 mrad" is not taken for a pure number.
struct Dimension {
  int length = 0, mass = 0, time = 0, temperature = 0, angle = 0;
};
bool operator==(const Dimension &a, const Dimension &b);

/// One unit of the closed list.  SI value = number * multiply / divide + offset; a division keeps "420 mm" the
/// double nearest to 0.42, which a multiplication by 0.001 does not.
struct Unit {
  const char *symbol;    ///< as written in a case file, "kN/mm"
  Dimension dimension;   ///< of the quantity
  double multiply;       ///< -, numerator of the factor to SI
  double divide;         ///< -, denominator of the factor to SI
  double offset;         ///< SI unit, value of the number zero, for degC
  const char *quantity;  ///< in words with article, "a stiffness"; N/mm and kN/mm share a dimension, not the word
};

/// The closed list of units.
const std::vector<Unit> &all_units();

/// Unit of a spelling: "N.s/m", "N*s/m" and "N s/m" are one, the micro sign is read as u.  nullptr when unknown.
const Unit *find_unit(std::string_view spelling);

/// Unit named in this program's own tables; an unknown one is our bug and is caught by an assertion.
const Unit &unit(std::string_view symbol);

/// The SI unit of the same dimension; the first of the list where several share one.
const Unit &si_unit(const Unit &unit);

double to_si(double number, const Unit &unit);
double from_si(double value, const Unit &unit);

/// What a text such as "4.0e4 kN/mm" says, or why it says nothing.
struct ParsedQuantity {
  enum class Fault {
    none,
    no_number,     ///< does not begin with a finite number
    no_unit,       ///< a number and nothing more
    unknown_unit,  ///< unit_text is not in the list
  };
  Fault fault      = Fault::none;
  double number    = 0;        ///< as written
  const Unit *unit = nullptr;  ///< of the list; nullptr with a fault
  std::string unit_text;       ///< as written
  double value() const;        ///< SI; only without a fault
};

/// Reads "1450 mm", "4.0e4 kN/mm", "2 %".  Decimal point in every locale.
ParsedQuantity parse_quantity(std::string_view text);

/// Reads a bare number that fills the whole text.  False when it does not, or when it is not finite.
bool parse_number(std::string_view text, double &number);

/// Fewest digits (17 at most) that read back as the same double, "." as decimal point; "nan", "inf" for those.
std::string number_text(double value);

/// SI value as text in the given unit, such that parse_quantity() returns exactly the same double; where rounding
/// makes that impossible in the unit asked for, the SI unit of the same dimension is used.
std::string quantity_text(double value, const Unit &unit);

/// Symbols of the units that share a dimension, "m, mm, um".
std::string units_like(const Unit &unit);
}  // namespace mill
