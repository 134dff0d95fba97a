#pragma once
#include <sstream>
#include <string>

namespace mill::bite {
/// Text and numbers in one sentence, numbers with four digits.
template <class... Parts> std::string sentence(const Parts &...parts)
{
  std::ostringstream text;
  text.precision(4);
  (text << ... << parts);
  return text.str();
}
}  // namespace mill::bite
