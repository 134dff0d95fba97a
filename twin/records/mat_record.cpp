#include "core/base/files.h"
#include "twin/records/binary_numbers.h"
#include "twin/records/channel_names.h"
#include <cmath>
#include <fmt/format.h>

// Numeric vectors of a MATLAB file of level 5, not compressed.
// Source: The MathWorks, MAT-File Format, level 5 (public description, 2019), chapter 1.
namespace mill::twin {
namespace {
constexpr std::size_t head_size = 128;
constexpr int compressed = 15, matrix = 14;

struct Element {
  int type         = 0;
  std::size_t size = 0;  // byte of data
  std::size_t data = 0;  // where they begin
  std::size_t next = 0;  // where the next element begins
};

struct Vector {
  std::string name;
  Eigen::VectorXd value;
};

class MatReader {
public:
  MatReader(const std::string &path) : file(path), bytes(read_text(path))
  {
    if (bytes.compare(0, 10, "MATLAB 7.3") == 0 || bytes.compare(0, 4, "\x89HDF") == 0)
      refuse("is a MATLAB file of version 7.3; save it with save('record.mat', '-v6')");
    if (bytes.size() < head_size || (bytes.compare(126, 2, "IM") != 0 && bytes.compare(126, 2, "MI") != 0))
      refuse("is no MATLAB file of level 5; save it with save('record.mat', '-v6')");
    big_endian = bytes.compare(126, 2, "MI") == 0;
  }

  std::vector<Vector> vectors()
  {
    std::vector<Vector> found;
    for (std::size_t at = head_size; at + 8 <= bytes.size();) {
      const Element element = element_at(at, bytes.size());
      if (element.type == compressed)
        refuse("is compressed; save it with save('record.mat', '-v6')");
      if (element.type == matrix)
        take(element, found);
      at = element.next;
    }
    return found;
  }

private:
  [[noreturn]] void refuse(const std::string &what) const
  {
    throw InputError(file + " " + what);
  }

  std::size_t word(const std::size_t at) const
  {
    return std::size_t(number_at(&bytes[at], {'u', 4, big_endian}));
  }

  Element element_at(const std::size_t at, const std::size_t end) const
  {
    if (at + 8 > end)
      refuse("ends inside a variable");
    Element element;
    const std::size_t tag = word(at);
    if (tag >> 16) {  // up to four byte, in the tag itself
      element = {int(tag & 0xFFFF), tag >> 16, at + 4, at + 8};
      if (element.size > 4)
        refuse("is damaged: a small element of more than four byte");
      return element;
    }
    element.type = int(tag);
    element.size = word(at + 4);
    element.data = at + 8;
    if (element.size > end - element.data)
      refuse("ends inside a variable; it was cut off while it was written or copied");
    const std::size_t padded = element.type == compressed ? element.size : (element.size + 7) / 8 * 8;
    element.next             = std::min(element.data + padded, end);
    return element;
  }

  // Types of numbers, table 1-1; nothing for others.
  static bool type_of(const int type, BinaryType &found)
  {
    switch (type) {
    case 1:
      found = {'i', 1, false};
      return true;
    case 2:
      found = {'u', 1, false};
      return true;
    case 3:
      found = {'i', 2, false};
      return true;
    case 4:
      found = {'u', 2, false};
      return true;
    case 5:
      found = {'i', 4, false};
      return true;
    case 6:
      found = {'u', 4, false};
      return true;
    case 7:
      found = {'f', 4, false};
      return true;
    case 9:
      found = {'f', 8, false};
      return true;
    case 12:
      found = {'i', 8, false};
      return true;
    case 13:
      found = {'u', 8, false};
      return true;
    default:
      return false;
    }
  }

  // A real numeric array of which one dimension is all there is.
  void take(const Element &array, std::vector<Vector> &found)
  {
    const std::size_t end = array.data + array.size;
    if (array.size == 0)
      return;
    const Element flags = element_at(array.data, end);
    if (flags.size < 8)
      return;
    const std::size_t flag = word(flags.data);
    const int array_class  = int(flag & 0xFF);
    const bool is_complex  = flag & 0x0800;
    if (array_class < 6 || array_class > 15 || is_complex)
      return;
    const Element dimensions = element_at(flags.next, end);
    double n = 1, largest = 0;
    for (std::size_t i = 0; i + 4 <= dimensions.size; i += 4) {
      const double size = number_at(&bytes[dimensions.data + i], {'i', 4, big_endian});
      n *= size;
      largest = std::max(largest, size);
    }
    const Element name = element_at(dimensions.next, end);
    const Element data = element_at(name.next, end);
    BinaryType type;
    if (!type_of(data.type, type) || n != largest || n < 1)
      return;
    type.big_endian = big_endian;
    if (n * double(type.size) > double(data.size))
      refuse("holds a variable with fewer numbers than its size says");
    Vector vector{bytes.substr(name.data, name.size), Eigen::VectorXd(Eigen::Index(n))};
    for (Eigen::Index i = 0; i < vector.value.size(); ++i)
      vector.value[i] = number_at(&bytes[data.data + std::size_t(i) * std::size_t(type.size)], type);
    found.push_back(std::move(vector));
  }

  std::string file, bytes;
  bool big_endian = false;
};

bool is_rate_name(const std::string &name)
{
  const std::string small = lower(name);
  return small == "fs" || small == "rate" || small == "sample_rate" || small == "samplerate";
}
}  // namespace

RawRecord read_mat_record(const std::string &path, const ReadOptions &options)
{
  RawRecord record;
  record.file   = path;
  record.format = "MATLAB 5";
  if (options.rate)
    record.rate = *options.rate;
  auto vectors         = MatReader(path).vectors();
  Eigen::Index longest = 0;
  for (const Vector &vector : vectors)
    longest = std::max(longest, vector.value.size());
  if (longest < 2)
    throw InputError(path + " holds no numeric vector; save the channels as vectors of numbers with "
                            "save('record.mat', '-v6')");
  for (Vector &vector : vectors) {
    if (vector.value.size() == 1 && is_rate_name(vector.name) && !options.rate)
      record.rate = vector.value[0];
    else if (vector.value.size() != longest)
      record.notes.push_back(
          fmt::format("'{}' has {} numbers, not {}, and was not used", vector.name, vector.value.size(), longest));
    else if (is_time_name(vector.name) && !options.rate)
      record.time = vector.value.array() - vector.value[0];
    else if (!is_time_name(vector.name))
      record.channels.push_back(channel_of(head_of(vector.name), {path, 0, 0}, options, std::move(vector.value)));
  }
  record.time_place = {path, 0, 0};
  if (record.time.size() == 0 && !(record.rate > 0))
    throw InputError(path +
                     " holds neither a vector 'time' in seconds nor a number 'fs'; give the samples per second "
                     "with --rate 20000");
  require_usable_channels(record, "name it, for example --unit upper_work_roll=g");
  return record;
}
}  // namespace mill::twin
