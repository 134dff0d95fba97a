#include "twin/live/recording/npy_header.h"
#include "twin/records/npy_array.h"
#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>

namespace mill::live {
namespace {
constexpr char magic[] = "\x93NUMPY";
}

std::string npy_header(const std::vector<std::string> &fields, const std::int64_t rows)
{
  std::string text = "{'descr': [";
  for (const std::string &field : fields)
    text += fmt::format("('{}', '<f4'), ", field);
  text += fmt::format("('{}', '<i8')], 'fortran_order': False, 'shape': ({:>20},), }}", twin::sample_field, rows);
  // magic, version, length of the text: 10 bytes, 12 where the text needs four bytes for its length
  const bool wide        = text.size() > 60000;
  const std::size_t head = wide ? 12 : 10;
  text.append(64 - (head + text.size() + 1) % 64, ' ');
  text += '\n';
  std::string bytes(magic, 6);
  bytes += wide ? '\2' : '\1';
  bytes += '\0';
  for (std::size_t i = 0; i < head - 8; ++i)
    bytes += char((text.size() >> 8 * i) & 0xff);
  return bytes + text;
}

std::vector<std::string> field_names(const std::vector<std::string> &channels)
{
  std::vector<std::string> names;
  for (std::string name : channels) {
    for (char &c : name)
      if (c < ' ' || c > '~' || c == '\'' || c == '\\' || c == '"')
        c = '_';
    while (name == twin::sample_field || std::find(names.begin(), names.end(), name) != names.end())
      name += '_';
    names.push_back(name);
  }
  return names;
}

bool read_npy_header(const std::string &bytes, NpyHeader &header)
{
  if (bytes.size() < 12 || bytes.compare(0, 6, magic, 6) != 0 || (bytes[6] != 1 && bytes[6] != 2))
    return false;
  const std::size_t head = bytes[6] == 1 ? 10 : 12;
  std::size_t length     = 0;
  for (std::size_t i = 0; i < head - 8; ++i)
    length |= std::size_t((unsigned char)bytes[8 + i]) << 8 * i;
  if (bytes.size() < head + length)
    return false;
  const std::string text = bytes.substr(head, length);
  header.bytes           = head + length;
  header.fields.clear();
  for (std::size_t position = text.find("('"); position != std::string::npos;
       position             = text.find("('", position + 2)) {
    const std::size_t end = text.find('\'', position + 2);
    if (end == std::string::npos)
      return false;
    header.fields.push_back(text.substr(position + 2, end - position - 2));
  }
  const std::size_t shape = text.find("'shape': (");
  if (shape == std::string::npos || header.fields.empty() || header.fields.back() != twin::sample_field)
    return false;
  header.fields.pop_back();
  header.rows = std::strtoll(text.c_str() + shape + 10, nullptr, 10);
  return npy_header(header.fields, header.rows).size() == header.bytes;
}
}  // namespace mill::live
