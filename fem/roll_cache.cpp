#include "fem/roll_cache.h"
#include "core/files.h"
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace mill::fem {
namespace {
constexpr char magic[] = "millstand condensed roll 2\n";

// The same list of members is run through in both directions.
template <class Archive> void members(Archive &a, ParityFlexibility &p)
{
  for (Eigen::MatrixXd *m : {&p.patch, &p.traction, &p.axis, &p.field})
    a.array(*m);
  for (Eigen::VectorXd *v : {&p.seat_patch, &p.seat_axis})
    a.array(*v);
}

template <class Archive> void members(Archive &a, CondensedRoll &r)
{
  RollGeometry &g = r.geometry;
  for (double *value : {&g.radius, &g.half_length, &g.neck_radius, &g.neck_length, &g.seat_centre,
                        &g.contact_half_length, &r.seat_lever, &r.factor_bytes, &r.factor_flops})
    a.number(*value);
  for (int *value : {&r.grid.n_x, &r.grid.n_z, &r.grid.degree, &r.n_unknowns})
    a.count(*value);
  for (Eigen::VectorXd *v : {&r.grid.x, &r.grid.z, &r.grid.area, &r.axis_z})
    a.array(*v);
  for (ParityFlexibility *p : {&r.squeeze, &r.translate, &r.squeeze_odd, &r.translate_odd})
    members(a, *p);
}

template <class Archive> void members(Archive &a, HarmonicResponse &h)
{
  int orders = int(h.surface.size());
  a.count(orders);
  if (orders < 0 || orders > 100000)
    return a.fail();
  h.surface.resize(std::size_t(orders));
  for (Eigen::MatrixXd &m : h.surface)
    a.array(m);
  a.array(h.axis);
  for (Eigen::VectorXd *v : {&h.seat_surface, &h.seat_axis})
    a.array(*v);
}

template <class Archive> void members(Archive &a, FourierRoll &r)
{
  RollGeometry &g = r.geometry;
  for (double *value :
       {&g.radius, &g.half_length, &g.neck_radius, &g.neck_length, &g.seat_centre, &g.contact_half_length,
        &r.material.youngs_modulus, &r.material.poisson_ratio, &r.material.density, &r.half_width, &r.seat_lever})
    a.number(*value);
  a.count(r.n_unknowns);
  a.array(r.edge);
  Eigen::VectorXd orders(Eigen::Index(r.order.size()));
  for (Eigen::Index i = 0; i < orders.size(); ++i)
    orders[i] = r.order[std::size_t(i)];
  a.array(orders);
  r.order.resize(std::size_t(orders.size()));
  for (Eigen::Index i = 0; i < orders.size(); ++i)
    r.order[std::size_t(i)] = int(orders[i]);
  members(a, r.even);
  members(a, r.odd);
}

struct Writer {
  std::string bytes;
  void fail() {}
  void raw(const void *data, const std::size_t size)
  {
    bytes.append(static_cast<const char *>(data), size);
  }
  void number(const double &value)
  {
    raw(&value, sizeof value);
  }
  void count(const int &value)
  {
    const double exact = value;
    raw(&exact, sizeof exact);
  }
  template <class Array> void array(const Array &array)
  {
    count(int(array.rows()));
    count(int(array.cols()));
    raw(array.data(), sizeof(double) * std::size_t(array.size()));
  }
};

struct Reader {
  const std::string &bytes;
  std::size_t at = 0;
  bool good      = true;
  void fail()
  {
    good = false;
  }
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
    raw(&exact, sizeof exact);
    value = int(exact);
  }
  template <class Array> void array(Array &array)
  {
    int rows = 0, cols = 0;
    count(rows);
    count(cols);
    good =
        good && rows >= 0 && cols >= 0 && std::size_t(rows) * std::size_t(cols) <= bytes.size() / sizeof(double);
    if (!good)
      return;
    array.resize(rows, cols);
    raw(array.data(), sizeof(double) * std::size_t(array.size()));
  }
};
template <class Roll> void save(const std::string &path, const std::string &key, const Roll &roll)
{
  Writer writer;
  members(writer, const_cast<Roll &>(roll));  // only read: Writer takes constant references
  write_atomically(path, magic + key + "\n" + hash_of(writer.bytes) + "\n" + writer.bytes);
}

template <class Roll> std::optional<Roll> load(const std::string &path, const std::string &key, std::string *note)
{
  if (!std::filesystem::exists(path))
    return {};
  const std::string text = read_text(path);
  const std::size_t head = std::strlen(magic), key_end = text.find('\n', head);
  const std::size_t sum_end = key_end == std::string::npos ? key_end : text.find('\n', key_end + 1);
  const auto damaged        = [&](const char *why) {
    if (note)
      *note = path + " is not used: " + why;
    return std::nullopt;
  };
  if (text.compare(0, head, magic) != 0 || sum_end == std::string::npos)
    return damaged("it is no condensed roll of this version");
  if (text.substr(head, key_end - head) != key)
    return damaged("it belongs to other inputs");
  const std::string bytes = text.substr(sum_end + 1);
  if (hash_of(bytes) != text.substr(key_end + 1, sum_end - key_end - 1))
    return damaged("its checksum is wrong");
  Roll roll;
  Reader reader{bytes};
  members(reader, roll);
  if (!reader.good || reader.at != bytes.size())
    return damaged("it is incomplete");
  return roll;
}
}  // namespace

void save_roll(const std::string &path, const std::string &key, const CondensedRoll &roll)
{
  save(path, key, roll);
}
void save_roll(const std::string &path, const std::string &key, const FourierRoll &roll)
{
  save(path, key, roll);
}
std::optional<CondensedRoll> load_roll(const std::string &path, const std::string &key, std::string *note)
{
  return load<CondensedRoll>(path, key, note);
}
std::optional<FourierRoll> load_fourier_roll(const std::string &path, const std::string &key, std::string *note)
{
  return load<FourierRoll>(path, key, note);
}
}  // namespace mill::fem
