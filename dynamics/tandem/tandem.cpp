#include "dynamics/tandem/tandem.h"
#include "core/base/errors.h"
#include "reduce/bite/slab/bland_ford.h"
#include <Eigen/LU>
#include <cmath>
#include <sstream>

// Stands in a row as one linear system with delays.
namespace mill::dynamics {
namespace {
std::string with(const double value, const double scale, const char *unit)
{
  std::ostringstream text;
  text.precision(6);
  text << value * scale << ' ' << unit;
  return text.str();
}

std::string name(const TandemLine &line, const std::size_t i)
{
  return line.stands[i].name.empty() ? "stand " + std::to_string(i + 1) : line.stands[i].name;
}

// The text of an error with the stand and its speed in front.
std::string where(const TandemLine &line, const std::size_t i, const double roll_speed, const double speed)
{
  return "tandem: " + name(line, i) + " at " + with(roll_speed, 1, "m/s") + " of its rolls (last stand at " +
         with(speed, 1, "m/s") + "): ";
}

bite::BiteState steady(const TandemLine &line, const std::size_t i, const double roll_speed, const double speed)
{
  bite::RollBite bite = line.stands[i].bite;
  bite.roll_speed     = roll_speed;
  bite.gap_rate       = 0;
  try {
    return bite::solve_bland_ford(bite, bite::Arc::hitchcock, 0);
  } catch (const InputError &error) {
    throw InputError(where(line, i, roll_speed, speed) +
                     (error.problems.empty() ? error.what() : error.problems[0].message));
  } catch (const SolverError &error) {
    SolverError::Report report = error.report;
    report.what                = where(line, i, roll_speed, speed) + report.what;
    throw SolverError(report);
  }
}

// Roll speed at which the strip leaves stand i as fast as the next one draws it in.  The exit speed is nearly a
// multiple of the roll speed: secants on the logarithms.
double roll_speed_for(const TandemLine &line, const std::size_t i, const double exit_speed, const double speed)
{
  double now = exit_speed / 1.02, before = 0, miss_before = 0;
  for (int pass = 0; pass < 40; ++pass) {
    const double miss = std::log(steady(line, i, now, speed).exit_speed / exit_speed);
    if (std::abs(miss) < 1e-14)
      return now;
    double slope = 1;
    if (pass > 0 && now != before) {
      slope = (miss - miss_before) / std::log(now / before);
      if (!(slope > 0.3 && slope < 3))
        slope = 1;
    }
    before      = now;
    miss_before = miss;
    now *= std::exp(-miss / slope);
    if (now == before || (pass > 8 && std::abs(miss) < 1e-12))
      return now;
  }
  throw SolverError({"tandem: the roll speed of " + name(line, i) + " does not settle",
                     "near " + with(now, 1, "m/s"), "a forward slip that jumps with the speed",
                     "look at the bite of that stand over its speed", ""});
}
}  // namespace

void check_tandem(const TandemLine &line)
{
  std::vector<Problem> problems;
  const auto complain = [&](const std::string &text) { problems.push_back({Place{}, text, {}}); };
  const std::size_t n = line.stands.size();
  if (n == 0)
    throw InputError("tandem: no stand");
  if (line.distance.size() + 1 != n)
    complain("tandem: " + std::to_string(n) + " stands have " + std::to_string(n - 1) +
             " distances between them, not " + std::to_string(line.distance.size()));
  const auto distance = [&](const std::string &place, const double value) {
    if (!(value > 0) || !std::isfinite(value))
      complain("tandem: the distance " + place + " is " + with(value, 1, "m") + "; it must be above 0");
  };
  distance("before " + name(line, 0), line.entry_distance);
  for (std::size_t i = 0; i < line.distance.size(); ++i)
    distance("behind " + name(line, std::min(i, n - 1)), line.distance[i]);
  distance("behind " + name(line, n - 1), line.exit_distance);
  if (!(line.strip_modulus > 0))
    complain("tandem: the modulus of the strip is " + with(line.strip_modulus, 1e-9, "GPa") +
             "; it must be above 0");
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Strip &leaves = line.stands[i].bite.strip, &enters = line.stands[i + 1].bite.strip;
    const auto same = [&](const char *what, const double a, const double b, const double scale, const char *unit) {
      if (!(std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b))))
        complain("tandem: " + std::string(what) + " behind " + name(line, i) + " is " + with(a, scale, unit) +
                 " and before " + name(line, i + 1) + " " + with(b, scale, unit) +
                 "; it is the same strip, give both the same");
    };
    same("the thickness", leaves.exit_thickness, enters.entry_thickness, 1e3, "mm");
    same("the tension", leaves.exit_tension, enters.entry_tension, 1e-6, "MPa");
    same("the width", leaves.width, enters.width, 1e3, "mm");
  }
  if (!problems.empty())
    throw InputError(problems);
}

