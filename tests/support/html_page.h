#pragma once
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// What the tests of report pages ask of a text: how often, which elements, whether it is sound HTML without
// numbers that are none.
namespace mill {
inline bool says(const std::string &text, const std::string &what)
{
  return text.find(what) != std::string::npos;
}

inline int count(const std::string &text, const std::string &what)
{
  int n = 0;
  for (std::size_t position = text.find(what); position != std::string::npos;
       position             = text.find(what, position + what.size()))
    ++n;
  return n;
}

// From <name ...> to its </name>; the names asked for here are not nested.  "svg role" finds those with a role.
inline std::vector<std::string> elements(const std::string &html, const std::string &name)
{
  std::vector<std::string> found;
  const std::string open = "<" + name, close = "</" + name.substr(0, name.find(' ')) + ">";
  for (std::size_t position = html.find(open); position != std::string::npos;
       position             = html.find(open, position + 1)) {
    const std::size_t end = html.find(close, position);
    found.push_back(html.substr(position, end - position));
  }
  return found;
}

inline std::string without_scripts(std::string html)
{
  for (const char *name : {"script", "style"})
    for (const std::string &element : elements(html, name))
      html.erase(html.find(element), element.size() + std::string(name).size() + 3);
  return html;
}

// Name of the first element that is not closed in order; empty when all are.
inline std::string unbalanced(const std::string &html)
{
  std::vector<std::string> open;
  for (std::size_t position = html.find('<'); position != std::string::npos;
       position             = html.find('<', position + 1)) {
    const std::string tag  = html.substr(position + 1, html.find('>', position) - position - 1);
    const bool closing     = tag[0] == '/';
    const std::string name = tag.substr(closing, tag.find_first_of(" />", closing) - closing);
    if (tag.back() == '/' || tag[0] == '!')
      continue;
    if (!closing)
      open.push_back(name);
    else if (open.empty() || open.back() != name)
      return tag;
    else
      open.pop_back();
  }
  return open.empty() ? "" : open.back();
}

inline void expect_sound(const std::string &html, const std::string &what)
{
  const std::string page = without_scripts(html);
  EXPECT_EQ(unbalanced(page), "") << what;
  for (const char *bad : {">nan", "\"nan", " nan", ",nan", ">inf", "\"inf", ",inf", "-nan", "no finite value"})
    EXPECT_EQ(count(page, bad), 0) << what << ": " << bad;
  for (const char *twice : {"&amp;amp;", "&amp;lt;", "&amp;gt;", "&amp;quot;", "&amp;#39;"})
    EXPECT_EQ(count(page, twice), 0) << what << ": escaped twice, " << twice;
  EXPECT_EQ(count(html, "<figure>"), count(html, "<figcaption>")) << what;
}

// Every number of a stored file gone.
inline void make_null(nlohmann::ordered_json &json)
{
  if (json.is_number())
    json = nullptr;
  else if (json.is_structured())
    for (auto &entry : json)
      make_null(entry);
}
}  // namespace mill
