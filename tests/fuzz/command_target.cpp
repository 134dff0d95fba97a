// The JSON of a command of the live page.
#include "core/base/errors.h"
#include "tests/fuzz/fuzz_file.h"
#include "twin/live/page/page_command.h"
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  try {
    const auto command = mill::live::page_command(text_of(data, size));
    if (!(command.factor >= 0.5 && command.factor <= 1.5) || command.key.size() > 64)
      std::abort();
  } catch (const mill::InputError &) {
  }
  return 0;
}
