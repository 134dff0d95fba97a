#include "roll_bite.h"
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string>

namespace mill::fmu {
namespace {
constexpr double pi            = 3.14159265358979323846;
constexpr double tension_limit = 0.999;  // share of the flow stress at which a tension tears the strip

// Nodes of Gauss and Legendre by Newton's iteration on the polynomial.
void gauss(const int n, std::vector<double> &node, std::vector<double> &weight)
{
  node.resize(std::size_t(n));
  weight.resize(std::size_t(n));
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int turn = 0; turn < 60; ++turn) {
      double p0 = 1, p1 = x;
      for (int k = 2; k <= n; ++k) {
        const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0              = p1;
        p1              = p2;
      }
      slope             = n * (x * p1 - p0) / (x * x - 1);
      const double step = p1 / slope;
      x -= step;
      if (std::abs(step) < 1e-15)  // quadratic convergence: the next step would be rounding alone
        break;
    }
    node[std::size_t(i)]   = x;
    weight[std::size_t(i)] = 2 / ((1 - x * x) * slope * slope);
  }
}

// Place of a name in a list of them.
template <class Law>
Law named(const char *what, const std::string &name, const std::initializer_list<const char *> names)
{
  int place = 0;
  for (const char *one : names) {
    if (name == one)
      return Law(place);
    ++place;
  }
  throw std::runtime_error(std::string(what) + " " + name + " is unknown");
}
}  // namespace

struct RollBite::Inputs {
  double entry_thickness, gap, gap_rate, entry_tension, exit_tension, initial_thickness, radius;
};

struct RollBite::Contact {
  double entry_position, exit_position, exit_thickness;       // m
  double entry_angle, exit_angle, neutral_angle, free_angle;  // rad of x = sqrt(R h) tan t, (8.3)
  double entry_factor, exit_factor, friction;                 // -
  double entry_speed, exit_speed;                             // m/s
};

double RollBite::stress_at(const Inputs &in, const double thickness) const
{
  return bite::flow_stress(pass_.flow, std::log(in.initial_thickness / thickness));
}

namespace {
// Where the strip stops getting thinner, (8.16).
double exit_position(const double radius, const double gap, const double rate, const double entry_thickness,
                     const double entry_position, const double entry_speed)
{
  const double flow = entry_speed * entry_thickness - entry_position * rate;
  const double lag  = radius * gap * rate;
  return lag / (flow + std::sqrt(flow * flow + lag * rate));
}

double tension_factor(const double tension, const double stress)
{
  return tension == 0 && stress == 0 ? 1 : 1 - tension / stress;
}
}  // namespace

// @param held  film and friction from the speeds of the steady state, as the scheme wants
RollBite::Contact RollBite::contact_of(const Inputs &in, const double entry_speed, const bool held) const
{
  const double R = in.radius, h = in.gap, he = in.entry_thickness, rate = in.gap_rate, roll = pass_.roll_speed;
  const auto speed_at = [&](const double entering, const double from, const double x) {  // (8.15)
    return (entering * he + (x - from) * rate) / (h + x * x / R);
  };
  Contact c{};
  const double scale = std::sqrt(R * h), entry_stress = stress_at(in, he);
  c.entry_position = std::sqrt(R * (he - h));  // (8.2)
  c.exit_position  = exit_position(R, h, rate, he, c.entry_position, entry_speed);
  c.exit_thickness = h + c.exit_position * c.exit_position / R;
  c.entry_angle    = std::atan(c.entry_position / scale);
  c.exit_angle     = std::atan(c.exit_position / scale);
  c.entry_factor   = tension_factor(in.entry_tension, entry_stress);
  c.exit_factor    = tension_factor(in.exit_tension, stress_at(in, c.exit_thickness));
  const double film_exit_speed =
      held ? steady_.exit_speed : speed_at(entry_speed, c.entry_position, c.exit_position);
  c.friction           = held && scheme_ == Scheme::frozen_friction
                             ? steady_.friction
                             : bite::coulomb_coefficient(
                                   pass_.friction, bite::Inlet<double>{roll, entry_speed, film_exit_speed, R,
                                                                       c.entry_position, entry_stress - in.entry_tension});
  const double balance = std::log(c.exit_factor / c.entry_factor * he / c.exit_thickness);  // (8.7)
  c.free_angle         = 0.5 * (c.entry_angle + c.exit_angle) - std::sqrt(h / R) * balance / (4 * c.friction);
  c.neutral_angle      = std::min(std::max(c.free_angle, c.exit_angle), c.entry_angle);  // (26.1)
  const double neutral = scale * std::tan(c.neutral_angle);
  c.entry_speed = (roll * (h + neutral * neutral / R) + (c.entry_position - neutral) * rate) / he;  // (8.15)
  c.exit_speed  = speed_at(c.entry_speed, c.entry_position, c.exit_position);
  return c;
}

