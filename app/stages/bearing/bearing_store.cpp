#include "app/stages/bearing/bearing_store.h"
#include "core/records/cache_entry.h"
#include "core/records/record_text.h"
#include "fem/cache/archive.h"

namespace mill {
namespace {
// Raised by hand when the equilibrium of a bearing changes what it computes.
constexpr const char *equilibrium_version = "bearing 1", *bearing_kind = "millstand bearing 1";

// An array whose size or type the archive does not take.
template <class Archive, class Array> void converted(Archive &a, Array &array)
{
  Eigen::MatrixXd exact = array.template cast<double>();
  a.array(exact);
  const bool fits = (Array::RowsAtCompileTime == Eigen::Dynamic || exact.rows() == Array::RowsAtCompileTime) &&
                    (Array::ColsAtCompileTime == Eigen::Dynamic || exact.cols() == Array::ColsAtCompileTime);
  if (fits)
    array = exact.cast<typename Array::Scalar>();
  else
    a.fail();
}

template <class Archive> void bearing_members(Archive &a, bearing::AssemblyState &s)
{
  converted(a, s.motion);
  converted(a, s.load);
  converted(a, s.tangent);
  converted(a, s.loaded_rollers);
  for (Eigen::MatrixXd *m : {&s.roller_load, &s.roller_moment, &s.roller_approach, &s.roller_tangent,
                             &s.slice_load, &s.inner_load, &s.rib_force})
    a.array(*m);
  for (Eigen::VectorXd *v : {&s.row_radial, &s.row_axial, &s.row_share, &s.azimuth, &s.ring_motion})
    a.array(*v);
  a.count(s.iterations);
  a.number(s.residual);
}

template <class Archive> void bearing_members(Archive &a, std::vector<bearing::AssemblyState> &list)
{
  int n = int(list.size());
  a.count(n);
  if (n < 0 || n > 100000)
    return a.fail();
  list.resize(std::size_t(n));
  for (auto &state : list)
    bearing_members(a, state);
}

template <class Archive> void bearing_members(Archive &a, SolvedBearing &s)
{
  for (auto *list : {&s.curve, &s.standard_curve, &s.rigid_curve, &s.companions, &s.supports, &s.arrangements})
    bearing_members(a, *list);
  for (auto *state : {&s.at, &s.standard, &s.rigid, &s.palmgren})
    bearing_members(a, *state);
  a.number(s.slice_deviation);
}
}  // namespace

std::string bearing_inputs_text(const BearingQuestion &q, const double largest_load)
{
  return record_text(equilibrium_version, roller_inputs(q.bearing, largest_load), ring_inputs(q.bearing),
                     q.bearing, q.radial, q.axial, q.tilt, q.cage_angle, q.loads, q.axial_displacement, q.moment,
                     q.centrifugal);
}

void save_bearing(const std::string &path, const std::string &key, const SolvedBearing &solved)
{
  fem::Writer writer;
  bearing_members(writer, const_cast<SolvedBearing &>(solved));  // only read: Writer takes constant references
  write_cache_entry(path, bearing_kind, key, writer.bytes);
}

std::optional<SolvedBearing> load_bearing(const std::string &path, const std::string &key, std::string *note)
{
  const auto bytes = read_cache_entry(path, bearing_kind, key, note);
  if (!bytes)
    return std::nullopt;
  SolvedBearing solved;
  fem::Reader reader{*bytes};
  bearing_members(reader, solved);
  if (reader.good && reader.at == bytes->size())
    return solved;
  if (note)
    *note = path + " is not used: it is incomplete";
  return std::nullopt;
}
}  // namespace mill
