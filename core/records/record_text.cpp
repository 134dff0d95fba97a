#include "core/records/record_text.h"
#include "core/records/files.h"
#include <fmt/format.h>

namespace mill {
void RecordText::add(const double value)
{
  text += fmt::format("{:a}", value);
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
