#include "fem/cache/component_cache.h"
#include "core/records/cache_entry.h"
#include "fem/cache/archive.h"

namespace mill::fem {
namespace {
constexpr char component_kind[] = "millstand component 3";

// The same list of members is run through in both directions; one that is missing does not compile.
template <class Archive> void members(Archive &a, Component &c)
{
  auto &[name, source, interface, n_barrel, half_barrel, M, K, fixed_frequency, residual, axis_z, axis, mass,
         reach, elements_per_radius, surface] = c;
  a.text(name);
  a.text(source);
  a.texts(interface);
  a.count(n_barrel);
  a.count(elements_per_radius);
  for (double *value : {&half_barrel, &mass, &reach})
    a.number(*value);
  auto &[position, faces, displacement, stress] = surface;
  for (Eigen::MatrixXd *m : {&M, &K, &residual, &axis, &position, &faces, &displacement, &stress})
    a.array(*m);
  for (Eigen::VectorXd *v : {&fixed_frequency, &axis_z})
    a.array(*v);
}
}  // namespace

void save_component(const std::string &path, const std::string &key, const Component &component)
{
  Component copy = component;
  Writer writer;
  members(writer, copy);
  write_cache_entry(path, component_kind, key, writer.bytes);
}

std::optional<Component> load_component(const std::string &path, const std::string &key, std::string *note)
{
  const auto bytes = read_cache_entry(path, component_kind, key, note);
  if (!bytes)
    return std::nullopt;
  Component component;
  Reader reader{*bytes};
  members(reader, component);
  if (reader.good && reader.at == bytes->size())
    return component;
  if (note)
    *note = path + " is not used: it is incomplete";
  return std::nullopt;
}
}  // namespace mill::fem
