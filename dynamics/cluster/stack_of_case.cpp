#include "dynamics/cluster/stack_of_case.h"
#include "core/numerics/eigen_instances.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::cluster {
namespace {
double or_else(const double value, const double otherwise)
{
  return std::isnan(value) ? otherwise : value;
}

Material material_of(const ClusterRoll &roll, const Material &steel)
{
  Material material       = steel;
  material.youngs_modulus = or_else(roll.youngs_modulus, steel.youngs_modulus);
  material.poisson_ratio  = or_else(roll.poisson_ratio, steel.poisson_ratio);
  material.density        = or_else(roll.density, steel.density);
  return material;
}

int roll_named(const std::vector<ClusterRoll> &rolls, const std::string &name)
{
  for (std::size_t i = 0; i < rolls.size(); ++i)
    if (rolls[i].name == name)
      return int(i);
  return -1;
}

std::pair<int, int> rolls_of_pair(const ClusterStand &stand, const std::string &pair)
{
  const auto dash = pair.find('-');
  return {roll_named(stand.rolls, pair.substr(0, dash)), roll_named(stand.rolls, pair.substr(dash + 1))};
}

ContactLaw law_of(const ClusterStand &stand, const ClusterContact &c, const ComputedLaws &computed)
{
  const auto [a, b]      = rolls_of_pair(stand, c.pair);
  const ClusterRoll &one = stand.rolls[std::size_t(a)], &other = stand.rolls[std::size_t(b)];
  const double length = or_else(c.length, std::min(one.barrel_length, other.barrel_length));
  const auto by_line  = [&](const LineForm form) {
    return line_law(form, {0.5 * one.barrel_diameter, material_of(one, stand.steel)},
                     {0.5 * other.barrel_diameter, material_of(other, stand.steel)}, length);
  };
  const auto match = computed.find(c.pair);
  switch (c.law) {
  case ClusterLaw::power:
    return palmgren_law(length, c.coefficient);
  case ClusterLaw::spring:
    return power_law_through(c.stiffness, c.load, c.exponent);
  case ClusterLaw::computed:
    return match != computed.end() ? match->second : by_line(LineForm::johnson);
  case ClusterLaw::foeppl:
    return by_line(LineForm::foeppl);
  case ClusterLaw::johnson:
    return by_line(LineForm::johnson);
  }
  return {};
}

Roll roll_of(const ClusterRoll &in, const Material &steel, const Eigen::Vector2d &centre)
{
  Roll roll;
  roll.name    = in.name;
  roll.radius  = 0.5 * in.barrel_diameter;
  roll.length  = in.barrel_length;
  roll.mass    = or_else(in.mass, material_of(in, steel).density * M_PI * roll.radius * roll.radius * roll.length);
  roll.inertia = 0.5 * roll.mass * roll.radius * roll.radius;
  roll.centre  = centre;
  return roll;
}

Support support_of(const ClusterStand &stand, const ClusterSupport &in, const std::vector<Roll> &rolls,
                   const double loss_factor)
{
  Support s;
  s.name        = in.own_name();
  s.roll        = roll_named(stand.rolls, in.roll);
  s.direction   = in.direction;
  s.loss_factor = loss_factor;
  s.type        = in.type;
  switch (in.type) {
  case SupportType::guide:
    s.law = {1 / in.stiffness, 1};
    break;
  case SupportType::rollers: {
    s.law                     = bearing_through(in.stiffness, in.preload, in.exponent);
    s.preload                 = in.preload;
    s.half_angle              = in.half_angle;
    s.guard                   = in.guard;
    s.against                 = roll_named(stand.rolls, in.against);
    const Eigen::Vector2d out = rolls[std::size_t(s.roll)].centre - rolls[std::size_t(s.against)].centre;
    s.direction               = std::atan2(out.y(), out.x());
    break;
  }
  case SupportType::radial:
  case SupportType::isotropic:
    s.law    = bearing_through(in.stiffness, in.load, in.exponent);
    s.across = in.stiffness;
  }
  return s;
}

void add_loads(Stack &stack, const ClusterStand &stand, const ClusterPass &pass, const double force)
{
  const auto dash = stand.stack.strip.find('-');
  const int upper = strip_roll(stand);
  stack.loads.push_back({upper, {0, force}});
  if (pass.horizontal_force != 0)
    stack.side_loads.push_back({upper, {pass.horizontal_force, 0}});
  if (dash == std::string::npos)
    return;
  const int lower = roll_named(stand.rolls, stand.stack.strip.substr(dash + 1));
  stack.loads.push_back({lower, {0, -force}});
  if (std::isnan(stand.stack.strip_stiffness))
    return;
  Contact strip;
  strip.name      = "strip";
  strip.a         = lower;
  strip.b         = upper;
  strip.law       = straight_law(stand.stack.strip_stiffness);
  strip.one_sided = false;
  strip.strip     = true;
  strip.carried   = force;
  stack.contacts.push_back(strip);
}
}  // namespace

