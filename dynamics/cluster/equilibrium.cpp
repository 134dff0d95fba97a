#include "dynamics/cluster/equilibrium.h"
#include "core/base/errors.h"
#include "core/numerics/eigen_instances.h"
#include "dynamics/cluster/modes.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::cluster {
namespace {
bool behind_rollers(const Stack &stack, const int roll)
{
  return std::any_of(stack.supports.begin(), stack.supports.end(),
                     [&](const Support &s) { return s.roll == roll && s.type == Support::Type::rollers; });
}

// A secant at the force it carries, or the one at the force of the pass before that is known.
double secant_of(const ContactLaw &law, const double force)
{
  return force / approach(law, force);
}
double secant_of(const BearingLaw &law, const double force)
{
  return force / (law.kappa * std::pow(force, law.q));
}

// Direction in which a support is a spring; a bearing in the plane is one in every direction.
Eigen::Matrix2d directions_of(const Support &s)
{
  const Eigen::Vector2d t(std::cos(s.direction), std::sin(s.direction));
  return s.type == Support::Type::guide ? Eigen::Matrix2d(t * t.transpose()) : Eigen::Matrix2d::Identity();
}

// Springs at their secants, one for each contact and support of the column.
struct Secants {
  std::vector<double> contacts, supports;  // N/m
};

Eigen::MatrixXd secant_matrix(const Stack &stack, const std::vector<char> &left_out, const Secants &k)
{
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(stack.size(), stack.size());
  for (std::size_t i = 0; i < stack.contacts.size(); ++i) {
    const Contact &c = stack.contacts[i];
    if (c.strip || left_out[std::size_t(c.a)] || left_out[std::size_t(c.b)])
      continue;
    const Eigen::Vector2d n     = contact_state(stack, c, Motion::Zero(stack.size())).normal;
    const Eigen::Matrix2d block = k.contacts[i] * n * n.transpose();
    const int a = 2 * c.a, b = 2 * c.b;
    K.block<2, 2>(a, a) += block;
    K.block<2, 2>(b, b) += block;
    K.block<2, 2>(a, b) -= block;
    K.block<2, 2>(b, a) -= block;
  }
  for (std::size_t i = 0; i < stack.supports.size(); ++i)
    if (const Support &s = stack.supports[i]; !left_out[std::size_t(s.roll)])
      K.block<2, 2>(2 * s.roll, 2 * s.roll) += k.supports[i] * directions_of(s);
  return K;
}

// New secants from the forces that the old ones carry; the largest relative change.
double follow(const Stack &stack, const std::vector<char> &left_out, const Motion &u, const double least,
              Secants &k)
{
  double change     = 0;
  const auto update = [&](double &value, const double wanted) {
    change = std::max(change, std::abs(wanted / value - 1));
    value  = wanted;
  };
  for (std::size_t i = 0; i < stack.contacts.size(); ++i) {
    const Contact &c = stack.contacts[i];
    if (c.strip || left_out[std::size_t(c.a)] || left_out[std::size_t(c.b)])
      continue;
    const Eigen::Vector2d n = contact_state(stack, c, Motion::Zero(stack.size())).normal;
    const double f          = k.contacts[i] * n.dot(u.segment<2>(2 * c.a) - u.segment<2>(2 * c.b));
    update(k.contacts[i], c.one_sided ? secant_of(c.law, std::max(f, least)) : c.law.k);
  }
  for (std::size_t i = 0; i < stack.supports.size(); ++i)
    if (const Support &s = stack.supports[i]; !left_out[std::size_t(s.roll)]) {
      const double f = k.supports[i] * (directions_of(s) * u.segment<2>(2 * s.roll)).norm();
      update(k.supports[i], secant_of(s.law, std::max(f, least)));
    }
  return change;
}

std::string roll_at(const Stack &stack, const Eigen::Index unknown)
{
  return fmt::format("{} {}", stack.rolls[std::size_t(unknown / 2)].name, unknown % 2 ? "y" : "x");
}

[[noreturn]] void refuse_load(const Stack &stack, const Eigen::VectorXd &missing)
{
  Eigen::Index worst = 0;
  missing.cwiseAbs().maxCoeff(&worst);
  throw SolverError({fmt::format("stack: nothing takes up the load of roll {} along {}",
                                 stack.rolls[std::size_t(worst / 2)].name, worst % 2 ? "y" : "x"),
                     fmt::format("{:.4g} N are left over", std::abs(missing[worst])),
                     "no support or contact acts in this direction",
                     "add a [[support]] or a [[contact]] that does", ""});
}

// Least-squares solution, so that a direction without stiffness and without load stays at rest.
Eigen::VectorXd solve_supported(const Stack &stack, const Eigen::MatrixXd &K, const Eigen::VectorXd &f)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(K);
  const double least      = 1e-12 * eigen.eigenvalues().cwiseAbs().maxCoeff();
  Eigen::VectorXd x       = Eigen::VectorXd::Zero(f.size());
  Eigen::VectorXd missing = f;
  for (Eigen::Index i = 0; i < f.size(); ++i)
    if (std::abs(eigen.eigenvalues()[i]) > least) {
      const auto v = eigen.eigenvectors().col(i);
      x += v.dot(f) / eigen.eigenvalues()[i] * v;
      missing -= v.dot(f) * v;
    }
  if (missing.cwiseAbs().maxCoeff() > 1e-9 * f.cwiseAbs().maxCoeff())
    refuse_load(stack, missing);
  return x;
}
}  // namespace

