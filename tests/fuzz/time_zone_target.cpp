// A file of the system's time zones (TZif).
#include "core/base/errors.h"
#include "tests/fuzz/fuzz_file.h"
#include "twin/records/time_zone.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  fuzz_file("zone", text_of(data, size));
  try {
    const mill::twin::TimeZone zone("zone", fuzz_folder());
    for (const std::int64_t local : {std::int64_t(0), std::int64_t(1767607200), std::int64_t(-3000000000)})
      zone.utc_of(local);
  } catch (const mill::InputError &) {
  }
  return 0;
}
