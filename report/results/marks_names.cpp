#include "core/records/marks_record.h"
#include "core/records/result_names.h"
#include "core/records/result_words.h"
#include "report/results/names.h"
#include <algorithm>

namespace mill::report {
std::string marks_meaning(const std::string &name)
{
  const auto parts = parts_of(name);
  if (parts[0] != marks_family)
    return "";
  if (parts.size() == 2 && is_word(parts[1], ResultWord::frequency))
    return "frequency of the marks on the strip";
  if (parts.size() != 3)
    return "marks on the strip";
  std::string body = parts[1];
  std::replace(body.begin(), body.end(), '_', ' ');
  if (is_word(parts[2], ResultWord::per_turn))
    return "marks on one turn of the " + body;
  if (is_word(parts[2], ResultWord::rotation))
    return "turns of the " + body + " in a second";
  return is_word(parts[2], ResultWord::speed) ? body + ", speed of the strip at which it makes this spacing"
                                              : "marks on the strip";
}
}  // namespace mill::report
