#include "twin/records/npy_array.h"
#include "core/base/errors.h"
#include <algorithm>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double most_rows = 4e9;

[[noreturn]] void refuse_npy(const std::string &file, const std::string &what)
{
  throw InputError(file + " " + what);
}

// Value of 'key' in the header, a Python literal: from behind the colon to where brackets are closed again.
std::string literal_of(const std::string &header, const std::string &key)
{
  const auto position = header.find("'" + key + "'");
  if (position == std::string::npos)
    return "";
  auto i = header.find(':', position);
  std::string text;
  int depth = 0;
  for (++i; i < header.size(); ++i) {
    const char c = header[i];
    depth += (c == '[' || c == '(') - (c == ']' || c == ')');
    if (depth < 0 || (depth == 0 && (c == ',' || c == '}')))
      break;
    text += c;
  }
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first);
}

std::vector<std::string> quoted_in(const std::string &text)
{
  std::vector<std::string> names;
  for (std::size_t i = text.find('\''); i != std::string::npos; i = text.find('\'', i + 1)) {
    const auto end = text.find('\'', i + 1);
    if (end == std::string::npos)
      break;
    names.push_back(text.substr(i + 1, end - i - 1));
    i = end;
  }
  return names;
}

std::vector<double> numbers_in(const std::string &text)
{
  std::vector<double> numbers;
  for (std::size_t i = 0; i < text.size();)
    if (text[i] >= '0' && text[i] <= '9') {
      double value = 0;
      for (; i < text.size() && text[i] >= '0' && text[i] <= '9'; ++i)
        value = 10 * value + (text[i] - '0');
      numbers.push_back(value);
    } else
      ++i;
  return numbers;
}

// Bytes of a field without a name that numpy puts between others for the sake of the processor, "|V4"; 0: it is a
// field.
std::size_t size_of_padding(const std::string &name, const std::string &type)
{
  const auto size = numbers_in(type);
  return name.empty() && type.rfind("|V", 0) == 0 && size.size() == 1 && size[0] < 65536 ? std::size_t(size[0])
                                                                                         : 0;
}

// A field of several numbers has their shape as third element of its tuple: digits outside of the quotes.
bool has_shapes(const std::string &descr)
{
  bool quoted = false;
  return std::any_of(descr.begin(), descr.end(), [&](const char c) {
    quoted ^= c == '\'';
    return !quoted && c >= '0' && c <= '9';
  });
}

NpyLayout layout_of_header(const std::string &header, const std::string &path)
{
  NpyLayout layout;
  const std::string descr = literal_of(header, "descr");
  const auto shape        = numbers_in(literal_of(header, "shape"));
  const auto words        = quoted_in(descr);
  const bool fields       = !descr.empty() && descr.front() == '[';
  if (fields) {
    if (shape.size() != 1 || words.size() % 2 != 0)
      refuse_npy(path, "holds a structured array that is not one-dimensional, or with fields inside fields");
    if (has_shapes(descr))
      refuse_npy(path, "holds several numbers in one field of a structured array; save a field for each");
    for (std::size_t i = 0; i < words.size(); i += 2) {
      if (const std::size_t padding = size_of_padding(words[i], words[i + 1]); padding > 0) {
        layout.row += padding;
        continue;
      }
      BinaryType type;
      if (!type_of_descriptor(words[i + 1], type))
        refuse_npy(path, fmt::format("holds numbers of type '{}' in field '{}'; save float32, float64 or integers",
                                     words[i + 1], words[i]));
      layout.fields.push_back({words[i], type, layout.row});
      layout.row += std::size_t(type.size);
    }
  } else {
    BinaryType type;
    if (words.size() != 1 || !type_of_descriptor(words.front(), type))
      refuse_npy(path, fmt::format("holds numbers of type {}; save float32, float64 or integers", descr));
    if (shape.empty() || shape.size() > 2)
      refuse_npy(path, "holds an array that is neither one column (n) nor columns side by side (n, m)");
    layout.plain           = true;
    layout.columns_first   = literal_of(header, "fortran_order").rfind("True", 0) == 0;
    const double n_columns = shape.size() == 2 ? shape[1] : 1;
    if (n_columns < 1 || n_columns > 4096)
      refuse_npy(path, fmt::format("holds {} columns; one column per channel is needed, at most 4096", n_columns));
    for (std::size_t i = 0; i < std::size_t(n_columns); ++i)
      layout.fields.push_back({"", type, i * std::size_t(type.size)});
    layout.row = std::size_t(n_columns) * std::size_t(type.size);
  }
  layout.n = shape.front();
  if (layout.fields.empty() || layout.n > most_rows)
    refuse_npy(path, "holds no samples or more than 4e9");
  return layout;
}

}  // namespace

std::size_t npy_start(const std::string_view prefix, const std::string &path)
{
  const bool is_npy = prefix.size() >= 10 && prefix.substr(0, 6) == "\x93NUMPY";
  const int version = is_npy ? prefix[6] : 0;
  if (version < 1 || version > 3 || (version > 1 && prefix.size() < npy_prefix))
    refuse_npy(path, "is not an array that numpy saved (.npy, version 1 to 3)");
  const auto length = std::size_t(number_at(&prefix[8], {'u', version == 1 ? 2 : 4, false}));
  if (length > 1 << 20)
    refuse_npy(path, "has a header of more than 1 MiB");
  return (version == 1 ? 10u : 12u) + length;
}

NpyLayout npy_layout(const std::string_view head, const std::string &path)
{
  const std::size_t start = npy_start(head.substr(0, npy_prefix), path);
  if (head.size() < start)
    refuse_npy(path, "ends inside its header");
  const std::size_t before = head[6] == 1 ? 10 : 12;
  NpyLayout layout         = layout_of_header(std::string(head.substr(before, start - before)), path);
  layout.start             = start;
  return layout;
}

bool type_of_descriptor(const std::string &text, BinaryType &type)
{
  if (text.size() != 3 || std::string("<>|=").find(text[0]) == std::string::npos)
    return false;
  type             = {text[1], text[2] - '0', text[0] == '>'};
  const bool whole = (type.kind == 'i' || type.kind == 'u') &&
                     (type.size == 1 || type.size == 2 || type.size == 4 || type.size == 8);
  return whole || (type.kind == 'f' && (type.size == 4 || type.size == 8));
}

}  // namespace mill::twin