// Film, exit point and speeds agree: Newton's iteration with the slope of a chord.
RollBite::Contact RollBite::settled(const Inputs &in, double speed) const
{
  for (int turn = 0; turn < 100; ++turn) {
    const Contact c    = contact_of(in, speed, false);
    const double width = 1e-6 * speed;
    const double slope = (contact_of(in, speed + width, false).entry_speed - c.entry_speed) / width;
    double change      = (c.entry_speed - speed) / (1 - slope);
    if (!(speed + change > 0))
      change = -0.5 * speed;
    if (!std::isfinite(change))
      break;
    speed += change;
    if (std::abs(change) <= 4e-16 * speed || (turn > 20 && std::abs(change) <= 1e-13 * speed))
      return contact_of(in, speed, false);
  }
  throw std::runtime_error("film and speeds of the strip do not settle");
}

// (8.8) on one side, by Gauss and Legendre in t, piece by piece where the law has kinks.
double RollBite::side_of(const Inputs &in, const Contact &c, const double from, const double to,
                         const bool entry_side) const
{
  double ends[64];
  int n     = 0;
  ends[n++] = from;
  for (const double strain : kinks_) {
    const double h = in.initial_thickness * std::exp(-strain);
    if (!(h > in.gap) || n > 60)
      continue;
    const double angle = std::atan(std::sqrt(h / in.gap - 1));
    for (const double t : {angle, -angle})
      if (t > from && t < to)
        ends[n++] = t;
  }
  std::sort(ends + 1, ends + n);
  ends[n++]              = to;
  const Rule &rule       = entry_side ? entry_rule_ : exit_rule_;
  const double per_angle = 2 * c.friction * std::sqrt(in.radius / in.gap);
  double sum             = 0;
  for (int piece = 1; piece < n; ++piece) {
    const double middle = 0.5 * (ends[piece] + ends[piece - 1]), half = 0.5 * (ends[piece] - ends[piece - 1]);
    double part = 0;
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double t = middle + half * rule.node[i], cosine = std::cos(t), square = cosine * cosine;
      part += rule.weight[i] * stress_at(in, in.gap / square) / (square * square) *
              std::exp(per_angle * (entry_side ? c.entry_angle - t : t - c.exit_angle));
    }
    sum += half * part;
  }
  return sum;
}

double RollBite::force_of(const Inputs &in, const Contact &c) const
{
  const double scale = in.gap * std::sqrt(in.radius * in.gap);
  return pass_.width * scale *
         (c.entry_factor / in.entry_thickness * side_of(in, c, c.neutral_angle, c.entry_angle, true) +
          c.exit_factor / c.exit_thickness * side_of(in, c, c.exit_angle, c.neutral_angle, false));
}

