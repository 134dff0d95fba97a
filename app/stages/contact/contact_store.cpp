#include "app/stages/contact/contact_store.h"
#include "app/stages/contact/contact_stage.h"
#include "core/model/four_high.h"
#include "core/records/cache_entry.h"
#include "core/records/record_text.h"
#include "fem/cache/archive.h"
#include <utility>

namespace mill {
namespace {
// Raised by hand when the solution of a contact changes what it computes.
constexpr const char *contact_stage_version = "contact 3", *kind = "millstand contact 3";

template <class Archive, class Vector> void integers(Archive &a, Vector &v)
{
  Eigen::VectorXd exact(Eigen::Index(v.size()));
  for (Eigen::Index i = 0; i < exact.size(); ++i)
    exact[i] = v[typename Vector::size_type(i)];
  a.array(exact);
  v.resize(typename Vector::size_type(exact.size()));
  for (Eigen::Index i = 0; i < exact.size(); ++i)
    v[typename Vector::size_type(i)] = typename Vector::value_type(exact[i]);
}

template <class Archive> void members(Archive &a, ContactCurve &c)
{
  a.text(c.name);
  a.text(c.reference);
  for (Eigen::VectorXd *v : {&c.load, &c.approach, &c.half_width, &c.peak_pressure, &c.tangent, &c.secant})
    a.array(*v);
  std::vector<int> iterations(c.iterations.data(), c.iterations.data() + c.iterations.size());
  integers(a, iterations);
  c.iterations = Eigen::Map<const Eigen::VectorXi>(iterations.data(), Eigen::Index(iterations.size()));
  a.number(c.residual);
}

template <class Archive> void members(Archive &a, BarrelProfile &p)
{
  a.number(p.load);
  for (Eigen::VectorXd *v : {&p.z, &p.line_load, &p.approach, &p.tangent, &p.half_width, &p.peak_pressure})
    a.array(*v);
}

template <class Archive> void members(Archive &a, fem::ContactPoint &p)
{
  contact::State &s = p.state;
  for (Eigen::VectorXd *v : {&s.motion, &s.resultant, &s.nodal, &s.gap})
    a.array(*v);
  for (Eigen::MatrixXd *m : {&s.compliance, &s.stiffness, &s.d_nodal, &p.compliance})
    a.array(*m);
  integers(a, s.active);
  a.count(s.iterations);
  for (double *x : {&s.residual, &p.load, &p.approach, &p.tangent, &p.tilt, &p.moment})
    a.number(*x);
}

template <class Archive> void members(Archive &a, Eigen::MatrixXd &m)
{
  a.array(m);
}

// A map by its pairs; key(name) runs through one of its keys.
template <class Archive, class Map, class Key> void pairs(Archive &a, Map &map, const Key &key)
{
  std::vector<std::pair<typename Map::key_type, typename Map::mapped_type>> list(map.begin(), map.end());
  int n = int(list.size());
  a.count(n);
  if (n < 0 || n > 10000)
    return a.fail();
  list.resize(std::size_t(n));
  for (auto &[name, value] : list) {
    key(name);
    members(a, value);
  }
  map = Map(list.begin(), list.end());
}

template <class Archive> void members(Archive &a, fem::SolvedLoads::Known &k)
{
  pairs(a, k.points, [&](double &load) { a.number(load); });
  pairs(a, k.numbers, [&](std::string &name) { a.text(name); });
}

// A matrix that may be zero throughout, as the motion of axes that stay straight.
template <class Archive> void zero_or_full(Archive &a, Eigen::MatrixXd &m)
{
  int rows = int(m.rows()), cols = int(m.cols()), full = m.size() > 0 && !m.isZero(0) ? 1 : 0;
  for (int *count : {&rows, &cols, &full})
    a.count(*count);
  if (rows < 0 || cols < 0 || rows > 1000000 || cols > 1000000)
    return a.fail();
  if (full)
    return a.array(m);
  m = Eigen::MatrixXd::Zero(rows, cols);
}

template <class Archive> void members(Archive &a, fem::ContactPair &p)
{
  a.text(p.name);
  a.text(p.reference);
  int whole = p.grid.whole ? 1 : 0;
  for (int *value : {&p.grid.n_x, &p.grid.n_z, &p.grid.degree, &whole})
    a.count(*value);
  p.grid.whole = whole == 1;
  for (Eigen::VectorXd *v : {&p.grid.x, &p.grid.z, &p.grid.area, &p.path, &p.drop})
    a.array(*v);
  zero_or_full(a, p.axis);
  zero_or_full(a, p.axis_support);
  a.array(p.mean);
  for (double *value : {&p.radii_sum, &p.multiplicity, &p.axial_mirror, &p.tilt, &p.load_offset})
    a.number(*value);
}

template <class Archive, class List, class Each> void list(Archive &a, List &all, const Each &each)
{
  int n = int(all.size());
  a.count(n);
  if (n < 0 || n > 100)
    return a.fail();
  all.resize(std::size_t(n));
  for (auto &one : all)
    each(one);
}

template <class Archive> void members(Archive &a, SolvedStudy &s)
{
  for (ContactCurve *curve : {&s.mirrored, &s.in_stand, &s.coarse, &s.in_stand_coarse})
    members(a, *curve);
  int has_second = s.second ? 1 : 0;
  a.count(has_second);
  if (has_second == 1) {
    SecondEngine second = s.second.value_or(SecondEngine());
    members(a, second.mirrored);
    members(a, second.in_stand);
    members(a, second.mirrored_at);
    members(a, second.in_stand_at);
    s.second = second;
  }
  const auto visit = [&](auto &one) { members(a, one); };
  list(a, s.known, visit);
  list(a, s.pairs, visit);
  list(a, s.fields, [&](std::string &text) { a.text(text); });
}
}  // namespace

std::string contact_inputs(const FourHigh &stand, const std::string &name, const ContactSettings &settings,
                           const std::vector<double> &loads)
{
  const auto range       = swept_range(name, settings, loads);
  const PlannedPair plan = planned_rolls(stand, settings, range[1], first_reach);
  std::string rolls;
  for (const PlannedRoll *roll : {&plan.backup, &plan.work})
    for (const bool companion : {false, true})
      rolls += roll_inputs(roll->geometry, roll->size, stand.steel, plan.wanted, companion);
  return record_text(contact_stage_version, name, rolls, at_rest(stand.steel), stand.work_roll, stand.backup_roll,
                     stand.strip.width, settings, loads);
}

void save_study(const std::string &path, const std::string &key, const SolvedStudy &study)
{
  fem::Writer writer;
  members(writer, const_cast<SolvedStudy &>(study));  // only read: Writer takes constant references
  write_cache_entry(path, kind, key, writer.bytes);
}

std::optional<SolvedStudy> load_study(const std::string &path, const std::string &key, std::string *note)
{
  const auto bytes = read_cache_entry(path, kind, key, note);
  if (!bytes)
    return std::nullopt;
  SolvedStudy study;
  fem::Reader reader{*bytes};
  members(reader, study);
  if (reader.good && reader.at == bytes->size() && study.pairs.size() == study.known.size())
    return study;
  if (note)
    *note = path + " is not used: it is incomplete";
  return std::nullopt;
}
}  // namespace mill