ClusterStand written_out(ClusterStand stand)
{
  for (ClusterContact &c : stand.contacts) {
    if (c.like.empty())
      continue;
    const auto original    = std::find_if(stand.contacts.begin(), stand.contacts.end(),
                                          [&](const ClusterContact &o) { return o.pair == c.like; });
    ClusterContact contact = *original;
    contact.pair           = c.pair;
    contact.place          = c.place;
    contact.direction      = M_PI - original->direction;
    c                      = contact;
  }
  for (ClusterSupport &s : stand.supports) {
    if (s.like.empty())
      continue;
    const auto original    = std::find_if(stand.supports.begin(), stand.supports.end(),
                                          [&](const ClusterSupport &o) { return o.own_name() == s.like; });
    ClusterSupport support = *original;
    support.roll           = s.roll;
    support.name           = s.name;
    support.place          = s.place;
    support.direction      = M_PI - original->direction;
    if (!s.against.empty())
      support.against = s.against;
    s = support;
  }
  return stand;
}

int strip_roll(const ClusterStand &stand)
{
  return roll_named(stand.rolls, stand.stack.strip.substr(0, stand.stack.strip.find('-')));
}

Stack stack_of(const ClusterStand &written, const ClusterPass &pass, const double force,
               const ComputedLaws &computed)
{
  const ClusterStand stand = written_out(written);
  const auto places        = placed_rolls(stand);
  Stack stack;
  stack.gravity = stand.stack.gravity;
  stack.coupled = stand.stack.spin == ClusterSpin::coupled;
  for (std::size_t i = 0; i < stand.rolls.size(); ++i)
    stack.rolls.push_back(roll_of(stand.rolls[i], stand.steel, places[i]));
  for (const ClusterContact &in : stand.contacts) {
    Contact c;
    c.name             = in.pair;
    std::tie(c.a, c.b) = rolls_of_pair(stand, in.pair);
    c.law              = law_of(stand, in, computed);
    c.free_length      = (places[std::size_t(c.b)] - places[std::size_t(c.a)]).norm();
    c.loss_factor      = or_else(in.loss_factor, or_else(pass.loss_factor, stand.response.loss_factor));
    c.damping          = in.damping;
    c.depth            = in.damping_depth;
    c.tangential       = stack.coupled ? stand.stack.tangential_ratio : 0;
    stack.contacts.push_back(c);
  }
  for (const ClusterSupport &in : stand.supports)
    stack.supports.push_back(
        support_of(stand, in, stack.rolls, or_else(in.loss_factor, stand.response.support_loss_factor)));
  add_loads(stack, stand, pass, force);
  return stack;
}

std::vector<FreeMotion> free_motions(const Stack &stack)
{
  // Every contact closed and every support at a stiffness of one: only directions matter.
  Stack flat            = stack;
  flat.coupled          = false;
  Eigen::MatrixXd K     = Eigen::MatrixXd::Zero(flat.size(), flat.size());
  const Motion unloaded = Motion::Zero(flat.size());
  for (const Contact &c : flat.contacts) {
    const Eigen::Vector2d n = contact_state(flat, c, unloaded).normal;
    Eigen::VectorXd row     = Eigen::VectorXd::Zero(flat.size());
    row.segment<2>(2 * c.a) = -n;
    row.segment<2>(2 * c.b) = n;
    K += row * row.transpose();
  }
  for (const Support &s : flat.supports) {
    const int i = 2 * s.roll;
    if (s.type == Support::Type::guide) {
      const Eigen::Vector2d t(std::cos(s.direction), std::sin(s.direction));
      K.block<2, 2>(i, i) += t * t.transpose();
    } else if (s.type == Support::Type::rollers) {
      for (const Eigen::Vector2d &t : roller_directions(s))
        K.block<2, 2>(i, i) += t * t.transpose();
    } else {
      K.block<2, 2>(i, i) += Eigen::Matrix2d::Identity();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(K);
  std::vector<FreeMotion> motions;
  for (Eigen::Index k = 0; k < K.rows(); ++k)
    if (eigen.eigenvalues()[k] < 1e-10) {
      Eigen::Index largest = 0;
      eigen.eigenvectors().col(k).cwiseAbs().maxCoeff(&largest);
      motions.push_back({int(largest / 2), largest % 2 == 1});
    }
  return motions;
}

std::vector<NamedShape> named_shapes(const ClusterStand &stand, const Stack &stack)
{
  std::vector<NamedShape> named;
  for (const ClusterMode &mode : stand.modes)
    named.push_back({mode.name, parsed_shape(stack, mode.shape)});
  return named;
}

PassState pass_state(const ClusterStand &stand, const ClusterPass &pass, const double force,
                     const ComputedLaws &computed)
{
  PassState state;
  state.stack    = stack_of(stand, pass, force, computed);
  state.rest     = settle(state.stack);
  state.modes    = modes(state.stack, state.rest.u);
  state.identity = identified(state.stack, named_shapes(stand, state.stack), state.modes);
  return state;
}
}  // namespace mill::cluster
