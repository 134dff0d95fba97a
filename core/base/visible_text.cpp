#include "core/base/visible_text.h"
#include "core/base/hidden_characters.h"
#include "core/base/name_part.h"
#include <algorithm>
#include <fmt/format.h>

namespace mill {
std::string visible(const std::string &stored, const bool one_line)
{
  const std::string text = with_plain_names(stored);
  std::string out;
  out.reserve(text.size());
  for (std::size_t position = 0; position < text.size();) {
    char32_t code       = 0;
    const std::size_t n = utf8_length(text, position, code);
    const bool layout   = !one_line && (code == '\n' || code == '\t');
    if (n == 0)
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[position]));
    else if (!is_hidden(code) || layout)
      out.append(text, position, n);
    else if (code == '\n' || code == '\t' || code == '\r')
      out += code == '\n' ? "\\n" : code == '\t' ? "\\t" : "\\r";
    else
      out += number_of_character(code);
    position += std::max<std::size_t>(n, 1);
  }
  return out;
}
}  // namespace mill
