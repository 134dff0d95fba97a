#include "core/base/problem_parts.h"
#include <algorithm>

namespace mill {
std::string value_in_message(const std::string &message)
{
  const std::string sign = " = ";
  const auto place       = message.find(sign);
  if (place == std::string::npos)
    return "";
  const auto begin = place + sign.size();
  if (begin >= message.size())
    return "";
  if (message[begin] == '"') {
    const auto end = message.find('"', begin + 1);
    return end == std::string::npos ? "" : message.substr(begin + 1, end - begin - 1);
  }
  if (message[begin] == '[') {
    const auto end = message.find(']', begin);
    return end == std::string::npos ? "" : message.substr(begin, end - begin + 1);
  }
  return message.substr(begin, std::min(message.find_first_of(" ;,", begin), message.size()) - begin);
}

std::string remedy_in_message(const std::string &message)
{
  const std::string stop = "; ", outside = " is outside ";
  if (const auto place = message.rfind(stop); place != std::string::npos)
    return message.substr(place + stop.size());
  if (const auto place = message.find(outside); place != std::string::npos)
    return "allowed: " + message.substr(place + outside.size());
  return message;
}
}  // namespace mill