Motion closed_form_approaches(const Stack &stack)
{
  Stack flat   = stack;
  flat.coupled = false;
  std::vector<char> left_out(stack.rolls.size());
  for (std::size_t i = 0; i < left_out.size(); ++i)
    left_out[i] = behind_rollers(stack, int(i));
  Eigen::VectorXd f = Eigen::VectorXd::Zero(flat.size());
  for (const Load &load : stack.loads)
    f.segment<2>(2 * load.roll) += load.force;
  const double largest = f.cwiseAbs().maxCoeff();
  if (largest == 0)
    return f;
  Secants k;
  for (const Contact &c : stack.contacts)
    k.contacts.push_back(secant_of(c.law, largest));
  for (const Support &s : stack.supports)
    k.supports.push_back(secant_of(s.law, largest));
  Motion u = f;
  for (int i = 0; i < 300; ++i) {
    Eigen::MatrixXd K = secant_matrix(flat, left_out, k);
    u                 = solve_supported(flat, K, f);
    if (follow(flat, left_out, u, 1e-6 * largest, k) < 1e-14)
      break;
  }
  return u;
}

void set_rollers(Stack &stack, const Motion &start)
{
  for (Support &s : stack.supports) {
    if (s.type != Support::Type::rollers)
      continue;
    s.anchor.setZero();
    if (s.against < 0)
      continue;
    const Eigen::Vector2d outwards(std::cos(s.direction), std::sin(s.direction));
    for (const Contact &c : stack.contacts)
      if ((c.a == s.roll && c.b == s.against) || (c.b == s.roll && c.a == s.against))
        s.anchor = start.segment<2>(2 * s.against) -
                   approach(c.law, 2 * s.preload * std::cos(s.half_angle)) * outwards;  // (38.10)
  }
}

Equilibrium equilibrium(const Stack &stack, const EquilibriumOptions &options, const Motion &start)
{
  Stack flat   = stack;
  flat.coupled = false;
  Equilibrium e;
  e.u = start.size() == flat.size() ? start : closed_form_approaches(flat);
  if (start.size() != flat.size())
    for (const Support &s : flat.supports)
      if (s.type == Support::Type::rollers)
        e.u.segment<2>(2 * s.roll) = s.anchor;
  Eigen::VectorXd r   = forces(flat, e.u).total;
  const double wanted = 1e-11 * std::max(1., forces(flat, e.u).loads.cwiseAbs().maxCoeff());
  bool polished       = false;
  for (; e.steps < options.most_steps && !polished; ++e.steps) {
    polished                 = r.cwiseAbs().maxCoeff() < wanted;  // one step more than needed: to rounding
    const Eigen::VectorXd dx = total_tangent(flat, e.u).partialPivLu().solve(r);
    if (!dx.allFinite())
      break;
    double share        = std::min(1., options.step_cap / std::max(dx.cwiseAbs().maxCoeff(), 1e-300));
    const double before = r.norm();
    for (int halving = 0; halving < 8; ++halving, share /= 2) {
      const Motion tried          = e.u + share * dx;
      const Eigen::VectorXd after = forces(flat, tried).total;
      if (after.norm() < before || halving == 7 || polished) {
        if (polished && after.norm() > before)
          break;
        e.u = tried;
        r   = after;
        break;
      }
    }
  }
  Eigen::Index worst = 0;
  e.residual         = r.cwiseAbs().maxCoeff(&worst);
  if (!(e.residual < 100 * wanted))
    throw SolverError({"stack: no equilibrium under the loads of the pass",
                       fmt::format("after {} steps {:.3g} N are left over at roll {}", e.steps, e.residual,
                                   roll_at(flat, worst)),
                       "the stack buckles, or a roll that has left its contact is held by nothing",
                       "a stiffer guide of that roll, more preload, a smaller force", ""});
  for (const Contact &c : flat.contacts) {
    const double d = contact_state(flat, c, e.u).approach;
    e.contact_loads.push_back(contact_force(c, d));
  }
  e.least_root = least_root(flat, e.u);
  return e;
}

Equilibrium settle(Stack &stack, const EquilibriumOptions &options)
{
  set_rollers(stack, closed_form_approaches(stack));
  for (Contact &c : stack.contacts)
    if (c.strip)
      c.free_length = 0;
  Equilibrium e = equilibrium(stack, options);
  bool relaxed  = false;
  for (Contact &c : stack.contacts)
    if (c.strip) {
      c.free_length = contact_state(stack, c, e.u).distance;
      relaxed       = true;
    }
  if (relaxed) {  // the common rolling of a train has a root of zero, which is rounding of either sign
    Stack flat   = stack;
    flat.coupled = false;
    e.least_root = least_root(flat, e.u);
  }
  return e;
}
}  // namespace mill::cluster
