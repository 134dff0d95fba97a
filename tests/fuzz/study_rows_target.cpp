// A file of finished rows of a study (SQLite), and what merging makes of it.
#include "app/study/store/row_files.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  std::filesystem::create_directories(fuzz_folder() + "/rows");
  const std::string path = fuzz_folder() + "/rows/1-of-1-host-1-0123.db";
  if (std::getenv("MILL_FUZZ_SEED")) {
    std::filesystem::remove(path);
    mill::RowFile(path).commit({{7, {1, 2, 3}, ""}, {8, {}, "no convergence"}}, {{9, 1}});
    const std::string text = mill::read_text(path);
    fwrite(text.data(), 1, text.size(), stdout);
    return 0;
  }
  fuzz_file("rows/1-of-1-host-1-0123.db", text_of(data, size));
  mill::read_rows(path, 0, [](mill::FinishedRow &&) {});
  mill::begun_rows(path);
  std::filesystem::remove(mill::merged_file(fuzz_folder()));
  try {
    mill::merge_rows(fuzz_folder());
  } catch (const mill::InputError &) {
  }
  return 0;
}
