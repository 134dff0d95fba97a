// A quantity, a time, a scale, an override of --set: the short texts of a command line.
#include "core/base/errors.h"
#include "core/base/units.h"
#include "core/case/case_file.h"
#include "tests/fuzz/fuzz_file.h"
#include "twin/records/channel_scale.h"
#include "twin/records/time_zone.h"
#include <cmath>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  const std::string text = text_of(data, size);
  const auto quantity    = mill::parse_quantity(text);
  if (quantity.fault == mill::ParsedQuantity::Fault::none) {
    const double value      = quantity.value();
    const std::string shown = mill::quantity_text(value, *quantity.unit);
    const auto again        = mill::parse_quantity(shown);
    if (std::isfinite(value) && (again.fault != mill::ParsedQuantity::Fault::none || again.value() != value))
      std::abort();  // the text of a quantity says the same quantity
  }
  mill::twin::time_of_text(text);
  mill::twin::has_two_readings(text);
  try {
    mill::twin::unit_by_scale(text, "column");
  } catch (const mill::InputError &) {
  }
  try {
    mill::read_case_text("case.toml", "schema = 1\n", {text});
  } catch (const mill::InputError &) {
  }
  return 0;
}
