// An edit of the studio: a key and its new value laid over a case text.
#include "core/base/errors.h"
#include "core/case/case_edit.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  std::string text        = text_of(data, size);
  const std::string key   = next_part(text);
  const std::string typed = next_part(text);
  try {
    const std::string changed = mill::with_value(text, key, mill::toml_as_typed(typed, size % 2 == 0));
    mill::written_values(changed);
  } catch (const mill::InputError &) {
  }
  return 0;
}
