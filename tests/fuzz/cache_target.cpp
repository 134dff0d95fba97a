// An entry of the cache as it stands, and the bytes behind a checksum that fits.
#include "core/records/cached_record.h"
#include "core/records/component.h"
#include "fem/bearing/ring_flexibility.h"
#include "fem/bearing/roller_contact.h"
#include "fem/roll/condensed_roll.h"
#include "fem/roll/fourier_roll.h"
#include "tests/fuzz/fuzz_file.h"

namespace {
template <class... Record> void read_all(const std::string &path, const std::string &bytes)
{
  std::string note;
  ((mill::load_record<Record>(path, "key", &note), mill::record_of_bytes<Record>(bytes)), ...);
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  using namespace mill::fem;
  std::string rest       = text_of(data, size);
  const std::string path = fuzz_file("entry.bin", rest);
  next_part(rest);
  read_all<CondensedRoll, FourierRoll, CondensedRoller, RingResult, mill::Component>(path, rest);
  return 0;
}
