// A catalogue of bearings, and a search in it by the text of its own first designation.
#include "core/base/errors.h"
#include "core/case/bearing_catalogue.h"
#include "tests/fuzz/fuzz_file.h"
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  try {
    const auto bearings = mill::catalogue_of("catalogue.csv", text_of(data, size));
    if (bearings.empty())
      return 0;
    mill::find_bearing(bearings, bearings.front().designation);
    mill::nearest_designations(bearings, bearings.front().designation.substr(1));
  } catch (const mill::InputError &) {
  }
  return 0;
}
