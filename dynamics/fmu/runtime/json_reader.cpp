#include "json_reader.h"
#include <charconv>
#include <clocale>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace mill::fmu {
namespace {
class JsonReader {
public:
  explicit JsonReader(const std::string &text)
      : at_(text.data()), begin_(text.data()), end_(text.data() + text.size())
  {
  }

  Json whole()
  {
    Json value = one(0);
    skip();
    if (at_ != end_)
      fail("text behind the end");
    return value;
  }

private:
  [[noreturn]] void fail(const char *what) const
  {
    throw std::runtime_error(std::string(what) + " at byte " + std::to_string(at_ - begin_));
  }
  void skip()
  {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\t' || *at_ == '\r'))
      ++at_;
  }
  bool take(const char c)
  {
    skip();
    if (at_ == end_ || *at_ != c)
      return false;
    ++at_;
    return true;
  }
  void want(const char c)
  {
    if (!take(c))
      fail("unexpected character");
  }
  bool word(const char *w)
  {
    const std::size_t n = std::strlen(w);
    if (std::size_t(end_ - at_) < n || std::strncmp(at_, w, n) != 0)
      return false;
    at_ += n;
    return true;
  }

  std::string quoted()
  {
    want('"');
    std::string out;
    for (; at_ != end_ && *at_ != '"'; ++at_) {
      if (*at_ != '\\') {
        out += *at_;
        continue;
      }
      if (++at_ == end_)
        break;
      if (*at_ == 'n')
        out += '\n';
      else if (*at_ == '"' || *at_ == '\\' || *at_ == '/')
        out += *at_;
      else
        fail("escape that this file does not use");
    }
    want('"');
    return out;
  }

  Json one(const int depth)
  {
    if (depth > 8)
      fail("nested too deeply");
    Json value;
    skip();
    if (at_ == end_)
      fail("end of the text");
    if (*at_ == '"') {
      value.kind = Json::Kind::text;
      value.text = quoted();
    } else if (take('[')) {
      value.kind = Json::Kind::list;
      while (!take(']')) {
        value.items.push_back(one(depth + 1));
        if (!take(',')) {
          want(']');
          break;
        }
      }
    } else if (take('{')) {
      value.kind = Json::Kind::object;
      while (!take('}')) {
        skip();
        std::string name = quoted();
        want(':');
        value.members.push_back({std::move(name), one(depth + 1)});
        if (!take(',')) {
          want('}');
          break;
        }
      }
    } else if (word("true") || word("false")) {
      value.kind  = Json::Kind::boolean;
      value.truth = at_[-2] == 'u';  // of "true"; that of "false" is an s
    } else if (!word("null")) {
      const char *stop = at_;
      while (stop != end_ && std::strchr("+-.0123456789eE", *stop))
        ++stop;
      value.kind = Json::Kind::number;
      if (!read_number(at_, stop, value.number))
        fail("no number");
      at_ = stop;
    }
    return value;
  }

  const char *at_, *begin_, *end_;
};
}  // namespace

const Json *Json::find(const std::string &name) const
{
  for (const auto &[key, value] : members)
    if (key == name)
      return &value;
  return nullptr;
}

Json read_json(const std::string &text)
{
  return JsonReader(text).whole();
}

bool read_number(const char *begin, const char *end, double &value)
{
#ifdef __cpp_lib_to_chars
  const auto read = std::from_chars(begin, end, value);
  return read.ec == std::errc() && read.ptr == end;
#else
  // A standard library without from_chars for numbers with a fraction: strtod wants the decimal point of the
  // locale.
  std::string text(begin, end);
  const std::size_t point = text.find('.');
  if (point != std::string::npos)
    text.replace(point, 1, std::localeconv()->decimal_point);
  char *stop = nullptr;
  value      = std::strtod(text.c_str(), &stop);
  return !text.empty() && stop == text.c_str() + text.size();
#endif
}
}  // namespace mill::fmu
