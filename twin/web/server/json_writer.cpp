#include "twin/web/server/json_writer.h"
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

namespace mill::web {
void JsonWriter::comma()
{
  if (!first_)
    text_.push_back(',');
  first_ = false;
}

JsonWriter &JsonWriter::open(const char bracket)
{
  comma();
  text_.push_back(bracket);
  first_ = true;
  return *this;
}

JsonWriter &JsonWriter::close(const char bracket)
{
  text_.push_back(bracket);
  first_ = false;
  return *this;
}

JsonWriter &JsonWriter::key(const std::string &name)
{
  text(name);
  text_.push_back(':');
  first_ = true;
  return *this;
}

JsonWriter &JsonWriter::number(const double value, const int digits)
{
  comma();
  if (std::isfinite(value))
    fmt::format_to(std::back_inserter(text_), "{:.{}g}", value, digits);
  else
    fmt::format_to(std::back_inserter(text_), "null");
  return *this;
}

JsonWriter &JsonWriter::whole(const std::int64_t value)
{
  comma();
  fmt::format_to(std::back_inserter(text_), "{}", value);
  return *this;
}

JsonWriter &JsonWriter::flag(const bool value)
{
  comma();
  fmt::format_to(std::back_inserter(text_), value ? "true" : "false");
  return *this;
}

JsonWriter &JsonWriter::text(const std::string &value)
{
  comma();
  const auto written = nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  text_.append(written.data(), written.data() + written.size());
  return *this;
}

JsonWriter &JsonWriter::floats(const std::vector<float> &values)
{
  return text(base64_floats(values));
}

JsonWriter &JsonWriter::member(const std::string &name, const double value, const int digits)
{
  return key(name).number(value, digits);
}

JsonWriter &JsonWriter::member(const std::string &name, const std::string &value)
{
  return key(name).text(value);
}

JsonWriter &JsonWriter::member(const std::string &name, const char *value)
{
  return key(name).text(value);
}

JsonWriter &JsonWriter::member(const std::string &name, const std::vector<double> &values, const int digits)
{
  key(name).open('[');
  for (const double value : values)
    number(value, digits);
  return close(']');
}

JsonWriter &JsonWriter::whole(const std::string &name, const std::int64_t value)
{
  return key(name).whole(value);
}

JsonWriter &JsonWriter::flag(const std::string &name, const bool value)
{
  return key(name).flag(value);
}

JsonWriter &JsonWriter::floats(const std::string &name, const std::vector<float> &values)
{
  return key(name).floats(values);
}

std::string JsonWriter::str() const
{
  return fmt::to_string(text_);
}

std::string base64_floats(const std::vector<float> &values)
{
  static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * values.size());
  for (const float value : values) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, 4);
    for (int shift = 0; shift < 32; shift += 8)
      bytes.push_back(std::uint8_t(bits >> shift));
  }
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left   = bytes.size() - i;
    const std::uint32_t word = std::uint32_t(bytes[i]) << 16 | (left > 1 ? std::uint32_t(bytes[i + 1]) << 8 : 0) |
                               (left > 2 ? std::uint32_t(bytes[i + 2]) : 0);
    out += letters[word >> 18 & 63];
    out += letters[word >> 12 & 63];
    out += left > 1 ? letters[word >> 6 & 63] : '=';
    out += left > 2 ? letters[word & 63] : '=';
  }
  return out;
}
}  // namespace mill::web
