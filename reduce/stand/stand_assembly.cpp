#include "reduce/stand/stand_assembly.h"
#include "core/base/short_number.h"
#include "core/records/stand_place.h"
#include "reduce/chain/film_in_series.h"
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace mill::reduce {
namespace {
enum { upper_backup, upper_work, lower_work, lower_backup };

double series(const double a, const double b)
{
  return 1 / (1 / a + 1 / b);
}

void require(const std::string &key, const double value, const char *unit)
{
  if (!(value > 0))
    throw InputError(key + " = " + short_number(value) + " " + unit + ": must be positive");
}

/// Point between two places of a load path without mass, which is interpolated.
struct Stop {
  std::string part, point;  ///< name of the part and of its point
  double mass = 0;          ///< kg
};

/// Fills a StandModel part by part.
class Assembly {
public:
  Assembly(const std::string &name, const Eigen::Index n)
  {
    s.name     = name;
    s.M        = Eigen::MatrixXd::Zero(n, n);
    s.K_parts  = Eigen::MatrixXd::Zero(n, n);
    s.b        = Eigen::VectorXd::Zero(n);
    s.residual = Eigen::MatrixXd::Zero(n, n);
    s.part_of.assign(std::size_t(n), -1);
  }

  /// A body in the next unknowns; returns the first.
  Eigen::Index add_body(const std::string &part, const Eigen::MatrixXd &M, const Eigen::MatrixXd &K,
                        const std::vector<StandUnknown> &unknowns, const Eigen::MatrixXd &residual = {})
  {
    const Eigen::Index first = next_, n = M.rows();
    s.M.block(first, first, n, n)       = M;
    s.K_parts.block(first, first, n, n) = K;
    if (residual.rows() == n)
      s.residual.block(first, first, n, n) = residual;
    std::fill_n(s.part_of.begin() + first, n, int(s.parts.size()));
    s.parts.push_back(part);
    s.unknowns.insert(s.unknowns.end(), unknowns.begin(), unknowns.end());
    next_ += n;
    return first;
  }

  Eigen::VectorXd add_mass(const std::string &part, const double mass)
  {
    return unit(
        add_body(part, Eigen::MatrixXd::Constant(1, 1, mass), Eigen::MatrixXd::Zero(1, 1), {StandUnknown{}}));
  }

  void add_spring(const std::string &name, const double stiffness, const Eigen::VectorXd &row,
                  const double damper = 0)
  {
    s.connections.push_back({name, row.transpose(), Eigen::VectorXd::Constant(1, stiffness)});
    s.connections.back().damper = damper;
  }

  Eigen::VectorXd unit(const Eigen::Index i) const
  {
    return Eigen::VectorXd::Unit(s.M.rows(), i);
  }

  StandModel s;

private:
  Eigen::Index next_ = 0;
};

/// Rolls in place, with what reads them.
struct Placed {
  const RollBody *body;
  Eigen::Index first;
};

Eigen::VectorXd in_place(const Assembly &a, const Placed &roll, const Eigen::VectorXd &row)
{
  Eigen::VectorXd whole                 = Eigen::VectorXd::Zero(a.s.M.rows());
  whole.segment(roll.first, row.size()) = row;
  return whole;
}

Placed place(Assembly &a, const RollBody &roll, const double seat_mass)
{
  const Eigen::MatrixXd M = roll.M + seat_mass * roll.seat * roll.seat.transpose();
  return {&roll, a.add_body(roll.name, M, roll.K, roll.unknowns, roll.residual)};
}

/// Springs between two barrels (or of the bite), evenly over 0..half_length of both sides.
Connection foundation(const Assembly &a, const std::string &name, const Placed &above, const Placed &below,
                      const double stiffness, const double half_length)
{
  const LinePoints points = line_points(*above.body, *below.body, half_length);
  Connection c{name, Eigen::MatrixXd::Zero(points.z.size(), a.s.M.rows()), stiffness * points.share};
  c.rows.middleCols(above.first, above.body->M.rows()) = barrel_rows(*above.body, points.z);
  c.rows.middleCols(below.first, below.body->M.rows()) = -barrel_rows(*below.body, points.z);
  return c;
}

/// The oil films of a backup roll, a part of the spring behind it.
struct Film {
  double stiffness = 0, damper = 0;  ///< N/m, N s/m
  double frequency = 0;              ///< Hz
  SpringAndDamper joined(const double spring) const
  {
    if (!(damper > 0) || !(stiffness > spring))
      return {spring, 0};
    return equivalent_in_series(1 / (1 / spring - 1 / stiffness), {stiffness, damper}, frequency);
  }
};

/// From `start` through springs and stops to `end`; a stop without mass gets no unknown.
/// springs.size() == stops.size() + 1; names as the springs'.
/// @param film  a part of the last spring; without damper: none
void add_path(Assembly &a, Eigen::VectorXd start, const Eigen::VectorXd &end,
              const std::vector<std::pair<std::string, double>> &springs, const std::vector<Stop> &stops,
              const Film &film)
{
  std::string name;
  double compliance = 0;
  std::vector<std::pair<std::string, double>> waiting;  // points without mass, compliance from start to them
  for (std::size_t i = 0; i < springs.size(); ++i) {
    name += (name.empty() ? "" : series_mark) + springs[i].first;
    compliance += 1 / springs[i].second;
    const bool last = i == stops.size();
    if (!last && !(stops[i].mass > 0)) {
      waiting.emplace_back(stops[i].point, compliance);
      continue;
    }
    const Eigen::VectorXd here = last ? end : a.add_mass(stops[i].part, stops[i].mass);
    const SpringAndDamper k    = last ? film.joined(1 / compliance) : SpringAndDamper{1 / compliance};
    a.add_spring(name, k.stiffness, here - start, k.damper);
    for (const auto &[point, part] : waiting)
      a.s.points.push_back({point, start + part / compliance * (here - start)});
    if (!last)
      a.s.points.push_back({stops[i].point, here});
    waiting.clear();
    name.clear();
    compliance = 0;
    start      = here;
  }
}

Eigen::Index interface_of(const Component &housing, const std::string &name)
{
  const auto match = std::find(housing.interface.begin(), housing.interface.end(), name);
  if (match == housing.interface.end())
    throw InputError("component \"" + housing.name +
                     "\" cannot be the housing: it has no interface displacement \"" + name + "\"");
  return match - housing.interface.begin();
}

double lower_seat_stiffness(const Frame &f)
{
  return std::isnan(f.load_cell_stiffness) ? f.lower_packing_stiffness
                                           : series(f.lower_packing_stiffness, f.load_cell_stiffness);
}

/// Load path between the upper frame and the ground and between the lower frame and the ground.
void add_frame(Assembly &a, const FourHigh &stand, const StandSprings &springs, const Component *housing,
               const Eigen::VectorXd &upper, const Eigen::VectorXd &lower)
{
  const Frame &f = stand.frame;
  if (housing) {
    const Eigen::Index screw = interface_of(*housing, "screw"), seat = interface_of(*housing, "seat");
    Eigen::MatrixXd residual;
    if (housing->residual.rows() == housing->n_interface()) {
      residual = Eigen::MatrixXd::Zero(housing->M.rows(), housing->M.rows());
      residual.topLeftCorner(housing->n_interface(), housing->n_interface()) = housing->residual;
    }
    const Eigen::Index first =
        a.add_body("housing", housing->M, housing->K, component_unknowns(*housing), residual);
    const Eigen::VectorXd above = a.unit(first + screw), below = a.unit(first + seat);
    const double K = lower_seat_stiffness(f);
    a.add_spring("piston and packing", series(f.piston_stiffness, f.upper_packing_stiffness), upper - above);
    a.add_spring("lower packing", K, lower - below);
    a.s.points.push_back({"housing, screw", above});
    a.s.points.push_back({"housing, chock seat", below});
    a.s.load_cell = K * (below - lower);  // compression of what lies under the chock
    return;
  }
  const bool closed = stand.dynamics.frame == FrameForm::closed;
  a.add_spring("K1", springs.K1, closed ? Eigen::VectorXd(upper - lower) : upper);
  a.add_spring("K7", springs.K7, lower);
  a.s.load_cell = closed ? Eigen::VectorXd(springs.K1 * (upper - lower)) : Eigen::VectorXd(-springs.K7 * lower);
}

/// Chock of a work roll, on its two bearings when their stiffness is given.
bool chock_moves(const double mass, const double Kzc)
{
  return mass > 0 && !std::isnan(Kzc);
}

void add_work_chock(Assembly &a, const std::string &side, const Placed &roll, const double mass, const double Kzc)
{
  const Eigen::VectorXd seat = in_place(a, roll, roll.body->seat);
  const std::string name     = side + " work-roll chock";
  if (!chock_moves(mass, Kzc)) {
    a.s.points.push_back({name, seat});
    if (mass > 0)
      a.s.carried.push_back({name, roll.body->name, seat, 2 * mass});
    return;
  }
  const Eigen::VectorXd chock = a.add_mass(name, 2 * mass);
  a.add_spring("Kzc " + side + " work roll", 2 * Kzc, chock - seat);
  a.s.points.push_back({name, chock});
}

void add_roll_points(Assembly &a, const Placed &roll)
{
  const Eigen::Index last = roll.body->axis_z.size() - 1;
  a.s.points.push_back({roll.body->name + " seat", in_place(a, roll, roll.body->seat)});
  a.s.points.push_back({roll.body->name + " end", in_place(a, roll, roll.body->axis.row(last))});
}

StandLine line_of(const Assembly &a, const Placed &roll)
{
  StandLine line{roll.body->name, roll.body->axis_z,
                 Eigen::MatrixXd::Zero(roll.body->axis_z.size(), a.s.M.rows())};
  line.rows.middleCols(roll.first, roll.body->M.rows()) = roll.body->axis;
  return line;
}

void check(const FourHigh &stand, const StandSprings &springs, const Component *housing)
{
  const Frame &f = stand.frame;
  require("K3", springs.K3, "N/m");
  require("K5", springs.K5, "N/m");
  require("K_Zy", std::min(springs.K_Zy_upper, springs.K_Zy_lower), "N/m");
  require("frame.oil_column_stiffness", f.oil_column_stiffness, "N/m");
  require("frame.cylinder_body_stiffness", f.cylinder_body_stiffness, "N/m");
  require("frame.upper_chock_stiffness", f.upper_chock_stiffness, "N/m");
  require("frame.lower_chock_stiffness", f.lower_chock_stiffness, "N/m");
  require("strip.width", stand.strip.width, "m");
  if (!(springs.K4 >= 0))
    throw InputError("K4 = " + short_number(springs.K4) + " N/m: must not be negative");
  if (housing) {
    require("frame.piston_stiffness", f.piston_stiffness, "N/m");
    require("frame.upper_packing_stiffness", f.upper_packing_stiffness, "N/m");
    require("frame.lower_packing_stiffness", f.lower_packing_stiffness, "N/m");
    require("frame.piston_mass + frame.upper_packing_mass", f.piston_mass + f.upper_packing_mass, "kg");
  } else {
    require("K1", springs.K1, "N/m");
    require("K7", springs.K7, "N/m");
    require("M1", springs.M1, "kg");
    require("M6", springs.M6, "kg");
  }
}
}  // namespace

StandSprings stand_springs(const FourHigh &stand, const LumpedStand &chain, const bool chock_on_bearing)
{
  const LumpedModel &m = chain.model;
  StandSprings s;
  s.K1         = m.K[0].value;
  s.K7         = m.K[6].value;
  s.M1         = m.M[0].value;
  s.M6         = m.M[5].value;
  s.K3         = m.K[2].value;
  s.K5         = m.K[4].value;
  s.K4         = stand.dynamics.force_meaning == ForceMeaning::measured ? 0 : m.K[3].value;
  s.K_Zy_upper = chain.K_Zy_upper.value;
  s.K_Zy_lower = chain.K_Zy_lower.value;
  if (stand.given.count("K_ZW"))
    s.K_ZW = chain.K_ZW.value;
  s.film_upper     = m.film[0].damper;
  s.film_lower     = m.film[1].damper;
  s.film_frequency = std::isnan(m.film_frequency) ? 0 : m.film_frequency;
  if (chock_on_bearing) {
    s.Kzc_upper = m.Kzc[1].value;
    s.Kzc_lower = m.Kzc[2].value;
  }
  return s;
}

StandModel assemble_stand(const std::string &name, const FourHigh &stand, const StandSprings &springs,
                          const std::array<RollBody, 4> &rolls, const Component *housing)
{
  check(stand, springs, housing);
  const Frame &f   = stand.frame;
  const Roll &work = stand.work_roll, &backup = stand.backup_roll;
  const bool on_upper = chock_moves(work.chock_mass_upper, springs.Kzc_upper),
             on_lower = chock_moves(work.chock_mass_lower, springs.Kzc_lower);
  Eigen::Index n      = 2 + (f.cylinder_mass > 0) + (backup.chock_mass_upper > 0) + on_upper + on_lower;
  for (const RollBody &roll : rolls)
    n += roll.M.rows();
  if (housing)
    n += housing->M.rows();
  Assembly a(name, n);

  const double lower_chocks = 2 * backup.chock_mass_lower;  // sit on the lower frame
  const double M1           = housing ? f.piston_mass + f.upper_packing_mass : springs.M1;
  const double M6           = housing ? f.load_cell_mass + f.lower_packing_mass : springs.M6;
  require("M6 or backup_roll.chock_mass_lower", M6 + lower_chocks, "kg");
  const Eigen::VectorXd upper = a.add_mass("upper frame", M1 + f.balance_mass);
  const std::array<double, 4> seat_mass{
      2 * backup.bearing_mass, 2 * (work.bearing_mass + (on_upper ? 0 : work.chock_mass_upper)),
      2 * (work.bearing_mass + (on_lower ? 0 : work.chock_mass_lower)), 2 * backup.bearing_mass};
  std::array<Placed, 4> placed;
  for (std::size_t i = 0; i < 4; ++i)
    placed[i] = place(a, rolls[i], seat_mass[i]);
  const Eigen::VectorXd lower = a.add_mass("lower frame", M6 + lower_chocks);

  a.s.points.push_back({"upper frame", upper});
  for (const Placed &roll : placed) {
    a.s.points.push_back({roll.body->name, in_place(a, roll, axis_row(*roll.body, 0))});
    a.s.lines.push_back(line_of(a, roll));
  }
  a.s.points.push_back({"lower frame", lower});

  add_frame(a, stand, springs, housing, upper, lower);
  std::vector<Stop> stops;
  stops.push_back({"cylinder", "cylinder", 2 * f.cylinder_mass});
  stops.push_back({"upper backup chock", "upper backup chock", 2 * backup.chock_mass_upper});
  std::vector<std::pair<std::string, double>> path;
  path.emplace_back("oil column", f.oil_column_stiffness);
  path.emplace_back("cylinder body", f.cylinder_body_stiffness);
  path.emplace_back(word_of(SeatSpring::upper), series(f.upper_chock_stiffness, springs.K_Zy_upper));
  add_path(a, upper, in_place(a, placed[upper_backup], rolls[upper_backup].seat), path, stops,
           {springs.K_Zy_upper, springs.film_upper, springs.film_frequency});
  const double half_work = rolls[upper_work].half_barrel, half_backup = rolls[upper_backup].half_barrel;
  const double line = std::min(half_work, half_backup), strip = std::min(stand.strip.width / 2, half_work);
  a.s.connections.push_back(foundation(a, "K3", placed[upper_backup], placed[upper_work], springs.K3, line));
  const Connection width = foundation(a, "K4", placed[upper_work], placed[lower_work], 1, strip);
  a.s.b                  = width.rows.transpose() * width.stiffness;
  if (springs.K4 > 0)  // (22.24): the strip answers the mean of the gap, as in the linear bite
    a.add_spring("K4", springs.K4, a.s.b);
  a.s.connections.push_back(foundation(a, "K5", placed[lower_work], placed[lower_backup], springs.K5, line));
  a.s.points.push_back({"lower backup chock", lower});
  const auto below = Film{springs.K_Zy_lower, springs.film_lower, springs.film_frequency}.joined(
      series(f.lower_chock_stiffness, springs.K_Zy_lower));
  a.add_spring(word_of(SeatSpring::lower), below.stiffness,
               in_place(a, placed[lower_backup], rolls[lower_backup].seat) - lower, below.damper);
  add_work_chock(a, "upper", placed[upper_work], work.chock_mass_upper, springs.Kzc_upper);
  add_work_chock(a, "lower", placed[lower_work], work.chock_mass_lower, springs.Kzc_lower);
  for (const Placed &roll : placed)
    add_roll_points(a, roll);
  if (a.s.residual.isZero(0))
    a.s.residual.resize(0, 0);
  return std::move(a.s);
}

int place_of_part(const std::string &part)
{
  static const std::map<std::string, int> place = [] {
    std::map<std::string, int> p;
    p["upper frame"]           = 0;
    p["cylinder"]              = 1;
    p["upper backup chock"]    = 1;
    p["upper backup roll"]     = 1;
    p["upper work roll"]       = 2;
    p["upper work-roll chock"] = 2;
    p["lower work roll"]       = 3;
    p["lower work-roll chock"] = 3;
    p["lower backup roll"]     = 4;
    p["lower frame"]           = 5;
    p["housing"]               = -1;
    return p;
  }();
  const auto match = place.find(part);
  if (match == place.end())
    throw InputError("part \"" + part + "\" has no place in the chain of six masses");
  return match->second;
}
}  // namespace mill::reduce
