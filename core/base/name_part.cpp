#include "core/base/name_part.h"

namespace mill {
namespace {
constexpr const char *point = "%2E", *slash = "%2F";  // as in addresses of the web (RFC 3986)
}  // namespace

std::string name_part(const std::string &name)
{
  std::string part;
  for (const char c : name)
    if (c == '.')
      part += point;
    else if (c == '/')
      part += slash;
    else
      part += c;
  return part;
}

std::string with_plain_names(const std::string &text)
{
  if (text.find('%') == std::string::npos)
    return text;
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text.compare(i, 3, point) == 0 || text.compare(i, 3, slash) == 0) {
      plain += text[i + 2] == 'E' ? '.' : '/';
      i += 2;
    } else
      plain += text[i];
  return plain;
}
}  // namespace mill
