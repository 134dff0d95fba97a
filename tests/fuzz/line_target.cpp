// Lines of a data port or of MQTT: the bytes of one connection.
#include "core/base/errors.h"
#include "tests/fuzz/fuzz_file.h"
#include "twin/live/source/line_content.h"
#include "twin/live/source/line_session.h"
#include "twin/live/source/quick_line.h"
#include <cstdlib>
#include <cstring>

namespace {
// Bits, so that NaN is equal to itself.
bool same(const mill::live::LineContent &a, const mill::live::LineContent &b)
{
  if (a.values.size() != b.values.size() || a.s != b.s)
    return false;
  for (std::size_t k = 0; k < a.values.size(); ++k) {
    const auto &x = a.values[k].second, &y = b.values[k].second;
    if (a.values[k].first != b.values[k].first || x.size() != y.size())
      return false;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!(x[i] == y[i] || (x[i] != x[i] && y[i] != y[i])))
        return false;
  }
  return true;
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  mill::live::SourceRules rules;
  rules.places         = {"upper_work_roll", "lower_work_roll"};
  rules.reading.units  = {{"AI_07", "g"}};
  rules.reading.scales = {{"", "50 mV/g"}};
  rules.closes         = size % 2 == 0;
  mill::live::LineSession session(rules);
  mill::live::LineCutter cutter;
  bool open = true;
  cutter.add(std::string_view(reinterpret_cast<const char *>(data), size), [&](const std::string_view line) {
    mill::live::LineContent quick, whole;
    std::string problem;
    if (mill::live::read_plain_block(line, quick) &&
        !(mill::live::read_line(line, whole, problem) && same(quick, whole)))
      std::abort();  // the quick reader reads what the other one reads
    if (open)
      open = !session.take(line).close;
  });
  return 0;
}
