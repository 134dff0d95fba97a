#include "core/case/resolved_sections.h"
#include <algorithm>

namespace mill {
std::string ResolvedSections::prefix(const std::string &header)
{
  const bool is_list      = header.rfind("[[", 0) == 0;
  const std::size_t begin = is_list ? 2 : 1, end = header.rfind(is_list ? "]]" : "]");
  std::string name = header.substr(begin, end == std::string::npos ? end : end - begin);
  // A section below a list belongs to its last item so far.
  if (const auto list = listed_.find(name.substr(0, name.find('.')));
      list != listed_.end() && list->first.size() < name.size())
    name.insert(list->first.size(), "." + std::to_string(list->second - 1));
  if (is_list)
    name += "." + std::to_string(listed_[name]++);
  name.erase(std::remove(name.begin(), name.end(), '"'), name.end());
  return name + ".";
}
}  // namespace mill
