#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

// Numbers in text: which sign is the decimal point and which one separates thousands.
namespace mill::twin {
/// One way to write numbers.
struct NumberStyle {
  char decimal = '.';
  char group   = 0;  ///< separates thousands: ',', '.', '\'' or ' ' (also no-break spaces); 0: nothing does
};
bool operator==(const NumberStyle &a, const NumberStyle &b);

/// All ways that are understood; a set of them is a mask with bit i for style i.
constexpr std::array<NumberStyle, 8> number_styles{
    {{'.', 0}, {',', 0}, {'.', ','}, {',', '.'}, {'.', '\''}, {',', '\''}, {'.', ' '}, {',', ' '}}};
using StyleMask                 = unsigned;
constexpr StyleMask every_style = (1u << number_styles.size()) - 1;

/// The styles in which a text is a finite number; 0: in none.  "12" is one in all, "1.5" in those with a point or
/// with groups of another sign, "8.987" also in the one with a point between thousands.
StyleMask styles_of(std::string_view cell);

/// A number in one style.  False where the text is not one; a group that is not of three digits is not one.
bool read_number(std::string_view cell, const NumberStyle &style, double &number);

/// What the cells of one column allow, and all other columns of the file.
struct StyleChoice {
  NumberStyle style;
  bool guessed = false;  ///< nothing in the file decides between "1,234" as 1.234 and as 1234
};
/// @param column  styles in which every cell of the column is a number, not 0
/// @param file    the same of each column of the file
/// @param separator  of the columns
StyleChoice style_of_column(StyleMask column, const std::vector<StyleMask> &file, char separator);
}  // namespace mill::twin
