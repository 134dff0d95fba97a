#include "twin/records/channel_scale.h"
#include "core/base/si_unit.h"
#include "core/base/units.h"
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
[[noreturn]] void refuse_scale(const std::string &text)
{
  throw InputError(fmt::format("--scale \"{}\" is not a sensitivity; write for example --scale \"50 mV/g\", "
                               "--scale \"10 g/V\", or what full scale stands for, --scale \"20 g\"",
                               text));
}
}  // namespace

ColumnUnit unit_by_scale(const std::string &text, const std::string &column)
{
  const std::string all = trimmed_cell(text);
  double number         = 0;
  const auto [end, bad] = std::from_chars(all.data(), all.data() + all.size(), number);
  if (bad != std::errc() || !std::isfinite(number) || number == 0)
    refuse_scale(text);
  const std::string unit = trimmed_cell(std::string_view(all).substr(std::size_t(end - all.data())));
  for (const auto &[volt, size] : {std::pair("V", 1.0), std::pair("mV", 1e-3), std::pair("uV", 1e-6)}) {
    const std::string over = std::string(volt) + "/", below = std::string("/") + volt;
    if (unit.rfind(over, 0) == 0) {  // "50 mV/g"
      ColumnUnit column_unit = unit_of_column(unit.substr(over.size()), column);
      column_unit.factor /= number * size;
      if (!column_unit.known)
        refuse_scale(text);
      return column_unit;
    }
    if (unit.size() > below.size() && unit.compare(unit.size() - below.size(), below.size(), below) == 0) {
      ColumnUnit column_unit = unit_of_column(unit.substr(0, unit.size() - below.size()), column);
      column_unit.factor *= number / size;
      if (!column_unit.known)
        refuse_scale(text);
      return column_unit;
    }
  }
  ColumnUnit column_unit = unit_of_column(unit, column);
  if (!column_unit.known || unit.empty())
    refuse_scale(text);
  column_unit.factor *= number;
  return column_unit;
}

std::optional<ColumnUnit> scale_of(const std::string &column, const ColumnUnit &unit, const ReadOptions &options)
{
  auto given = options.scales.find(column);
  if (given == options.scales.end())
    given = options.scales.find("");
  const bool open = unit.quantity == Quantity::voltage || (!unit.known && is_in(unit.si, SiUnit::one));
  if (given == options.scales.end() || !open)
    return std::nullopt;
  ColumnUnit scaled = unit_by_scale(given->second, column);
  if (unit.known)
    scaled.factor *= unit.factor;  // V in one unit of the file
  return scaled;
}
}  // namespace mill::twin
