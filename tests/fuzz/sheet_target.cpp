// A sheet of keys and values for `millstand new KIND --from`; the first byte says which kind.
#include "core/base/errors.h"
#include "core/case/case_sheet.h"
#include "core/case/kinds.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  if (size == 0)
    return 0;
  const auto &kinds = mill::all_kinds();
  try {
    mill::template_from_sheet(kinds[data[0] % kinds.size()]->name, "sheet.csv", text_of(data + 1, size - 1));
  } catch (const mill::InputError &) {
  }
  return 0;
}
