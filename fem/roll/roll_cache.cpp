#include "fem/roll/roll_cache.h"
#include "core/records/cache_entry.h"
#include "fem/body/archive.h"

namespace mill::fem {
namespace {
constexpr char kind[] = "millstand condensed roll 2";

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
  a.text(r.field_mesh);
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

template <class Archive> void members(Archive &a, PatchGrid &grid)
{
  for (int *value : {&grid.n_x, &grid.n_z, &grid.degree})
    a.count(*value);
  for (Eigen::VectorXd *v : {&grid.x, &grid.z, &grid.area})
    a.array(*v);
}

template <class Archive> void members(Archive &a, CondensedRoller &r)
{
  RollerSetup &s = r.setup;
  for (double *value : {&s.diameter, &s.length, &s.contact_length, &s.inner_radius, &s.outer_radius,
                        &s.inner_depth, &s.outer_depth, &s.land, &s.material.youngs_modulus,
                        &s.material.poisson_ratio, &s.material.density, &s.largest_load, &s.finest_load,
                        &s.elements_per_half_width, &s.end_element, &s.largest_element, &r.factor_bytes})
    a.number(*value);
  members(a, r.grid);
  r.grid.whole = true;
  for (CondensedRoller::Parities *p : {&r.squeeze, &r.translate, &r.inner, &r.outer})
    for (Eigen::MatrixXd *m : {&p->even, &p->odd})
      a.array(*m);
  a.count(r.n_unknowns);
}

template <class Archive> void members(Archive &a, std::vector<Eigen::MatrixXd> &list)
{
  int n = int(list.size());
  a.count(n);
  if (n < 0 || n > 100000)
    return a.fail();
  list.resize(std::size_t(n));
  for (Eigen::MatrixXd &m : list)
    a.array(m);
}

template <class Archive> void members(Archive &a, bearing::RingFlexibility &f)
{
  for (int *value : {&f.rows, &f.modes, &f.chock_harmonics})
    a.count(*value);
  members(a, f.inner);
  members(a, f.outer);
  a.array(f.chock_cosine);
  a.array(f.chock_sine);
}

template <class Archive> void members(Archive &a, RingResult &r)
{
  members(a, r.flexibility);
  members(a, r.companion);
  for (int *value : {&r.n_section_unknowns, &r.n_chock_unknowns})
    a.count(*value);
  for (double *value : {&r.error_estimate, &r.chock_difference, &r.truncated, &r.indefinite})
    a.number(*value);
  a.texts(r.notes);
}

template <class Roll> void save(const std::string &path, const std::string &key, const Roll &roll)
{
  Writer writer;
  members(writer, const_cast<Roll &>(roll));  // only read: Writer takes constant references
  write_cache_entry(path, kind, key, writer.bytes);
}

template <class Roll> std::optional<Roll> load(const std::string &path, const std::string &key, std::string *note)
{
  const auto bytes = read_cache_entry(path, kind, key, note);
  if (!bytes)
    return std::nullopt;
  Roll roll;
  Reader reader{*bytes};
  members(reader, roll);
  if (reader.good && reader.at == bytes->size())
    return roll;
  if (note)
    *note = path + " is not used: it is incomplete";
  return std::nullopt;
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
void save_roller(const std::string &path, const std::string &key, const CondensedRoller &roller)
{
  save(path, key, roller);
}
void save_rings(const std::string &path, const std::string &key, const RingResult &rings)
{
  save(path, key, rings);
}
std::optional<CondensedRoller> load_roller(const std::string &path, const std::string &key, std::string *note)
{
  return load<CondensedRoller>(path, key, note);
}
std::optional<RingResult> load_rings(const std::string &path, const std::string &key, std::string *note)
{
  return load<RingResult>(path, key, note);
}
}  // namespace mill::fem
