#include "fem/cache/roll_cache.h"
#include "core/records/cache_entry.h"
#include "fem/cache/archive.h"

namespace mill::fem {
namespace {
constexpr char roll_kind[] = "millstand condensed roll 3";

// The same list of members is run through in both directions.  A structured binding takes apart the whole struct:
// a member that is added to it does not compile until it is named here.
template <class Archive> void members(Archive &a, CaseFlexibility &p)
{
  auto &[patch, traction, axis, seat_patch, seat_axis, field] = p;
  for (Eigen::MatrixXd *m : {&patch, &traction, &axis, &field})
    a.array(*m);
  for (Eigen::VectorXd *v : {&seat_patch, &seat_axis})
    a.array(*v);
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

template <class Archive> void members(Archive &a, CondensedRoll &r)
{
  auto &[geometry, grid, axis_z, symmetric, antisymmetric, symmetric_odd, antisymmetric_odd, seat_lever,
         n_unknowns, field_mesh, factor_bytes, factor_flops] = r;
  numbers(a, geometry);
  for (double *value : {&seat_lever, &factor_bytes, &factor_flops})
    a.number(*value);
  auto &[n_x, n_z, x, z, area, degree, whole] = grid;
  for (int *value : {&n_x, &n_z, &degree, &n_unknowns})
    a.count(*value);
  for (Eigen::VectorXd *v : {&x, &z, &area, &axis_z})
    a.array(*v);
  for (CaseFlexibility *p : {&symmetric, &antisymmetric, &symmetric_odd, &antisymmetric_odd})
    members(a, *p);
  a.text(field_mesh);
}

template <class Archive> void members(Archive &a, HarmonicResponse &h)
{
  auto &[surface, axis, seat_surface, seat_axis, point_surface, point_axis, point_point] = h;
  members(a, surface);
  for (Eigen::MatrixXd *m : {&axis, &point_surface, &point_axis, &point_point})
    a.array(*m);
  for (Eigen::VectorXd *v : {&seat_surface, &seat_axis})
    a.array(*v);
}

template <class Archive> void members(Archive &a, FourierRoll &r)
{
  auto &[geometry, material, edge, order, even, odd, half_width, seat_lever, points, n_unknowns] = r;
  numbers(a, geometry);
  numbers(a, material);
  for (double *value : {&half_width, &seat_lever})
    a.number(*value);
  a.count(n_unknowns);
  a.array(edge);
  a.array(points);
  Eigen::VectorXd orders(Eigen::Index(order.size()));
  for (Eigen::Index i = 0; i < orders.size(); ++i)
    orders[i] = order[std::size_t(i)];
  a.array(orders);
  if (!(orders.size() == 0 || orders.cwiseAbs().maxCoeff() < 1e6) || orders.hasNaN())
    return a.fail();
  order.resize(std::size_t(orders.size()));
  for (Eigen::Index i = 0; i < orders.size(); ++i)
    order[std::size_t(i)] = int(orders[i]);
  members(a, even);
  members(a, odd);
}

template <class Archive> void members(Archive &a, PatchGrid &grid)
{
  auto &[n_x, n_z, x, z, area, degree, whole] = grid;
  for (int *value : {&n_x, &n_z, &degree})
    a.count(*value);
  for (Eigen::VectorXd *v : {&x, &z, &area})
    a.array(*v);
}

template <class Archive> void members(Archive &a, RollerSetup &s)
{
  auto &[diameter, length, contact_length, inner_radius, outer_radius, inner_depth, outer_depth, land, material,
         largest_load, finest_load, elements_per_half_width, end_element, largest_element] = s;
  for (double *value :
       {&diameter, &length, &contact_length, &inner_radius, &outer_radius, &inner_depth, &outer_depth, &land})
    a.number(*value);
  numbers(a, material);
  for (double *value : {&largest_load, &finest_load, &elements_per_half_width, &end_element, &largest_element})
    a.number(*value);
}

template <class Archive> void members(Archive &a, CondensedRoller &r)
{
  auto &[setup, grid, symmetric, antisymmetric, inner, outer, n_unknowns, factor_bytes] = r;
  members(a, setup);
  a.number(factor_bytes);
  members(a, grid);
  grid.whole = true;
  for (CondensedRoller::Parities *p : {&symmetric, &antisymmetric, &inner, &outer})
    for (Eigen::MatrixXd *m : {&p->even, &p->odd})
      a.array(*m);
  a.count(n_unknowns);
}

template <class Archive> void members(Archive &a, bearing::RingFlexibility &f)
{
  auto &[rows, modes, inner, outer, chock_harmonics, chock_cosine, chock_sine] = f;
  for (int *value : {&rows, &modes, &chock_harmonics})
    a.count(*value);
  members(a, inner);
  members(a, outer);
  a.array(chock_cosine);
  a.array(chock_sine);
}

template <class Archive> void members(Archive &a, RingResult &r)
{
  auto &[flexibility, companion, error_estimate, chock_difference, truncated, indefinite, n_section_unknowns,
         n_chock_unknowns, notes] = r;
  members(a, flexibility);
  members(a, companion);
  for (int *value : {&n_section_unknowns, &n_chock_unknowns})
    a.count(*value);
  for (double *value : {&error_estimate, &chock_difference, &truncated, &indefinite})
    a.number(*value);
  a.texts(notes);
}

template <class Roll> void save(const std::string &path, const std::string &key, const Roll &roll)
{
  Writer writer;
  members(writer, const_cast<Roll &>(roll));  // only read: Writer takes constant references
  write_cache_entry(path, roll_kind, key, writer.bytes);
}

template <class Roll> std::optional<Roll> load(const std::string &path, const std::string &key, std::string *note)
{
  const auto bytes = read_cache_entry(path, roll_kind, key, note);
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
