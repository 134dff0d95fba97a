// An entry of the cache: as it stands, and with a checksum that fits, so that what is behind it is read too.
#include "core/records/cache_entry.h"
#include "fem/cache/component_cache.h"
#include "fem/cache/roll_cache.h"
#include "tests/fuzz/fuzz_file.h"

namespace {
void read_all(const std::string &path)
{
  using namespace mill::fem;
  std::string note;
  load_roll(path, "key", &note);
  load_fourier_roll(path, "key", &note);
  load_roller(path, "key", &note);
  load_rings(path, "key", &note);
  load_component(path, "key", &note);
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  std::string rest       = text_of(data, size);
  const std::string path = fuzz_file("entry.bin", rest);
  read_all(path);
  const std::string kind = next_part(rest);
  if (kind.find('\n') != std::string::npos)
    return 0;
  mill::write_cache_entry(path, kind, "key", rest);
  read_all(path);
  return 0;
}
