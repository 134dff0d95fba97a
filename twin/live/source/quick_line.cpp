#include "twin/live/source/quick_line.h"
#include "twin/live/source/line_word.h"
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace mill::live {
namespace {
constexpr std::size_t longest_plain_name = 64;
constexpr std::uint64_t exact_mantissa   = std::uint64_t(1) << 53;
constexpr std::size_t most_digits        = 18;  // whose number fits 64 bits
// Powers of ten that a double holds without rounding.
constexpr std::array<double, 23> exact_power{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                             1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                             1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

bool is_digit(const char c)
{
  return c >= '0' && c <= '9';
}

class PlainBlock {
public:
  explicit PlainBlock(const std::string_view line) : at_(line.data()), end_(at_ + line.size()) {}

  bool read(LineContent &content)
  {
    if (!take('{'))
      return false;
    do {
      std::string_view name;
      if (!read_name(name) || !take(':'))
        return false;
      if (choice_named<LineWord>(name) == LineWord::first_sample ? !read_first(content)
                                                                 : !read_list(name, content))
        return false;
    } while (take(','));
    if (!take('}'))
      return false;
    skip_blanks();
    return at_ == end_;
  }

private:
  void skip_blanks()
  {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\t'))
      ++at_;
  }
  bool take(const char c)
  {
    skip_blanks();
    if (at_ == end_ || *at_ != c)
      return false;
    ++at_;
    return true;
  }

  bool read_name(std::string_view &name)
  {
    if (!take('"'))
      return false;
    const char *const begin = at_;
    while (at_ != end_ && *at_ >= ' ' && *at_ <= '~' && *at_ != '"' && *at_ != '\\')
      ++at_;
    name = {begin, std::size_t(at_ - begin)};
    if (at_ == end_ || *at_ != '"')
      return false;
    ++at_;
    return !name.empty() && name.size() <= longest_plain_name && choice_named<LineWord>(name) != LineWord::head;
  }

  bool read_first(LineContent &content)
  {
    double s = 0;
    if (content.s || !read_number(s))
      return false;
    content.s = s;
    return true;
  }

  bool read_list(const std::string_view name, LineContent &content)
  {
    const bool again = std::any_of(content.values.begin(), content.values.end(),
                                   [&](const auto &channel) { return channel.first == name; });
    if (again || content.values.size() == line_limits.channels || !take('['))
      return false;
    std::vector<double> list;
    if (!content.values.empty())  // channels of a block have the same length as a rule
      list.reserve(content.values.front().second.size());
    if (!take(']')) {
      do {
        double value = 0;
        skip_blanks();
        const bool none = at_ != end_ && *at_ == 'n';
        if (list.size() == line_limits.samples || !(none ? read_null(value) : read_number(value)))
          return false;
        list.push_back(value);
      } while (take(','));
      if (!take(']'))
        return false;
    }
    content.values.emplace_back(name, std::move(list));
    return true;
  }

  bool read_null(double &value)
  {
    constexpr std::string_view word = "null";
    if (std::size_t(end_ - at_) < word.size() || std::string_view(at_, word.size()) != word)
      return false;
    at_ += word.size();
    value = std::numeric_limits<double>::quiet_NaN();
    return true;
  }

  // Digits from here on, as a number while they are few enough.
  std::size_t read_digits(std::uint64_t &number)
  {
    const char *const begin = at_;
    for (; at_ != end_ && is_digit(*at_); ++at_)
      number = 10 * number + std::uint64_t(*at_ - '0');
    return std::size_t(at_ - begin);
  }

  // The grammar of JSON.  A mantissa below 2^53 over a power of ten up to 10^22 is rounded once, by the division,
  // so it is the nearest double; other numbers are left to from_chars.
  bool read_number(double &value)
  {
    skip_blanks();
    const char *const begin = at_;
    const bool negative     = at_ != end_ && *at_ == '-';
    at_ += negative;
    const bool zero         = at_ != end_ && *at_ == '0';
    std::uint64_t mantissa  = 0;
    const std::size_t whole = read_digits(mantissa);
    std::size_t fraction    = 0;
    if (whole == 0 || (zero && whole > 1))
      return false;
    if (at_ != end_ && *at_ == '.') {
      ++at_;
      fraction = read_digits(mantissa);
      if (fraction == 0)
        return false;
    }
    const bool exponent = at_ != end_ && (*at_ == 'e' || *at_ == 'E');
    if (exponent && !skip_exponent())
      return false;
    if (!exponent && whole + fraction <= most_digits && mantissa < exact_mantissa) {
      value = double(mantissa) / exact_power[fraction];
      value = negative ? -value : value;
      return true;
    }
    const auto read = std::from_chars(begin, at_, value);
    return read.ec == std::errc() && read.ptr == at_ && std::isfinite(value);
  }

  bool skip_exponent()
  {
    ++at_;
    if (at_ != end_ && (*at_ == '+' || *at_ == '-'))
      ++at_;
    std::uint64_t unused = 0;
    return read_digits(unused) > 0;
  }

  const char *at_, *end_;
};
}  // namespace

bool read_plain_block(const std::string_view line, LineContent &content)
{
  if (PlainBlock(line).read(content))
    return true;
  content = {};
  return false;
}
}  // namespace mill::live
