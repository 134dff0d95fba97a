#include "fem/component_cache.h"
#include "core/files.h"
#include <cstring>
#include <filesystem>

namespace mill::fem {
namespace {
constexpr char magic[] = "millstand component 1\n";

// The same list of members is run through in both directions.
template <class Archive> void members(Archive &a, Component &c)
{
  a.text(c.name);
  a.text(c.source);
  a.texts(c.interface);
  a.count(c.n_barrel);
  for (double *value : {&c.half_barrel, &c.mass, &c.reach})
    a.number(*value);
  for (Eigen::MatrixXd *m : {&c.M, &c.K, &c.residual, &c.axis})
    a.array(*m);
  for (Eigen::VectorXd *v : {&c.fixed_frequency, &c.axis_z})
    a.array(*v);
}

struct Writer {
  std::string bytes;
  void raw(const void *data, const std::size_t size)
  {
    bytes.append(static_cast<const char *>(data), size);
  }
  void number(const double value)
  {
    raw(&value, sizeof value);
  }
  void count(const int value)
  {
    number(value);
  }
  void text(const std::string &value)
  {
    count(int(value.size()));
    bytes += value;
  }
  void texts(const std::vector<std::string> &list)
  {
    count(int(list.size()));
    for (const std::string &value : list)
      text(value);
  }
  template <class Array> void array(const Array &values)
  {
    count(int(values.rows()));
    count(int(values.cols()));
    raw(values.data(), sizeof(double) * std::size_t(values.size()));
  }
};

struct Reader {
  const std::string &bytes;
  std::size_t at = 0;
  bool good      = true;
  void raw(void *data, const std::size_t size)
  {
    good = good && size <= bytes.size() - at;
    if (!good)
      return;
    std::memcpy(data, bytes.data() + at, size);
    at += size;
  }
  void number(double &value)
  {
    raw(&value, sizeof value);
  }
  void count(int &value)
  {
    double exact = 0;
    number(exact);
    good  = good && exact >= 0 && exact <= double(bytes.size());
    value = good ? int(exact) : 0;
  }
  void text(std::string &value)
  {
    int length = 0;
    count(length);
    value.assign(std::size_t(length), ' ');
    raw(value.data(), value.size());
  }
  void texts(std::vector<std::string> &list)
  {
    int n = 0;
    count(n);
    list.assign(std::size_t(n), "");
    for (std::string &value : list)
      text(value);
  }
  template <class Array> void array(Array &values)
  {
    int rows = 0, cols = 0;
    count(rows);
    count(cols);
    good = good && std::size_t(rows) * std::size_t(cols) <= bytes.size() / sizeof(double);
    if (!good)
      return;
    values.resize(rows, cols);
    raw(values.data(), sizeof(double) * std::size_t(values.size()));
  }
};
}  // namespace

void save_component(const std::string &path, const std::string &key, const Component &component)
{
  Component copy = component;
  Writer writer;
  members(writer, copy);
  write_atomically(path, magic + key + "\n" + hash_of(writer.bytes) + "\n" + writer.bytes);
}

std::optional<Component> load_component(const std::string &path, const std::string &key, std::string *note)
{
  if (!std::filesystem::exists(path))
    return {};
  const auto refused = [&](const char *why) {
    if (note)
      *note = path + " is not used: " + why;
    return std::nullopt;
  };
  const std::string text    = read_text(path);
  const std::size_t head    = std::strlen(magic);
  const std::size_t key_end = text.size() < head ? std::string::npos : text.find('\n', head);
  const std::size_t sum_end = key_end == std::string::npos ? key_end : text.find('\n', key_end + 1);
  if (sum_end == std::string::npos || text.compare(0, head, magic) != 0)
    return refused("it is no component of this version");
  if (text.substr(head, key_end - head) != key)
    return refused("it belongs to other inputs");
  const std::string bytes = text.substr(sum_end + 1);
  if (hash_of(bytes) != text.substr(key_end + 1, sum_end - key_end - 1))
    return refused("its checksum is wrong");
  Component component;
  Reader reader{bytes};
  members(reader, component);
  if (!reader.good || reader.at != bytes.size())
    return refused("it is incomplete");
  return component;
}
}  // namespace mill::fem
