// A measured record of one format, MILL_READER; the part behind the first is the JSON file beside a .npy.
#include "core/base/errors.h"
#include "tests/fuzz/fuzz_file.h"
#include "twin/records/raw_record.h"
#include <cstdlib>

#define MILL_TEXT_OF(word) #word
#define MILL_ENDING(word) "record." MILL_TEXT_OF(word)

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  const bool with_json     = std::string(MILL_TEXT_OF(MILL_FORMAT)) == "npy";
  std::string rest         = text_of(data, size);
  const std::string json   = with_json ? next_part(rest) : "";
  const std::string record = fuzz_file(MILL_ENDING(MILL_FORMAT), rest);
  if (with_json)
    fuzz_file("record.json", json);
  mill::twin::ReadOptions options;
  options.fewest_samples = 2;
  options.zone           = "Europe/Berlin";
  if (size % 2)
    options.rate = 1000;
  try {
    const auto read = mill::twin::MILL_READER(record, options);
    for (const auto &channel : read.channels)
      if (channel.value.size() != read.n_samples() || (read.time.size() && read.time.size() != read.n_samples()))
        std::abort();  // all channels of a record have one length
  } catch (const mill::InputError &) {
  }
  return 0;
}
