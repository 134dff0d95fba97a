#pragma once
#include <string>
#include <vector>

namespace mill {
/// One number of an operating point and how it is shown.
struct StatedQuantity {
  double value;              ///< SI
  const char *shown_in;      ///< symbol of core/base/units.h, "kN"
  const char *form = ".6g";  ///< of the number shown, as fmt takes it after a colon
};

/// The load or state that a number belongs to: its quantities, and the words around them.  Empty where a number
/// belongs to none.
class OperatingPoint {
public:
  struct Value {
    double value;      ///< SI
    std::string unit;  ///< SI
  };

  OperatingPoint() = default;
  OperatingPoint(std::string words) : shown(std::move(words)) {}  ///< a state without numbers, "pass 2"
  OperatingPoint(const char *words) : shown(words) {}
  /// @param pattern  words with a {} for each quantity, "{} on one bearing"
  OperatingPoint(const std::string &pattern, const std::vector<StatedQuantity> &quantities);
  /// More of the same kind at the end.
  OperatingPoint &add(const std::string &pattern, const std::vector<StatedQuantity> &quantities);

  bool empty() const
  {
    return shown.empty();
  }
  const std::string &text() const
  {
    return shown;
  }  ///< "976.2 kN on one bearing"
  const std::vector<Value> &values() const
  {
    return quantities;
  }  ///< in the order of the text; may be empty

private:
  std::string shown;
  std::vector<Value> quantities;
  friend OperatingPoint operating_point_of(const std::string &text);
};

/// What a user wrote, word for word; a text that is one quantity ("976.2 kN") carries its value too.
OperatingPoint operating_point_of(const std::string &text);

/// A force of the whole stand, N: "976.2 kN".
OperatingPoint at_force(double force);
}  // namespace mill
