#include "twin/live/source/line_content.h"
#include "core/base/visible_text.h"
#include "twin/live/source/line_word.h"
#include "twin/live/source/quick_line.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace mill::live {
namespace {
constexpr std::size_t longest_name = 128;

std::string shown(const std::string &text)
{
  return visible(text.size() > longest_name ? text.substr(0, longest_name) + ".." : text, true);
}

// Called by the parser for each piece of the line; false ends it.
class LineHandler {
public:
  using number_integer_t  = std::int64_t;
  using number_unsigned_t = std::uint64_t;
  using number_float_t    = double;
  using string_t          = std::string;
  using binary_t          = nlohmann::json::binary_t;

  LineHandler(LineContent &into, std::string &reason) : content(into), problem(reason) {}

  bool null()
  {
    return inside == Inside::array ? sample(std::numeric_limits<double>::quiet_NaN())
                                   : refuse(fmt::format("\"{}\" is null", shown(name)));
  }
  bool boolean(bool)
  {
    return refuse(fmt::format("\"{}\" is true or false; a number is needed", shown(name)));
  }
  bool number_integer(const number_integer_t value)
  {
    return number(double(value));
  }
  bool number_unsigned(const number_unsigned_t value)
  {
    return number(double(value));
  }
  bool number_float(const number_float_t value, const string_t &)
  {
    return number(value);
  }
  bool string(string_t &value)
  {
    if (value.size() > longest_name)
      return refuse(fmt::format("the text of \"{}\" has more than {} bytes", shown(name), longest_name));
    if (inside == Inside::units) {
      content.units.emplace_back(name, value);
      return content.units.size() <= line_limits.channels ||
             refuse(fmt::format("more than {} channels", line_limits.channels));
    }
    if (inside != Inside::line)
      return refuse(fmt::format("\"{}\" holds a text; numbers and null are samples", shown(name)));
    for (const auto &[key, text] : {std::pair("start", &content.start), std::pair("source", &content.source),
                                    std::pair("token", &content.token)})
      if (name == key) {
        *text = value;
        return true;
      }
    return refuse(fmt::format("\"{}\" is a text; a list of numbers is needed", shown(name)));
  }
  bool binary(binary_t &)
  {
    return refuse("binary values are not understood");
  }
  bool start_object(std::size_t)
  {
    if (!deeper())
      return false;
    if (inside == Inside::nothing)
      inside = Inside::line;
    else if (inside == Inside::line && choice_named<LineWord>(name) == LineWord::units)
      inside = Inside::units;
    else
      return refuse(fmt::format("\"{}\" is an object; only \"units\" is one", shown(name)));
    return true;
  }
  bool end_object()
  {
    --depth;
    inside = inside == Inside::units ? Inside::line : Inside::nothing;
    return true;
  }
  bool key(string_t &value)
  {
    name = value;
    if (name.empty() || name.size() > longest_name)
      return refuse(fmt::format("a name has {} bytes; 1 to {} are allowed", name.size(), longest_name));
    if (inside == Inside::line && choice_named<LineWord>(name) == LineWord::head)
      content.is_head = true;
    return true;
  }
  bool start_array(std::size_t)
  {
    if (!deeper())
      return false;
    if (inside == Inside::nothing)
      return refuse("the line is a list; an object {..} is needed");
    if (inside != Inside::line)
      return refuse(fmt::format("\"{}\" holds a list inside a list", shown(name)));
    if (std::any_of(content.values.begin(), content.values.end(), [&](const auto &c) { return c.first == name; }))
      return refuse(fmt::format("\"{}\" appears twice", shown(name)));
    if (content.values.size() == line_limits.channels)
      return refuse(fmt::format("more than {} channels", line_limits.channels));
    content.values.emplace_back(name, std::vector<double>());
    inside = Inside::array;
    return true;
  }
  bool end_array()
  {
    --depth;
    inside = Inside::line;
    return true;
  }
  bool parse_error(const std::size_t position, const std::string &, const nlohmann::detail::exception &error)
  {
    if (problem.empty())
      problem = error.id == 406 ? fmt::format("a number at byte {} is too large", position)
                                : fmt::format("no JSON from byte {} on", position);
    return false;
  }

private:
  enum class Inside { nothing, line, units, array };

  bool refuse(std::string why)
  {
    problem = std::move(why);
    return false;
  }
  bool deeper()
  {
    return ++depth <= line_limits.depth || refuse(fmt::format("nested more than {} deep", line_limits.depth));
  }
  bool sample(const double value)
  {
    auto &list = content.values.back().second;
    if (list.size() == line_limits.samples)
      return refuse(fmt::format("\"{}\" has more than {} samples", shown(name), line_limits.samples));
    list.push_back(value);
    return true;
  }
  bool number(const double value)
  {
    if (!std::isfinite(value))
      return refuse(fmt::format("\"{}\" holds a number that is not finite", shown(name)));
    if (inside == Inside::array)
      return sample(value);
    if (inside == Inside::nothing)
      return refuse("the line is a number; an object {..} is needed");
    if (inside == Inside::units)
      return refuse(fmt::format("the unit of \"{}\" is a number; a text is needed", shown(name)));
    for (const auto &[key, into] :
         {std::pair("millstand", &content.version), std::pair("rate", &content.rate), std::pair("s", &content.s)})
      if (name == key) {
        *into = value;
        return true;
      }
    return refuse(
        fmt::format("\"{}\" is one number; write a list, \"{}\":[{:g}]", shown(name), shown(name), value));
  }

  LineContent &content;
  std::string &problem;
  std::string name;
  Inside inside = Inside::nothing;
  int depth     = 0;
};
}  // namespace

bool read_line(const std::string_view line, LineContent &content, std::string &problem)
{
  if (line.size() > line_limits.bytes) {
    problem = "longer than 1 MiB";
    return false;
  }
  if (read_plain_block(line, content))
    return true;
  std::string reason;
  LineHandler handler(content, reason);
  const bool good = nlohmann::json::sax_parse(line.begin(), line.end(), &handler);
  if (good && reason.empty())
    return true;
  problem = reason.empty() ? "no JSON" : reason;
  return false;
}
}  // namespace mill::live