// As hill_rules(): 12 points, and 24 towards the entry by u^5 where a power of the strain begins there.
void RollBite::choose_rules()
{
  gauss(12, exit_rule_.node, exit_rule_.weight);
  entry_rule_        = exit_rule_;
  const PassData &p  = pass_;
  const double start = p.initial_thickness > 0 ? std::log(p.initial_thickness / p.entry_thickness) : 0;
  if (bite::strain_from_branch(p.flow, start) < 0.5 * std::log(p.entry_thickness / p.exit_thickness)) {
    gauss(24, entry_rule_.node, entry_rule_.weight);
    for (std::size_t i = 0; i < 24; ++i) {
      const double u      = 0.5 * (1 + entry_rule_.node[i]);
      entry_rule_.node[i] = 1 - 2 * std::pow(u, 5);
      entry_rule_.weight[i] *= 5 * std::pow(u, 4);
    }
  }
  kinks_ = bite::strains_of_kinks(p.flow);
}

namespace {
// A root between low, where the value of a function is above zero, and high, where it is below: chords, of which
// one that keeps its end twice is made steeper (Illinois).
template <class Function>
double root_between(double low, double high, double at_low, double at_high, const Function &function)
{
  int side = 0;
  for (int turn = 0; turn < 100 && high - low > 4e-16 * high; ++turn) {
    const double chord  = low + (high - low) * at_low / (at_low - at_high);
    const double middle = chord > low && chord < high ? chord : 0.5 * (low + high);
    const double value  = function(middle);
    if (value == 0)
      return middle;
    if (value > 0) {
      low    = middle;
      at_low = value;
      at_high *= side > 0 ? 0.5 : 1;
      side = 1;
    } else {
      high    = middle;
      at_high = value;
      at_low *= side < 0 ? 0.5 : 1;
      side = -1;
    }
    if (!(middle > low || middle < high) || std::abs(value) <= 4e-16 * middle)
      return middle;
  }
  return 0.5 * (low + high);
}
}  // namespace

// R' = R (1 + c F(R')/draft), (8.9): plain steps from below reach the smallest root.  Aitken's extrapolation of
// two of them makes them quicker; where it passes the root, the root is between.
void RollBite::flatten()
{
  const PassData &p       = pass_;
  const double compliance = 16 * (1 - p.poisson_ratio * p.poisson_ratio) / (pi * p.youngs_modulus * p.width);
  const double speed      = p.roll_speed * p.exit_thickness / p.entry_thickness;
  const auto next         = [&](const double radius) {
    Inputs in      = inputs_at(moment_);
    in.radius      = radius;
    const double R = p.roll_radius *
                     (1 + compliance * force_of(in, settled(in, speed)) / (p.entry_thickness - p.exit_thickness));
    if (!(R < 20 * p.roll_radius))
      throw std::runtime_error("no flattened radius below 20 times that of the roll");
    return R;
  };
  const auto rise = [&](const double radius) { return next(radius) - radius; };
  double radius   = p.roll_radius;
  for (int turn = 0; turn < 2000; ++turn) {
    const double one = next(radius), two = next(one), bend = two - 2 * one + radius;
    radius_ = two;
    if (std::abs(two - one) <= 4e-16 * two)
      return;
    const double fast = bend < 0 ? radius - (one - radius) * (one - radius) / bend : two;
    radius            = two;
    if (!(fast > two && fast < 20 * p.roll_radius))
      continue;
    if (const double beyond = rise(fast); beyond >= 0)
      radius = fast;
    else if (const double before = rise(two); before > 0) {
      radius_ = root_between(two, fast, before, beyond, rise);
      return;
    } else
      return;  // but for rounding
  }
}

