#include "app/study/row_watch.h"
#include "app/study/store/row_files.h"
#include "core/base/errors.h"
#include "core/process/stop.h"
#include <algorithm>

namespace mill {
namespace {
constexpr auto between_looks = std::chrono::seconds(1);

std::set<std::string> files_of(const Study &study)
{
  const auto files = row_files(study.folder);
  return {files.begin(), files.end()};
}
}  // namespace

RowWatch::RowWatch(const Study &watched, const long open_rows, const bool quiet)
    : study(watched), open(open_rows), files_before(files_of(watched)),
      last_look(std::chrono::steady_clock::now()), bar({{"rows", 1}}, quiet)
{
  bar.show("rows", 0);
}

void RowWatch::look()
{
  const auto now = std::chrono::steady_clock::now();
  if (now - last_look < between_looks)
    return;
  last_look = now;
  long done = 0;
  for (const std::string &file : row_files(study.folder))
    if (files_before.count(file) == 0)
      done += rows_in(file);
  try {
    bar.show("rows", std::min(1.0, double(done) / double(std::max(1L, open))));
  } catch (const Stopped &) {  // whoever waits for the workers sees the same wish, and ends them
  }
}

void RowWatch::finish()
{
  bar.finish();
}
}  // namespace mill
