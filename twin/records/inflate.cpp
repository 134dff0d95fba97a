#include "twin/records/inflate.h"
#include <algorithm>
#include <zlib.h>

namespace mill::twin {
namespace {
constexpr std::size_t step = 1 << 20;  // byte

class Inflater {
public:
  Inflater(const std::string_view bytes, const Deflated form) : rest(bytes)
  {
    usable = inflateInit2(&stream, form == Deflated::zlib ? MAX_WBITS : -MAX_WBITS) == Z_OK;
  }
  ~Inflater()
  {
    if (usable)
      inflateEnd(&stream);
  }
  Inflater(const Inflater &)            = delete;
  Inflater &operator=(const Inflater &) = delete;

  // Appends up to n bytes; false at the end and where the bytes are damaged.
  bool more(std::string &out, const std::size_t n)
  {
    if (!usable || ended)
      return false;
    const std::size_t before = out.size();
    out.resize(before + n);
    stream.next_out  = reinterpret_cast<Bytef *>(out.data() + before);
    stream.avail_out = uInt(n);
    int state        = Z_OK;
    while (state == Z_OK && stream.avail_out > 0) {
      if (stream.avail_in == 0 && !rest.empty()) {
        const std::size_t part = std::min(rest.size(), step);
        stream.next_in         = reinterpret_cast<Bytef *>(const_cast<char *>(rest.data()));
        stream.avail_in        = uInt(part);
        rest.remove_prefix(part);
      }
      state = ::inflate(&stream, Z_NO_FLUSH);
    }
    out.resize(out.size() - stream.avail_out);
    ended   = state != Z_OK;
    damaged = ended && state != Z_STREAM_END;
    return !damaged && out.size() > before;
  }
  bool is_damaged() const
  {
    return damaged || !usable;
  }

private:
  std::string_view rest;
  z_stream stream{};
  bool usable = false, ended = false, damaged = false;
};
}  // namespace

std::optional<std::string> inflated(const std::string_view bytes, const Deflated form, const std::size_t size)
{
  Inflater inflater(bytes, form);
  std::string out;
  while (out.size() <= size && inflater.more(out, std::min(step, size + 1 - out.size()))) {
  }
  if (inflater.is_damaged() || out.size() != size)
    return {};
  return out;
}

std::string inflated_head(const std::string_view bytes, const Deflated form, const std::size_t most)
{
  Inflater inflater(bytes, form);
  std::string out;
  inflater.more(out, most);
  return out;
}
}  // namespace mill::twin
