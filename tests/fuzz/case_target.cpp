// A case file: read, checked, resolved; what is resolved must be read again.
#include "core/base/errors.h"
#include "core/model/case.h"
#include "tests/fuzz/fuzz_file.h"
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  try {
    const std::string path = fuzz_folder() + "/case.toml";
    const mill::Case read  = mill::read_case_of(path, text_of(data, size));
    try {
      mill::read_case_of(path, read.resolved);
    } catch (const mill::InputError &) {
      std::abort();  // what the program writes it must read
    }
  } catch (const mill::InputError &) {
  }
  return 0;
}
