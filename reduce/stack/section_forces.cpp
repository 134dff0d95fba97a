#include "reduce/stack/section_forces.h"
#include "reduce/stack/stations.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace mill::reduce {
namespace {
// A force on the axis, even over a length that may be zero.
struct SpreadForce {
  double from, to;              // m, mill frame
  std::array<double, 2> force;  // N
};

// Stations of a line load as pieces next to each other, each as long as its weight.
void add_line_load(std::vector<SpreadForce> &all, const PairState &pair, const std::array<double, 2> &direction)
{
  for (Eigen::Index i = 0; i < pair.z.size(); ++i) {
    const double force = pair.weight[i] * pair.load[i], half = pair.weight[i] / 2;
    if (force > 0)
      all.push_back({pair.z[i] - half, pair.z[i] + half, {force * direction[0], force * direction[1]}});
  }
}

std::vector<SpreadForce> forces_on(const Stack &stack, const StackState &state, const std::size_t r)
{
  const StackRoll &roll = stack.rolls[r];
  std::vector<SpreadForce> all;
  for (std::size_t c = 0; c < stack.contacts.size(); ++c) {
    const StackContact &contact = stack.contacts[c];
    if (contact.a != r && contact.b != r)
      continue;
    const auto n      = direction_of(stack, contact);
    const double sign = contact.a == r ? -1 : 1;  // pushes a along -n, b along n
    add_line_load(all, state.pairs[c], {sign * n[0], sign * n[1]});
  }
  for (const auto &[work_roll, sign] : {std::pair(stack.upper, 1.), std::pair(stack.lower, -1.)})
    for (Eigen::Index i = 0; work_roll == r && i < state.strip.load.size(); ++i) {
      const double from = state.strip.edges[i] + stack.strip.offset,
                   to   = state.strip.edges[i + 1] + stack.strip.offset;
      all.push_back({from, to, {0, sign * state.strip.load[i] * (to - from)}});
    }
  for (std::size_t s = 0; s < roll.supports.size(); ++s) {
    const double z = roll.supports[s].z + roll.shift;
    all.push_back({z, z, {state.rolls[r].across[s], state.rolls[r].reactions[s]}});
  }
  for (const StackLoad &load : roll.loads)
    all.push_back({load.z + roll.shift, load.z + roll.shift, load.force});
  return all;
}

// The thinner of the sections that meet at a place.
double thinner_diameter_at(const StackRoll &roll, const double z)
{
  constexpr double there = 1e-6;  // m
  double diameter        = INFINITY;
  for (const StackSection &section : roll.sections)
    if (z - roll.shift > section.from - there && z - roll.shift < section.to + there)
      diameter = std::min(diameter, section.diameter);
  return diameter;
}

SectionForces forces_at(const Stack &stack, const StackState &state, const std::size_t roll,
                        const Eigen::VectorXd &z_of)
{
  SectionForces out;
  out.z      = z_of;
  out.moment = out.shear = Eigen::MatrixXd::Zero(out.z.size(), 2);
  out.stress             = Eigen::VectorXd::Zero(out.z.size());
  const auto forces      = forces_on(stack, state, roll);
  for (Eigen::Index i = 0; i < out.z.size(); ++i) {
    const double z = out.z[i];
    for (const SpreadForce &f : forces) {
      if (f.from >= z)
        continue;
      const double length = f.to - f.from, share = length > 0 ? std::min(1., (z - f.from) / length) : 1;
      const double lever = z - (f.from + std::min(f.to, z)) / 2;
      for (int axis = 0; axis < 2; ++axis) {
        out.shear(i, axis) += share * f.force[std::size_t(axis)];
        out.moment(i, axis) += share * f.force[std::size_t(axis)] * lever;
      }
    }
    const double d = thinner_diameter_at(stack.rolls[roll], z);
    out.stress[i]  = std::isfinite(d) ? 32 * out.moment.row(i).norm() / (M_PI * d * d * d) : 0;
  }
  return out;
}
}  // namespace

SectionForces section_forces(const Stack &stack, const StackState &state, const std::size_t roll)
{
  return forces_at(stack, state, roll, state.rolls[roll].z);
}

double largest_bending_stress(const Stack &stack, const StackState &state, const std::size_t roll)
{
  const StackRoll &of          = stack.rolls[roll];
  const Eigen::VectorXd &known = state.rolls[roll].z;
  std::vector<double> places(known.begin(), known.end());
  for (const StackSection &section : of.sections)
    for (const double z : {section.from, section.to})
      places.push_back(z + of.shift);
  for (const StackSupport &support : of.supports)
    places.push_back(support.z + of.shift);
  for (const StackLoad &load : of.loads)
    places.push_back(load.z + of.shift);
  return forces_at(stack, state, roll,
                   Eigen::Map<const Eigen::VectorXd>(places.data(), Eigen::Index(places.size())))
      .stress.maxCoeff();
}
}  // namespace mill::reduce
