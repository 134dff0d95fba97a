#include "fem/component_cache.h"
#include "core/files.h"
#include "fem/archive.h"
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
