#include "fem/roll/fourier_contact.h"
#include "core/base/errors.h"
#include "fem/roll/fourier_series.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mill::fem {
namespace {
// ---- from the parities to the pair
// --------------------------------------------------------------------------------

// Response to loads on both sides, stations from negative to positive z: half even, half odd.
Eigen::MatrixXd both_sides(const Eigen::MatrixXd &even, const Eigen::MatrixXd &odd)
{
  const auto n = even.rows();
  Eigen::MatrixXd out(2 * n, 2 * n);
  const Eigen::MatrixXd near = 0.5 * (even + odd), far = 0.5 * (even - odd);
  out.bottomRightCorner(n, n) = near;
  out.topLeftCorner(n, n)     = near.reverse();
  out.bottomLeftCorner(n, n)  = far.rowwise().reverse();
  out.topRightCorner(n, n)    = far.colwise().reverse();
  return out;
}

// Columns for the force, half on each side, and for the moment.
Eigen::MatrixXd both_sides(const Eigen::VectorXd &even, const Eigen::VectorXd &odd)
{
  const auto n = even.size();
  Eigen::MatrixXd out(2 * n, 2);
  out.col(0) << 0.5 * even.reverse(), 0.5 * even;
  out.col(1) << -0.5 * odd.reverse(), 0.5 * odd;
  return out;
}

// Station loads of a strip: unit force, or (odd) unit moment of one side.
Eigen::VectorXd strip_load(const Eigen::VectorXd &edge, const double width, const bool odd)
{
  const Eigen::VectorXd z = station_centres(edge);
  Eigen::VectorXd load(z.size());
  for (Eigen::Index k = 0; k < z.size(); ++k)
    load[k] = std::max(0., std::min(edge[k + 1], 0.5 * width) - edge[k]) * (odd ? z[k] : 1);
  return load / (odd ? load.dot(z) : load.sum());
}

// What the balancing load of one symmetry case does to surface and axis, per unit of its resultant on one side.
struct Balance {
  Eigen::VectorXd surface, axis;
};

Balance balance(const FourierRoll &roll, const HarmonicResponse &response, const FourierSupport &support,
                const bool odd)
{
  const auto n = roll.edge.size() - 1;
  if (support.kind == RollSupport::necks) {
    if (response.seat_surface.size() == 0)
      throw std::logic_error("a roll without necks cannot be held by them");
    const double lever = odd ? roll.seat_lever : 1;
    return {-response.seat_surface / lever, -response.seat_axis / lever};
  }
  if (support.kind == RollSupport::strip) {
    const Eigen::VectorXd strip = strip_load(roll.edge, support.strip_width, odd);
    return {opposite(roll.order, response.surface) * strip, -response.axis * strip};
  }
  return {Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
}

FourierSide side_of(const FourierRoll &roll, const FourierSupport &support, const bool whole)
{
  FourierSide side;
  side.radius        = roll.geometry.radius;
  side.half_width    = roll.half_width;
  side.mirrored      = support.kind == RollSupport::mirror;
  side.order         = roll.order;
  const Balance even = balance(roll, roll.even, support, false);
  if (!whole) {
    side.surface      = roll.even.surface;
    side.axis         = roll.even.axis;
    side.support      = even.surface;
    side.axis_support = even.axis;
  } else {
    if (!roll.both_sides())
      throw std::logic_error("a load that differs between the sides needs a roll condensed for both");
    const Balance odd = balance(roll, roll.odd, support, true);
    for (std::size_t s = 0; s < roll.order.size(); ++s)
      side.surface.push_back(both_sides(roll.even.surface[s], roll.odd.surface[s]));
    side.axis         = both_sides(roll.even.axis, roll.odd.axis);
    side.support      = both_sides(even.surface, odd.surface);
    side.axis_support = both_sides(even.axis, odd.axis);
  }
  if (side.mirrored)
    side.axis.setZero();
  return side;
}

double plane_compliance(const Material &m)
{
  return (1 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus;
}

// ---- the contact problem
// ------------------------------------------------------------------------------------------

// Gap without the motion and what balances, and its derivative, at given station forces.  theory.md 11
struct Linearised {
  Eigen::VectorXd opened;    // (N) m
  Eigen::MatrixXd jacobian;  // (N, N) m/N
};

Eigen::VectorXd hertz_half_width(const FourierPair &pair, const Eigen::VectorXd &force)
{
  return (4 * pair.reduced_radius / (M_PI * pair.reduced_modulus) * force.cwiseMax(0.).cwiseQuotient(pair.length))
      .cwiseSqrt();
}

Linearised linearise(const FourierPair &pair, const Eigen::VectorXd &force)
{
  const double least =
      std::min(pair.first.half_width, pair.second.half_width) / 50;  // keeps empty stations finite
  const Eigen::VectorXd b = hertz_half_width(pair, force), used = b.cwiseMax(least);
  StationFlexibility flex        = flexibility(pair.first, used);
  const StationFlexibility other = flexibility(pair.second, used);
  flex.C += other.C;
  flex.row_slope += other.row_slope;
  // Mean of the parabola x^2 / 2R over the ellipse is b^2 / 8R, linear in the line load.
  const Eigen::VectorXd parabola = (2 * M_PI * pair.reduced_modulus * pair.length).cwiseInverse();
  // d b / d force; a station at the least half width does not change it.
  Eigen::VectorXd b_slope(b.size());
  for (Eigen::Index k = 0; k < b.size(); ++k)
    b_slope[k] = b[k] > least ? b[k] / (2 * force[k]) : 0;
  Linearised out{pair.drop + flex.C * force + parabola.cwiseProduct(force), flex.C};
  out.jacobian.diagonal() += parabola + (flex.row_slope * force).cwiseProduct(b_slope);
  out.jacobian += flex.row_slope.transpose() * force.cwiseProduct(b_slope).asDiagonal();
  return out;
}

// Unknowns of the linear problem: forces of the touching stations, motions, resultants.
struct Linear {
  Eigen::VectorXd force, motion, resultant;
};

// opened + jacobian (force - at) + support resultant - closing motion = 0 where touching, equilibrium, and what is
// imposed: rows `imposed_*` times the unknowns equal to `imposed`.
class Bordered {
public:
  Bordered(const FourierPair &pair_of_rolls, const FourierDrive &loading, const Linearised &linear,
           const std::vector<char> &touching)
      : pair(pair_of_rolls), k(pair.closing.cols())
  {
    for (Eigen::Index i = 0; i < Eigen::Index(touching.size()); ++i)
      if (touching[std::size_t(i)])
        set.push_back(i);
    const auto n                       = Eigen::Index(set.size());
    scale                              = linear.jacobian.diagonal().mean();  // brings metres to newtons
    const auto both                    = pair.first.support + pair.second.support;
    Eigen::MatrixXd A                  = Eigen::MatrixXd::Zero(n + 2 * k, n + 2 * k);
    A.topLeftCorner(n, n)              = linear.jacobian(set, set) / scale;
    A.block(0, n, n, k)                = -pair.closing(set, Eigen::all);
    A.topRightCorner(n, k)             = both(set, Eigen::all) / scale;
    A.block(n, 0, k, n)                = pair.closing(set, Eigen::all).transpose();
    A.block(n, n + k, k, k).diagonal() = -Eigen::VectorXd::Ones(k);
    A(n + k, n + k)                    = 1;
    if (k == 2) {
      by_tilt = std::isnan(loading.load_offset);
      if (by_tilt) {
        const Eigen::VectorXd slope       = pair.mean.col(1);
        const Eigen::RowVectorXd by_force = slope.transpose() * (pair.first.axis + pair.second.axis);
        A.row(n + k + 1).head(n)          = -by_force(set) / scale;
        A(n + k + 1, n + 1)               = 1;
        A.row(n + k + 1).tail(k) =
            -slope.transpose() * (pair.first.axis_support + pair.second.axis_support) / scale;
      } else
        A(n + k + 1, n + k + 1) = 1;
    }
    factor.compute(A);
  }

  // @param gap (N) right side of the gap rows; imposed (k): force, and tilt or moment.
  Linear solve(const Eigen::VectorXd &gap, const Eigen::VectorXd &imposed) const
  {
    const auto n        = Eigen::Index(set.size());
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(n + 2 * k);
    rhs.head(n)         = gap(set) / scale;
    rhs[n + k]          = imposed[0];
    if (k == 2)
      rhs[n + k + 1] = by_tilt ? imposed[1] / scale : imposed[1];
    const Eigen::VectorXd x = factor.solve(rhs);
    Linear out{Eigen::VectorXd::Zero(gap.size()), scale * x.segment(n, k), x.tail(k)};
    out.force(set) = x.head(n);
    return out;
  }

private:
  const FourierPair &pair;
  Eigen::Index k;
  std::vector<Eigen::Index> set;
  double scale = 1;
  bool by_tilt = false;
  Eigen::PartialPivLU<Eigen::MatrixXd> factor;
};

Eigen::VectorXd gap_of(const FourierPair &pair, const Eigen::VectorXd &opened, const Linear &x)
{
  return opened + (pair.first.support + pair.second.support) * x.resultant - pair.closing * x.motion;
}

// Axes moving away from the contact, per station.
Eigen::VectorXd axis_motion(const FourierPair &pair, const Linear &x)
{
  return (pair.first.axis + pair.second.axis) * x.force +
         (pair.first.axis_support + pair.second.axis_support) * x.resultant;
}

// Linear complementarity problem of one Newton step by exchange of stations.
Linear solve_step(const FourierPair &pair, const FourierDrive &loading, const Linearised &linear,
                  const Eigen::VectorXd &position, const Eigen::VectorXd &imposed, std::vector<char> &touching)
{
  const Eigen::VectorXd constant = linear.opened - linear.jacobian * position;
  for (int exchange = 0; exchange < 500; ++exchange) {
    const Linear x            = Bordered(pair, loading, linear, touching).solve(-constant, imposed);
    const Eigen::VectorXd gap = gap_of(pair, constant + linear.jacobian * x.force, x);
    const double small        = 1e-13 * std::abs(x.motion[0]);
    std::vector<std::size_t> wrong;
    for (std::size_t i = 0; i < touching.size(); ++i)
      if (const auto k = Eigen::Index(i); touching[i] ? x.force[k] <= 0 : gap[k] < -small)
        wrong.push_back(i);
    if (wrong.empty())
      return x;
    // All at once is fast; should that run in circles, one at a time by Murty's rule cannot.
    if (exchange >= 20)
      wrong.erase(wrong.begin(), wrong.end() - 1);
    for (const std::size_t i : wrong)
      touching[i] = !touching[i];
    if (std::none_of(touching.begin(), touching.end(), [](const char is) { return is; }))
      break;
  }
  throw SolverError({"the contact of the Fourier rolls " + pair.name + " found no set of touching stations", "",
                     "a tilt or a profile that the load cannot close", "check crown, tilt and load", ""});
}
}  // namespace

FourierPair fourier_pair(const std::string &name, const FourierRoll &first, const FourierSupport &first_support,
                         const FourierRoll &second, const FourierSupport &second_support,
                         const Eigen::VectorXd &drop)
{
  const auto n = first.edge.size() - 1;
  if (second.edge.size() != n + 1 || (second.edge - first.edge).cwiseAbs().maxCoeff() > 1e-9 * first.edge[n])
    throw std::logic_error("the two rolls of contact " + name + " have different stations");
  FourierPair pair;
  pair.name                    = name;
  pair.whole                   = drop.size() == 2 * n;
  const Eigen::VectorXd centre = station_centres(first.edge), length = station_lengths(first.edge);
  const Eigen::Index N = pair.whole ? 2 * n : n;
  if (drop.size() != N)
    throw std::logic_error("the profile of contact " + name + " does not fit its stations");
  pair.z.resize(N);
  pair.length.resize(N);
  pair.z.tail(n)      = centre;
  pair.length.tail(n) = length;
  if (pair.whole) {
    pair.z.head(n)      = -centre.reverse();
    pair.length.head(n) = length.reverse();
  }
  pair.drop    = drop.array() - drop.minCoeff();
  pair.closing = Eigen::MatrixXd::Ones(N, pair.whole ? 2 : 1);
  pair.mean    = pair.closing;
  if (pair.whole)
    pair.closing.col(1) = pair.z;
  for (Eigen::Index j = 0; j < pair.closing.cols(); ++j) {
    const Eigen::VectorXd moment = pair.length.cwiseProduct(pair.closing.col(j));
    pair.mean.col(j)             = moment / moment.dot(pair.closing.col(j));
  }
  pair.reduced_modulus = 1 / (plane_compliance(first.material) + plane_compliance(second.material));
  pair.reduced_radius  = 1 / (1 / first.geometry.radius + 1 / second.geometry.radius);
  pair.first           = side_of(first, first_support, pair.whole);
  pair.second          = side_of(second, second_support, pair.whole);
  return pair;
}

FourierPoint solve_load(const FourierPair &pair, const double load, const FourierDrive &loading,
                        const Eigen::VectorXd &start)
{
  if (!(load > 0))
    throw InputError("the contact force of two rolls must be positive");
  const Eigen::Index N = pair.z.size(), k = pair.closing.cols();
  const double part = pair.whole ? 1 : 0.5;  // of the load on these stations
  Eigen::VectorXd imposed(k);
  imposed[0] = part * load;
  if (k == 2)
    imposed[1] = std::isnan(loading.load_offset) ? loading.tilt : load * loading.load_offset;
  Eigen::VectorXd force = start.size() == N ? Eigen::VectorXd(start.cwiseProduct(pair.length))
                                            : Eigen::VectorXd(part * load / pair.length.sum() * pair.length);
  std::vector<char> touching(std::size_t(N), 1);
  for (Eigen::Index i = 0; i < N; ++i)
    touching[std::size_t(i)] = force[i] > 0;

  FourierPoint point;
  Linear x;
  Linearised linear;
  double change = 1;
  for (point.iterations = 0; point.iterations < 40 && change > 1e-12; ++point.iterations) {
    linear = linearise(pair, force);
    x      = solve_step(pair, loading, linear, force, imposed, touching);
    change = (x.force - force).cwiseAbs().maxCoeff() / x.force.cwiseAbs().maxCoeff();
    force  = x.force;
  }
  if (change > 1e-12)
    throw SolverError({"the contact of the Fourier rolls " + pair.name + " does not converge",
                       "change of the line load " + std::to_string(change) + " after 40 steps",
                       "a load so small that hardly a station touches", "raise the load", ""});

  linear                        = linearise(pair, force);
  const Eigen::VectorXd closing = pair.closing * x.motion - axis_motion(pair, x);
  const Eigen::VectorXd motion  = pair.mean.transpose() * closing;
  point.load                    = load;
  point.approach                = motion[0];
  const Eigen::VectorXd gap     = gap_of(pair, linear.opened, x);
  for (Eigen::Index i = 0; i < N; ++i)
    point.residual =
        std::max(point.residual, (touching[std::size_t(i)] ? std::abs(gap[i]) : -gap[i]) / point.approach);
  if (pair.whole) {
    point.tilt   = motion[1];
    point.moment = x.resultant[1];
  }
  point.line_load        = force.cwiseQuotient(pair.length);
  point.half_width       = hertz_half_width(pair, force);
  point.station_approach = closing;

  // Derivative with respect to the load, the set of touching stations held.
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(k);
  unit[0]              = part;
  if (k == 2 && !std::isnan(loading.load_offset))
    unit[1] = loading.load_offset;
  const Linear d = Bordered(pair, loading, linear, touching).solve(Eigen::VectorXd::Zero(N), unit);
  const Eigen::VectorXd d_closing = pair.closing * d.motion - axis_motion(pair, d);
  point.tangent                   = 1 / pair.mean.col(0).dot(d_closing);
  point.station_tangent           = d.force.cwiseQuotient(pair.length).cwiseQuotient(d_closing);
  return point;
}

ContactCurve sweep(const FourierPair &pair, const Eigen::VectorXd &loads, const FourierDrive &loading,
                   const Progress &progress)
{
  const Eigen::Index n = loads.size();
  ContactCurve curve;
  curve.name      = pair.name;
  curve.reference = pair.reference;
  curve.load      = loads;
  for (Eigen::VectorXd *column :
       {&curve.approach, &curve.half_width, &curve.peak_pressure, &curve.tangent, &curve.secant})
    column->resize(n);
  curve.iterations.resize(n);
  Eigen::VectorXd start;
  for (Eigen::Index i = 0; i < n; ++i) {
    const FourierPoint point    = solve_load(pair, loads[i], loading, start);
    const BarrelProfile profile = barrel_profile(pair, point);
    const Eigen::Index middle   = pair.whole ? pair.z.size() / 2 : 0;
    curve.approach[i]           = point.approach;
    curve.tangent[i]            = point.tangent;
    curve.secant[i]             = loads[i] / point.approach;
    curve.half_width[i]         = profile.half_width[middle];
    curve.peak_pressure[i]      = profile.peak_pressure[middle];
    curve.iterations[i]         = point.iterations;
    curve.residual              = std::max(curve.residual, point.residual);
    start                       = point.line_load;
    if (i + 1 < n)
      start *= loads[i + 1] / loads[i];
    progress.at("contact " + pair.name, double(i + 1) / double(n));
  }
  return curve;
}

BarrelProfile barrel_profile(const FourierPair &pair, const FourierPoint &point)
{
  BarrelProfile out;
  out.load          = point.load;
  out.z             = pair.z;
  out.line_load     = point.line_load;
  out.approach      = point.station_approach;
  out.tangent       = point.station_tangent;
  out.half_width    = point.half_width;
  out.peak_pressure = Eigen::VectorXd::Zero(pair.z.size());
  for (Eigen::Index i = 0; i < pair.z.size(); ++i)
    if (point.half_width[i] > 0)
      out.peak_pressure[i] = 2 * point.line_load[i] / (M_PI * point.half_width[i]);
  return out;
}
}  // namespace mill::fem