TandemPoint tandem_point(const TandemLine &line, const double speed)
{
  check_tandem(line);
  if (!(speed > 0) || !std::isfinite(speed))
    throw InputError("tandem: the rolls of the last stand at " + with(speed, 1, "m/s") +
                     "; the speed must be above 0");
  const std::size_t n = line.stands.size();
  TandemPoint point;
  point.stands.resize(n);
  point.delay.resize(n - 1);
  double roll_speed = speed;
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n)
      roll_speed = roll_speed_for(line, i, point.stands[i + 1].state.entry_speed, speed);
    steady(line, i, roll_speed, speed);  // its errors name the stand
    point.stands[i] = working_point(line.stands[i].bite, roll_speed, line.scheme);
    if (i + 1 < n)
      point.delay[i] = line.distance[i] / point.stands[i].state.exit_speed;
  }
  return point;
}

DelaySystem tandem_system(const TandemLine &line, const TandemPoint &point)
{
  const Eigen::Index stands = Eigen::Index(line.stands.size());
  Eigen::Index motions      = 0;
  for (const TandemStand &stand : line.stands)
    motions += 2 * stand.structure.n();
  DelaySystem system;
  const Eigen::Index size = motions + stands + 1;
  system.A.setZero(size, size);
  system.U.setZero(size, stands - 1);
  system.W.setZero(size, stands - 1);
  system.delay       = Eigen::Map<const Eigen::VectorXd>(point.delay.data(), stands - 1);
  Eigen::Index index = 0;
  for (Eigen::Index i = 0; i < stands; ++i) {
    const StandStructure &s = line.stands[i].structure;
    const Eigen::Index n = s.n(), back = motions + i, front = motions + i + 1;
    const auto &[P, Q, F, mu, xn] = point.stands[i].by;
    const double entry            = line.strip_modulus / (i == 0 ? line.entry_distance : line.distance[i - 1]),
                 exit             = line.strip_modulus / (i == stands - 1 ? line.exit_distance : line.distance[i]);
    const auto factors            = s.M.partialPivLu();
    const Eigen::VectorXd push    = factors.solve(s.b);
    system.A.block(index, index + n, n, n).setIdentity();
    system.A.block(index + n, index, n, n)     = F[0] * push * s.b.transpose() - factors.solve(s.K);
    system.A.block(index + n, index + n, n, n) = F[1] * push * s.b.transpose() - factors.solve(s.C);
    system.A.block(index + n, back, n, 1)      = F[2] * push;
    system.A.block(index + n, front, n, 1)     = F[3] * push;
    // (28.2): the strip before the stand is drawn out by what enters, that behind it slackened by what leaves
    const auto draw = [&](const Eigen::Index tension, const double rate, const bite::StripRow &by) {
      system.A.block(tension, index, 1, n) += rate * by[0] * s.b.transpose();
      system.A.block(tension, index + n, 1, n) += rate * by[1] * s.b.transpose();
      system.A(tension, back) += rate * by[2];
      system.A(tension, front) += rate * by[3];
      if (i > 0)
        system.U(tension, i - 1) += rate * by[4];
    };
    draw(back, entry, P);
    draw(front, -exit, Q);
    if (i > 0)
      system.U.block(index + n, i - 1, n, 1) = F[4] * push;
    if (i + 1 < stands)
      system.W.block(index, i, n, 1) = s.b;  // to first order the strip leaves as thick as the gap
    index += 2 * n;
  }
  return system;
}

Eigen::MatrixXd tandem_matrix(const TandemLine &line, const TandemPoint &point, const TandemCoupling coupling)
{
  if (coupling != TandemCoupling::alone) {
    const DelaySystem system = tandem_system(line, point);
    return coupling == TandemCoupling::tension ? system.A : without_delay(system);
  }
  std::vector<Eigen::MatrixXd> parts;
  Eigen::Index size = 0, row = 0;
  for (std::size_t i = 0; i < line.stands.size(); ++i) {
    parts.push_back(stand_alone(line, point, i));
    size += parts.back().rows();
  }
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  for (const Eigen::MatrixXd &part : parts) {
    A.block(row, row, part.rows(), part.rows()) = part;
    row += part.rows();
  }
  return A;
}

Eigen::MatrixXd stand_alone(const TandemLine &line, const TandemPoint &point, const std::size_t i)
{
  const ChatterStandModel model{line.stands[i].structure, i == 0 ? line.entry_distance : line.distance[i - 1],
                                i + 1 == line.stands.size() ? line.exit_distance : line.distance[i],
                                line.strip_modulus};
  return chatter_matrix(model, point.stands[i].by);
}

std::complex<double> tandem_root(const TandemLine &line, const double speed)
{
  return DelaySpectrum(tandem_system(line, tandem_point(line, speed))).rightmost();
}
}  // namespace mill::dynamics
