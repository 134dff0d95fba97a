#include "core/base/operating_point.h"
#include "core/base/force_text.h"
#include "core/base/require.h"
#include "core/base/units.h"
#include <fmt/format.h>

namespace mill {
OperatingPoint::OperatingPoint(const std::string &pattern, const std::vector<StatedQuantity> &stated)
{
  add(pattern, stated);
}

OperatingPoint &OperatingPoint::add(const std::string &pattern, const std::vector<StatedQuantity> &stated)
{
  std::size_t from = 0;
  for (const StatedQuantity &q : stated) {
    const std::size_t place = pattern.find("{}", from);
    require(place != std::string::npos, "no place for a quantity in \"" + pattern + "\"");
    const Unit &u = unit(q.shown_in);
    shown += pattern.substr(from, place - from) +
             fmt::format(fmt::runtime(fmt::format("{{:{}}} {}", q.form, u.symbol)), from_si(q.value, u));
    quantities.push_back({q.value, si_unit(u).symbol});
    from = place + 2;
  }
  shown += pattern.substr(from);
  return *this;
}

OperatingPoint operating_point_of(const std::string &text)
{
  OperatingPoint point = text;
  if (const ParsedQuantity parsed = parse_quantity(text); parsed.fault == ParsedQuantity::Fault::none)
    point.quantities.push_back({parsed.value(), si_unit(*parsed.unit).symbol});
  return point;
}

OperatingPoint at_force(const double force)
{
  return {"{}", {{force, "kN", force_form(force)}}};
}
}  // namespace mill
