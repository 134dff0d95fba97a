#include "core/records/record_text.h"
#include "core/base/files.h"
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace mill {
// As "{:a}" writes it, in a fifth of the time.
void RecordText::add(const double value)
{
  char digits[32];
  const char *end  = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::hex).ptr;
  const char *from = digits;
  if (*from == '-')
    text += *from++;
  if (std::isfinite(value))
    text += "0x";
  text.append(from, end);
}

void RecordText::add(const std::string &value)
{
  text += fmt::format("{}:{}", value.size(), value);
}

void RecordText::add(const Eigen::MatrixXd &value)
{
  const std::string bytes(reinterpret_cast<const char *>(value.data()),
                          std::size_t(value.size()) * sizeof(double));
  text += fmt::format("{}x{}:{}", value.rows(), value.cols(), hash_of(bytes));
}
}  // namespace mill
