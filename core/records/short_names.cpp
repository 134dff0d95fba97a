#include "core/records/short_names.h"
#include <array>
#include <utility>

namespace mill {
std::string full_result_name(const std::string &written)
{
  static const std::array<std::pair<std::string, std::string>, 1> short_names{
      {{"gap_mode.", "mode.gap_first_kind."}}};
  for (const auto &[begin, full] : short_names)
    if (written.rfind(begin, 0) == 0)
      return full + written.substr(begin.size());
  return written;
}
}  // namespace mill
