#include "twin/records/line_source.h"
#include "core/base/errors.h"
#include "core/base/text.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace mill::twin {
namespace {
constexpr std::size_t block = 1 << 20;  // byte
}  // namespace

LineSource::LineSource(const std::string &path) : file_(path), path_(path)
{
  char head[3]             = {};
  const std::string_view h = {head, file_.read(head, 3)};
  std::size_t skip         = 0;
  if (h == utf8_mark)
    skip = 3;
  else if (const auto utf16 = utf16_of_mark(h)) {
    encoding_ = *utf16;
    decoder_  = Utf16Decoder(*utf16 == TextEncoding::utf16_little);
    skip      = utf16_mark_size;
  }
  mark_ = skip > 0;
  file_.go_to(skip);
  raw_.resize(block);
}

bool LineSource::fill()
{
  if (buffer_.size() - at_ > longest_line)
    throw InputError(Place{path_, number_ + 1, 1},
                     fmt::format("this line is longer than {} MiB; a record in text has a line for each sample",
                                 longest_line >> 20));
  buffer_.erase(0, at_);
  at_                 = 0;
  const std::size_t n = file_.read(raw_.data(), raw_.size());
  done_ += double(n);
  if (encoding_ == TextEncoding::utf16_little || encoding_ == TextEncoding::utf16_big)
    decoder_.append(buffer_, {raw_.data(), n});
  else
    buffer_.append(raw_, 0, n);
  if (number_ == 0)
    find_end_of_lines();
  return n > 0;
}

// Old instruments, and spreadsheets that save for the Macintosh, end lines with CR alone.
void LineSource::find_end_of_lines()
{
  const std::size_t cr = buffer_.find('\r');
  if (cr != std::string::npos && cr + 1 < buffer_.size() && buffer_.find('\n') == std::string::npos)
    end_ = '\r';
}

bool LineSource::next(std::string_view &line)
{
  std::size_t searched = at_;
  while (true) {
    const auto end = buffer_.find(end_, searched);
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
  if (number_ < std::numeric_limits<int>::max())  // a place in a file is an int: 30 h at 20 kHz
    ++number_;
  if (!line.empty() && line.back() == '\r')
    line.remove_suffix(1);
  if (!is_utf8(line)) {
    converted_ = valid_text(line);
    line       = converted_;
    encoding_  = TextEncoding::windows_1252;
  }
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

TextEncoding LineSource::encoding() const
{
  return encoding_;
}

bool LineSource::had_mark() const
{
  return mark_;
}

double LineSource::size() const
{
  return file_.size();
}

double expected_lines(const std::string &path)
{
  constexpr int most_looks = 32;
  constexpr double look    = 1 << 16;  // byte
  InputFile file(path);
  const double looks = std::min(double(most_looks), std::ceil(file.size() / look));
  std::string bytes(std::size_t(look), '\0');
  double seen = 0, lf = 0, cr = 0;
  for (double i = 0; i < looks; ++i) {
    file.go_to(std::size_t(looks < most_looks ? i * look : i / looks * file.size()));
    const std::string_view part = {bytes.data(), file.read(bytes.data(), bytes.size())};
    seen += double(part.size());
    lf += double(std::count(part.begin(), part.end(), '\n'));
    cr += double(std::count(part.begin(), part.end(), '\r'));
  }
  return seen > 0 ? 1 + (lf > 0 ? lf : cr) * file.size() / seen : 0;
}

double LineSource::done() const
{
  return done_;
}
}  // namespace mill::twin
