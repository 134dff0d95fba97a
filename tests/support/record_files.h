#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

// Bytes of record files, made in the test.
namespace mill::record_files {
inline std::string little(const std::uint64_t value, const int bytes)
{
  std::string text;
  for (int i = 0; i < bytes; ++i)
    text += char(value >> 8 * i & 0xFF);
  return text;
}

inline std::string doubles(const std::vector<double> &values)
{
  std::string text(8 * values.size(), '\0');
  std::memcpy(text.data(), values.data(), text.size());
  return text;
}

/// An element of a MATLAB file: tag, data, padding.
inline std::string element(const int type, const std::string &data)
{
  return little(std::uint64_t(type), 4) + little(data.size(), 4) + data +
         std::string((8 - data.size() % 8) % 8, '\0');
}

/// An array of numbers, column by column.
inline std::string mat_array(const std::string &name, const std::vector<double> &values,
                             const std::size_t columns = 1)
{
  return element(14, element(6, little(6, 4) + little(0, 4)) +
                         element(5, little(values.size() / columns, 4) + little(columns, 4)) + element(1, name) +
                         element(9, doubles(values)));
}

/// A structure of arrays that were made with empty names.
inline std::string mat_structure(const std::string &name,
                                 const std::vector<std::pair<std::string, std::string>> &fields)
{
  std::string names, values;
  for (const auto &[field, value] : fields) {
    names += field + std::string(32 - field.size(), '\0');
    values += value;
  }
  return element(14, element(6, little(2, 4) + little(0, 4)) + element(5, little(1, 4) + little(1, 4)) +
                         element(1, name) + element(5, little(32, 4)) + element(1, names) + values);
}

/// A table, a string or another object of MATLAB: its values are in an array without a name at the end of the
/// file.
inline std::string mat_object(const std::string &name, const std::string &type)
{
  return element(14, element(6, little(17, 4) + little(0, 4)) + element(1, name) + element(1, "MCOS") +
                         element(1, type) + mat_array("", {0xDD000000, 2, 1, 1, 1, 1}));
}

/// Blocks of deflate that hold the bytes as they are.
inline std::string stored_blocks(const std::string &data)
{
  std::string blocks;
  for (std::size_t position = 0;; position += 65535) {
    const std::string part = data.substr(position, 65535);
    const bool last        = position + 65535 >= data.size();
    blocks += char(last) + little(part.size(), 2) + little(~part.size() & 0xFFFF, 2) + part;
    if (last)
      return blocks;
  }
}

inline std::string zlib_stream(const std::string &data)
{
  std::uint32_t a = 1, b = 0;
  for (const char c : data) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const std::uint32_t sum = b << 16 | a;
  const std::string check{char(sum >> 24), char(sum >> 16 & 0xFF), char(sum >> 8 & 0xFF), char(sum & 0xFF)};
  return "\x78\x01" + stored_blocks(data) + check;
}

/// CRC-32 of a zip archive, bit by bit.
inline std::uint32_t crc32_of(const std::string &data)
{
  std::uint32_t rest = 0xFFFFFFFF;
  for (const char c : data) {
    rest ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit)
      rest = rest >> 1 ^ (rest & 1 ? 0xEDB88320u : 0u);
  }
  return ~rest;
}

/// A variable as MATLAB saves it unless it is asked for another form.
inline std::string mat_compressed(const std::string &array)
{
  const std::string packed = zlib_stream(array);
  return little(15, 4) + little(packed.size(), 4) + packed;
}

inline std::string mat_file(const std::string &variables)
{
  std::string head = "MATLAB 5.0 MAT-file";
  head.resize(124, ' ');
  return head + little(0x0100, 2) + "IM" + variables;
}

/// One array as numpy saves it.
inline std::string npy(const std::vector<double> &values, const std::string &shape)
{
  std::string head = "{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + ", }";
  head.resize(117, ' ');
  return "\x93NUMPY" + std::string("\1\0", 2) + std::string("\x76\0", 2) + head + "\n" + doubles(values);
}

/// An archive of files that are deflated.
inline std::string zip(const std::vector<std::pair<std::string, std::string>> &files)
{
  std::string all, directory;
  for (const auto &[name, data] : files) {
    const std::string packed = stored_blocks(data);
    const std::string sizes =
        little(packed.size(), 4) + little(data.size(), 4) + little(name.size(), 2) + little(0, 2);
    const std::string offset = little(all.size(), 4);
    const std::string check  = little(crc32_of(data), 4);
    all += "PK\3\4" + little(20, 2) + little(0, 2) + little(8, 2) + little(0, 4) + check + sizes + name + packed;
    directory += "PK\1\2" + little(20, 2) + little(20, 2) + little(0, 2) + little(8, 2) + little(0, 4) + check +
                 sizes + little(0, 2) + little(0, 2) + little(0, 2) + little(0, 4) + offset + name;
  }
  return all + directory + "PK\5\6" + little(0, 4) + little(files.size(), 2) + little(files.size(), 2) +
         little(directory.size(), 4) + little(all.size(), 4) + little(0, 2);
}

/// PCM of 16 bit, the channels one after the other in each row.
inline std::string wav(const int rate, const std::vector<std::vector<int>> &channels)
{
  std::string data;
  for (std::size_t i = 0; i < channels.front().size(); ++i)
    for (const auto &channel : channels)
      data += little(std::uint64_t(std::int64_t(channel[i])), 2);
  const auto m             = channels.size();
  const std::string format = little(1, 2) + little(m, 2) + little(std::uint64_t(rate), 4) +
                             little(2 * m * std::uint64_t(rate), 4) + little(2 * m, 2) + little(16, 2);
  const std::string body = "WAVEfmt " + little(16, 4) + format + "data" + little(data.size(), 4) + data;
  return "RIFF" + little(body.size(), 4) + body;
}
}  // namespace mill::record_files
