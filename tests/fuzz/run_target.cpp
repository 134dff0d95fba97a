// A result folder: results.json, run.json and one table, each as it comes.
#include "core/base/errors.h"
#include "report/page/page.h"
#include "report/page/run.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  std::string rest = text_of(data, size);
  fuzz_file("results.json", next_part(rest));
  fuzz_file("run.json", next_part(rest));
  std::filesystem::create_directories(fuzz_folder() + "/curves");
  fuzz_file("curves/modes.csv", next_part(rest));
  fuzz_file("curves/contact.csv", rest);
  try {
    mill::report::read_run(fuzz_folder());
  } catch (const mill::InputError &) {
  }
  return 0;
}
