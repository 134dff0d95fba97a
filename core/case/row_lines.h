#pragma once
#include "core/case/fields.h"
#include <string>
#include <vector>

namespace mill {
/// "key = value" of every row; a path is written as it stands and not made absolute.
template <class T> std::string lines(const std::vector<Field<T>> &fields, const T &in)
{
  std::string text;
  for (const Field<T> &field : fields) {
    const Row row     = row_of(field);
    const Value value = member_value(field, in);
    if (row.kind == Kind::path && !std::get<std::string>(value).empty())
      text += row.key + " = " + quoted(std::get<std::string>(value)) + "\n";
    else if (const std::string toml = toml_of(row, value); !toml.empty())
      text += row.key + " = " + toml + "\n";
  }
  return text;
}
}  // namespace mill