RollBite::RollBite(const PassData &pass)
    : pass_(pass), scheme_(named<Scheme>("scheme", pass.scheme, {"sequential", "implicit", "frozen_friction"}))
{
  const PassData &p = pass_;
  if (!(p.entry_thickness > p.exit_thickness && p.exit_thickness > 0))
    throw std::runtime_error("the strip must leave the bite thinner than it enters");
  choose_rules();
  moment_                  = {p.exit_thickness, 0, p.entry_tension, p.exit_tension, p.entry_thickness};
  const auto require_whole = [&] {
    const auto whole = yield_reserve(moment_);
    if (!(whole[0] > 0 && whole[1] > 0))
      throw std::runtime_error("a tension reaches the flow stress of the strip");
  };
  require_whole();
  flatten();
  const Inputs in = inputs_at(moment_);
  const Contact c = settled(in, p.roll_speed * p.exit_thickness / p.entry_thickness);
  steady_         = {c.entry_speed,
                     c.exit_speed,
                     force_of(in, c),
                     c.friction,
                     c.exit_thickness,
                     true,
                     c.free_angle - c.exit_angle,
                     c.entry_angle - c.free_angle};
  if (!(steady_.from_exit > 0 && steady_.from_entry > 0))
    throw std::runtime_error("the bite has no neutral point: the rolls skid");
  require_whole();
  if (!std::isfinite(steady_.force))
    throw std::runtime_error("the rolling force of the steady bite is not finite");
}

RollBite::Inputs RollBite::inputs_at(const BiteMoment &m) const
{
  return {m[4], m[0], m[1], m[2], m[3], pass_.initial_thickness > 0 ? pass_.initial_thickness : m[4], radius_};
}

double RollBite::thickness_at_exit(const Inputs &in) const
{
  const double entry = std::sqrt(in.radius * (in.entry_thickness - in.gap));
  const double exit =
      exit_position(in.radius, in.gap, in.gap_rate, in.entry_thickness, entry, steady_.entry_speed);
  return in.gap + exit * exit / in.radius;
}

// Limits of gap rate (26.2) and of tensions at yield.
void RollBite::limit(Inputs &in) const
{
  const double room = in.radius * (4 * in.gap - 3 * in.entry_thickness);
  if (in.gap_rate < 0 && room > 0) {
    const double vanishing = scheme_ == Scheme::implicit ? pass_.roll_speed : steady_.entry_speed;
    const double entry     = std::sqrt(in.radius * (in.entry_thickness - in.gap));
    in.gap_rate            = std::max(in.gap_rate, -2 * vanishing * entry * in.entry_thickness / room);
  }
  in.entry_tension = std::min(in.entry_tension, tension_limit * stress_at(in, in.entry_thickness));
  in.exit_tension  = std::min(in.exit_tension, tension_limit * stress_at(in, thickness_at_exit(in)));
}

BiteReading RollBite::at(const BiteMoment &moment) const
{
  BiteReading r;
  if (!(contact_reserve(moment) > 0)) {
    r.entry_speed = r.exit_speed = pass_.roll_speed;
    r.contact                    = false;
    r.exit_thickness             = moment[4];
    return r;
  }
  Inputs in = inputs_at(moment);
  limit(in);
  const Contact c =
      scheme_ == Scheme::implicit ? settled(in, steady_.entry_speed) : contact_of(in, steady_.entry_speed, true);
  return {c.entry_speed,
          c.exit_speed,
          force_of(in, c),
          c.friction,
          c.exit_thickness,
          true,
          c.free_angle - c.exit_angle,
          c.entry_angle - c.free_angle};
}

double RollBite::contact_reserve(const BiteMoment &m) const
{
  const double vanishing = scheme_ == Scheme::implicit ? pass_.roll_speed : steady_.entry_speed;
  const double opening   = std::max(m[1], 0.) / vanishing;
  return m[4] - m[0] - 0.25 * radius_ * opening * opening;
}

std::array<double, 2> RollBite::yield_reserve(const BiteMoment &m) const
{
  const Inputs in = inputs_at(m);
  double h        = steady_.entry_speed > 0 ? std::min(thickness_at_exit(in), m[4]) : m[0];
  if (!std::isfinite(h))
    h = m[4];
  return {1 - in.entry_tension / (tension_limit * stress_at(in, m[4])),
          1 - in.exit_tension / (tension_limit * stress_at(in, h))};
}
}  // namespace mill::fmu
