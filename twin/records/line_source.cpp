#include "twin/records/line_source.h"
#include "core/base/errors.h"
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace fs = std::filesystem;

namespace mill::twin {
namespace {
constexpr std::size_t block = 1 << 20;  // byte

void append_utf8(std::string &text, const unsigned point)
{
  if (point < 0x80)
    text += char(point);
  else if (point < 0x800) {
    text += char(0xC0 | point >> 6);
    text += char(0x80 | (point & 0x3F));
  } else if (point < 0x10000) {
    text += char(0xE0 | point >> 12);
    text += char(0x80 | (point >> 6 & 0x3F));
    text += char(0x80 | (point & 0x3F));
  } else {
    text += char(0xF0 | point >> 18);
    text += char(0x80 | (point >> 12 & 0x3F));
    text += char(0x80 | (point >> 6 & 0x3F));
    text += char(0x80 | (point & 0x3F));
  }
}

bool is_utf8(const std::string_view text)
{
  for (std::size_t i = 0; i < text.size();) {
    const auto c        = static_cast<unsigned char>(text[i]);
    const std::size_t n = c < 0x80             ? 1
                          : (c & 0xE0) == 0xC0 ? 2
                          : (c & 0xF0) == 0xE0 ? 3
                          : (c & 0xF8) == 0xF0 ? 4
                                               : 0;
    if (n == 0 || i + n > text.size())
      return false;
    for (std::size_t k = 1; k < n; ++k)
      if ((text[i + k] & 0xC0) != 0x80)
        return false;
    i += n;
  }
  return true;
}
}  // namespace

std::string utf8_of(const std::string_view text, bool &converted)
{
  converted = !is_utf8(text);
  if (!converted)
    return std::string(text);
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    append_utf8(result, byte == 0x80 ? 0x20AC : byte < 0xA0 && byte > 0x80 ? unsigned('?') : byte);
  }
  return result;
}

LineSource::LineSource(const std::string &path) : path_(path)
{
  std::error_code error;
  const auto status = fs::status(path, error);
  if (!fs::exists(status))
    throw InputError("there is no file " + path);
  if (!fs::is_regular_file(status))
    throw InputError(path + " is no regular file; a record is read from a file");
  size_ = double(fs::file_size(path, error));
  file_.open(path, std::ios::binary);
  if (!file_)
    refuse_file(errno, path + " cannot be read: " + std::strerror(errno));
  char head[3] = {};
  file_.read(head, 3);
  const auto n = file_.gcount();
  file_.clear();
  std::size_t skip = 0;
  if (n >= 3 && std::memcmp(head, "\xEF\xBB\xBF", 3) == 0)
    skip = 3;
  else if (n >= 2 && (std::memcmp(head, "\xFF\xFE", 2) == 0 || std::memcmp(head, "\xFE\xFF", 2) == 0)) {
    encoding_ = head[0] == '\xFF' ? "UTF-16 little endian" : "UTF-16 big endian";
    skip      = 2;
  }
  mark_ = skip > 0;
  file_.seekg(std::streamoff(skip));
  raw_.resize(block);
}

void LineSource::append_utf16(const char *bytes, const std::size_t n)
{
  half_.append(bytes, n);
  const bool little = encoding_ == "UTF-16 little endian";
  std::size_t i     = 0;
  for (; i + 1 < half_.size(); i += 2) {
    const auto first = static_cast<unsigned char>(half_[i]), second = static_cast<unsigned char>(half_[i + 1]);
    const unsigned unit = little ? first | unsigned(second) << 8 : second | unsigned(first) << 8;
    if (unit >= 0xD800 && unit < 0xDC00)
      high_surrogate_ = unit;
    else if (unit >= 0xDC00 && unit < 0xE000) {
      append_utf8(buffer_,
                  high_surrogate_ ? 0x10000 + ((high_surrogate_ - 0xD800) << 10) + (unit - 0xDC00) : 0xFFFD);
      high_surrogate_ = 0;
    } else
      append_utf8(buffer_, unit);
  }
  half_.erase(0, i);
}

bool LineSource::fill()
{
  if (!file_)
    return false;
  buffer_.erase(0, at_);
  at_ = 0;
  file_.read(raw_.data(), std::streamsize(raw_.size()));
  const auto n = std::size_t(file_.gcount());
  done_ += double(n);
  if (file_.bad())
    throw SystemError(path_ + " cannot be read to its end");
  if (encoding_ == "UTF-8")
    buffer_.append(raw_, 0, n);
  else
    append_utf16(raw_.data(), n);
  return n > 0;
}

bool LineSource::next(std::string_view &line)
{
  std::size_t searched = at_;
  while (true) {
    const auto end = buffer_.find('\n', searched);
    if (end != std::string::npos) {
      line = std::string_view(buffer_).substr(at_, end - at_);
      at_  = end + 1;
      break;
    }
    const std::size_t open = buffer_.size() - at_;
    if (!fill()) {
      if (open == 0)
        return false;
      line      = std::string_view(buffer_).substr(at_);
      at_       = buffer_.size();
      open_end_ = true;
      break;
    }
    searched = open;
  }
  ++number_;
  if (!line.empty() && line.back() == '\r')
    line.remove_suffix(1);
  return true;
}

int LineSource::number() const
{
  return number_;
}

bool LineSource::ended_without_newline() const
{
  return open_end_;
}

const std::string &LineSource::encoding() const
{
  return encoding_;
}

bool LineSource::had_mark() const
{
  return mark_;
}

double LineSource::size() const
{
  return size_;
}

double LineSource::done() const
{
  return done_;
}
}  // namespace mill::twin
