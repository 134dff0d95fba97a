#pragma once
#include <cstdint>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace mill::web {
/// Writes one JSON text from front to back.  Numbers that are not finite become null; text that is not UTF-8 gets
/// replacement characters.
class JsonWriter {
public:
  JsonWriter &open(char bracket);   ///< '{' or '[' as a value
  JsonWriter &close(char bracket);  ///< '}' or ']'
  JsonWriter &key(const std::string &name);
  JsonWriter &number(double value, int digits = 9);  ///< significant digits
  JsonWriter &whole(std::int64_t value);
  JsonWriter &flag(bool value);
  JsonWriter &text(const std::string &value);
  /// Bytes of little-endian float32 in base64.
  JsonWriter &floats(const std::vector<float> &values);

  JsonWriter &member(const std::string &name, double value, int digits = 9);
  JsonWriter &member(const std::string &name, const std::string &value);
  JsonWriter &member(const std::string &name, const char *value);
  JsonWriter &member(const std::string &name, const std::vector<double> &values, int digits = 9);
  JsonWriter &whole(const std::string &name, std::int64_t value);
  JsonWriter &flag(const std::string &name, bool value);
  JsonWriter &floats(const std::string &name, const std::vector<float> &values);

  std::string str() const;

private:
  void comma();
  fmt::memory_buffer text_;
  bool first_ = true;  ///< nothing stands before the next value
};

std::string base64_floats(const std::vector<float> &values);
}  // namespace mill::web
