#include "fem/stack/half_stack.h"
#include "core/base/errors.h"
#include "core/model/stack_statics.h"
#include "reduce/stack/stations.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace mill::fem {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
constexpr double least_radius_share = 0.03;  // b_0 of (51.17) over the smaller radius

VectorXd mean_departure(const StackRoll &roll, const ContactStations &stations)
{
  return VectorXd::NullaryExpr(stations.size(), [&](const Index k) {
    const double a = stations.from[k], b = stations.to[k], middle = reduce::radius_departure(roll, (a + b) / 2);
    return (reduce::radius_departure(roll, a) + 4 * middle + reduce::radius_departure(roll, b)) / 6;  // Simpson
  });
}

[[noreturn]] void not_held(const std::string &name)
{
  throw SolverError({"roll stack: roll " + name + " is not held", "",
                     "it has no supports, and all contacts that hold it are open",
                     "check supports and contacts of every roll, and the signs of crowns and bending forces", ""});
}
}  // namespace

double StationedContact::closing_of(const double line_load) const
{
  const double width = std::max(least_width, reduce::half_width_of(law, line_load));
  double sum         = law.ring * line_load;
  for (std::size_t i = 0; i < 2; ++i)
    sum += law.compliance[i] * line_load * std::log(reach[i] / width);
  return sum;
}

double StationedContact::slope_of(const double line_load) const
{
  const double wide = reduce::half_width_of(law, line_load), width = std::max(least_width, wide);
  double sum = law.ring;
  for (std::size_t i = 0; i < 2; ++i)
    sum += law.compliance[i] * (std::log(reach[i] / width) - (wide > least_width ? 0.5 : 0));
  return sum;
}

HalfStack::HalfStack(const Stack &s, std::vector<std::size_t> rolls,
                     const std::vector<std::shared_ptr<const RollKernel>> &kernels, const std::size_t at_the_strip,
                     const int planes, const ContactStations &at_strip, const ContactStations &read,
                     const double longest)
    : stack(s), names(std::move(rolls)), work_roll(0)
{
  for (const std::size_t r : names) {
    place[r] = stacked.size();
    stacked.emplace_back(stack.rolls[r], kernels[r], planes);
  }
  work_roll = place.at(at_the_strip);
  make_contacts(longest);
  strip_line = stacked[work_roll].add_line({0, at_the_strip == stack.upper ? -1. : 1.}, at_strip,
                                           {stack.strip.arc / 2, PatchPressure::uniform});
  read_line  = stacked[work_roll].watch_line(strip_line, read);
  for (StackedRoll &roll : stacked)
    roll.finish();
  make_blocks();
  double sum = 0;
  for (const StationedContact &c : contacts)
    sum += stacked[c.a].flexibility(c.line_a, c.line_a).diagonal().mean();
  scale = contacts.empty() ? stacked[work_roll].flexibility(strip_line, strip_line).diagonal().mean()
                           : sum / double(contacts.size());
}

void HalfStack::make_contacts(const double longest)
{
  const auto resultants = stack_resultants(stack, stack.strip.force);
  for (std::size_t c = 0; c < stack.contacts.size(); ++c) {
    const StackContact &drawn = stack.contacts[c];
    if (!holds(drawn.a))
      continue;
    const StackRoll &a = stack.rolls[drawn.a], &b = stack.rolls[drawn.b];
    StationedContact contact;
    contact.contact  = c;
    contact.a        = place.at(drawn.a);
    contact.b        = place.at(drawn.b);
    contact.stations = stations_in(reduce::contact_zones(stack, drawn), stack.strip, longest);
    contact.law = reduce::line_law(a.diameter / 2, a.material, b.diameter / 2, b.material, drawn.ring_stiffness);
    const VectorXd length = contact.stations.length();
    const double even     = std::max(resultants[c].force, 1e-3 * stack.strip.force) / length.sum();
    // The same whatever the load: the flexibility of the rolls is then one matrix for all settings of a stand.
    const double width  = least_radius_share * std::min(a.diameter, b.diameter) / 2;
    contact.least_width = width / 50;
    contact.gap         = -mean_departure(a, contact.stations) - mean_departure(b, contact.stations);
    contact.force       = even * length;
    contact.touching.assign(std::size_t(length.size()), 1);
    const auto outward = reduce::direction_of(stack, drawn);
    const LinePatch patch{width, PatchPressure::semi_ellipse};
    contact.line_a = stacked[contact.a].add_line(outward, contact.stations, patch);
    contact.line_b = stacked[contact.b].add_line({-outward[0], -outward[1]}, contact.stations, patch);
    // A body without orders of its own flattens by the whole of Johnson's law, the parabola's part of it included.
    const std::array<const StackedRoll *, 2> bodies = {&stacked[contact.a], &stacked[contact.b]};
    for (std::size_t i = 0; i < 2; ++i)
      contact.reach[i] =
          bodies[i]->has_surface() ? width * std::exp(0.25) : 4 * contact.law.radius[i] * std::exp(-0.5);
    contacts.push_back(std::move(contact));
  }
}

void HalfStack::make_blocks()
{
  std::vector<int> level(stacked.size(), 0);
  for (std::size_t round = 0; round < stacked.size(); ++round)
    for (const StationedContact &c : contacts)
      level[c.b] = std::max(level[c.b], level[c.a] + 1);
  const bool graded = std::all_of(contacts.begin(), contacts.end(),
                                  [&](const StationedContact &c) { return level[c.b] == level[c.a] + 1; });
  int levels        = 0;
  for (const StationedContact &c : contacts)
    levels = std::max(levels, level[c.b]);
  blocks.resize(std::size_t(graded ? levels : std::min(levels, 1)));
  const auto block_of = [&](const std::size_t roll) { return graded ? std::size_t(levels - 1 - level[roll]) : 0; };
  for (std::size_t c = 0; c < contacts.size(); ++c)
    blocks[block_of(contacts[c].a)].contacts.push_back(c);
  for (std::size_t r = 0; r < stacked.size(); ++r)
    if (stacked[r].motions() > 0) {
      if (level[r] >= levels)
        not_held(stack.rolls[names[r]].name);
      blocks[block_of(r)].rolls.push_back(r);
    }
}

void HalfStack::list_unknowns(Block &block) const
{
  block.unknowns.clear();
  block.size     = 0;
  const auto add = [&](Unknowns unknowns) {
    unknowns.first = block.size;
    block.size += unknowns.size();
    block.unknowns.push_back(std::move(unknowns));
  };
  for (const std::size_t c : block.contacts) {
    Unknowns forces{true, c, {}, 0};
    for (std::size_t k = 0; k < contacts[c].touching.size(); ++k)
      if (contacts[c].touching[k])
        forces.entry.push_back(Index(k));
    add(std::move(forces));
  }
  for (const std::size_t r : block.rolls) {
    Unknowns motions{false, r, {}, 0};
    for (Index m = 0; m < stacked[r].motions(); ++m)
      motions.entry.push_back(m);
    add(std::move(motions));
  }
}

// Factors of some unknowns in the equations of others, over the scale; empty where there are none.  (51.16)
MatrixXd HalfStack::coupling(const Unknowns &one, const Unknowns &other) const
{
  if (!one.is_force)
    return other.is_force ? MatrixXd(coupling(other, one).transpose()) : MatrixXd();
  const StationedContact &c = contacts[one.item];
  if (!other.is_force) {
    if (other.item == c.a)
      return -stacked[c.a].motion(c.line_a)(one.entry, other.entry);
    return other.item == c.b ? MatrixXd(-stacked[c.b].motion(c.line_b)(one.entry, other.entry)) : MatrixXd();
  }
  const StationedContact &d = contacts[other.item];
  MatrixXd sum;
  for (const auto &[roll, line] : {std::pair(c.a, c.line_a), std::pair(c.b, c.line_b)})
    for (const auto &[with, its] : {std::pair(d.a, d.line_a), std::pair(d.b, d.line_b)})
      if (roll == with) {
        if (sum.size() == 0)
          sum = MatrixXd::Zero(one.size(), other.size());
        sum += stacked[roll].flexibility(line, its)(one.entry, other.entry) / scale;
      }
  if (one.item == other.item)
    for (Index i = 0; i < one.size(); ++i) {
      const Index k = one.entry[std::size_t(i)];
      sum(i, i) += c.slope[k] / (c.stations.to[k] - c.stations.from[k]) / scale;
    }
  return sum;
}

MatrixXd HalfStack::coupling_with(const Block &block, const Block &other) const
{
  MatrixXd A = MatrixXd::Zero(block.size, other.size);
  for (const Unknowns &one : block.unknowns)
    for (const Unknowns &with : other.unknowns)
      if (const MatrixXd part = coupling(one, with); part.size() > 0)
        A.block(one.first, with.first, one.size(), with.size()) = part;
  return A;
}

MatrixXd HalfStack::coupling_with_strip(const Block &block) const
{
  const StackedRoll &work = stacked[work_roll];
  MatrixXd A              = MatrixXd::Zero(block.size, by_strip.cols());
  for (const Unknowns &one : block.unknowns) {
    auto rows = A.middleRows(one.first, one.size());
    if (!one.is_force) {
      if (one.item == work_roll)
        rows = -work.motion(strip_line).transpose();
      continue;
    }
    const StationedContact &c = contacts[one.item];
    for (const auto &[roll, line] : {std::pair(c.a, c.line_a), std::pair(c.b, c.line_b)})
      if (roll == work_roll)
        rows += work.flexibility(line, strip_line)(one.entry, Eigen::all) / scale;
  }
  return A;
}

void HalfStack::factorise()
{
  by_strip = stacked[work_roll].flexibility(strip_line, strip_line) / scale;
  for (StationedContact &c : contacts) {
    const VectorXd length = c.stations.length();
    c.slope =
        VectorXd::NullaryExpr(length.size(), [&](const Index k) { return c.slope_of(c.force[k] / length[k]); });
  }
  for (Block &block : blocks)
    list_unknowns(block);
  MatrixXd carried;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    Block &block = blocks[b];
    MatrixXd D   = coupling_with(block, block);
    if (b > 0)
      D -= carried;
    block.next = b + 1 < blocks.size() ? coupling_with(block, blocks[b + 1]) : coupling_with_strip(block);
    block.factor.compute(D);
    if (!(block.factor.rcond() > 1e-13))
      not_held(stack.rolls[names[block.rolls.empty() ? work_roll : block.rolls.front()]].name);
    block.by_next = block.factor.solve(block.next);
    carried       = block.next.transpose() * block.by_next;
  }
  if (!blocks.empty())
    by_strip -= carried;
  by_strip *= scale;
}

VectorXd HalfStack::taken(const Block &block, const HalfVector &from) const
{
  VectorXd r(block.size);
  for (const Unknowns &u : block.unknowns)
    if (u.is_force)
      r.segment(u.first, u.size()) = -from.contact[u.item](u.entry) / scale;
    else
      r.segment(u.first, u.size()) = -from.motion[u.item];
  return r;
}

void HalfStack::put(const Block &block, const VectorXd &x, HalfVector &to) const
{
  for (const Unknowns &u : block.unknowns)
    if (u.is_force)
      to.contact[u.item](u.entry) += x.segment(u.first, u.size());
    else
      to.motion[u.item] += scale * x.segment(u.first, u.size());
}

HalfVector HalfStack::zero() const
{
  HalfVector v;
  for (const StationedContact &c : contacts)
    v.contact.push_back(VectorXd::Zero(c.stations.size()));
  for (const StackedRoll &roll : stacked)
    v.motion.push_back(VectorXd::Zero(roll.motions()));
  v.strip = VectorXd::Zero(stacked[work_roll].flexibility(strip_line, strip_line).rows());
  return v;
}

HalfVector HalfStack::without_strip(const HalfVector &right) const
{
  HalfVector solution = zero();
  solution.strip      = right.strip;
  std::vector<VectorXd> x;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    VectorXd r = taken(blocks[b], right);
    if (b > 0)
      r -= blocks[b - 1].next.transpose() * x.back();
    x.push_back(blocks[b].factor.solve(r));
  }
  if (!blocks.empty())
    solution.strip += scale * (blocks.back().next.transpose() * x.back());
  for (std::size_t b = blocks.size(); b-- > 0;) {
    if (b + 1 < blocks.size())
      x[b] -= blocks[b].by_next * x[b + 1];
    put(blocks[b], x[b], solution);
  }
  return solution;
}

void HalfStack::add_strip(HalfVector &solution, const VectorXd &strip_force) const
{
  solution.strip += by_strip * strip_force;
  VectorXd x;
  for (std::size_t b = blocks.size(); b-- > 0;) {
    x = -(blocks[b].by_next * (b + 1 < blocks.size() ? x : strip_force));
    put(blocks[b], x, solution);
  }
}

HalfVector HalfStack::right_of(const std::function<RollAnswer(std::size_t)> &answer_of) const
{
  HalfVector right = zero();
  std::vector<RollAnswer> answers;
  for (std::size_t r = 0; r < stacked.size(); ++r) {
    answers.push_back(answer_of(r));
    right.motion[r] = answers[r].resultant;
  }
  for (std::size_t c = 0; c < contacts.size(); ++c)
    right.contact[c] =
        answers[contacts[c].a].offset[contacts[c].line_a] + answers[contacts[c].b].offset[contacts[c].line_b];
  right.strip = answers[work_roll].offset[strip_line];
  return right;
}

HalfVector HalfStack::unloaded() const
{
  HalfVector right = right_of([&](const std::size_t r) { return stacked[r].unloaded(); });
  for (std::size_t c = 0; c < contacts.size(); ++c)
    right.contact[c] += contacts[c].gap;
  return right;
}

HalfVector HalfStack::of_loads(const std::size_t roll, const std::vector<StackLoad> &loads) const
{
  return right_of([&](const std::size_t r) {
    return stacked[r].answer_to(names[r] == roll ? loads : std::vector<StackLoad>());
  });
}

std::vector<std::pair<std::size_t, std::size_t>> HalfStack::lines_on(const std::size_t roll) const
{
  std::vector<std::pair<std::size_t, std::size_t>> lines;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts[c].a == roll)
      lines.emplace_back(c, contacts[c].line_a);
    if (contacts[c].b == roll)
      lines.emplace_back(c, contacts[c].line_b);
  }
  return lines;
}

std::vector<VectorXd> HalfStack::openings(const HalfVector &state, const VectorXd &strip_force,
                                          const HalfVector &right) const
{
  std::vector<VectorXd> open = right.contact;
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (const auto &[roll, line] :
         {std::pair(contacts[c].a, contacts[c].line_a), std::pair(contacts[c].b, contacts[c].line_b)}) {
      for (const auto &[d, its] : lines_on(roll))
        open[c] += stacked[roll].flexibility(line, its) * state.contact[d];
      if (roll == work_roll)
        open[c] += stacked[roll].flexibility(line, strip_line) * strip_force;
      if (stacked[roll].motions() > 0)
        open[c] -= stacked[roll].motion(line) * state.motion[roll];
    }
  return open;
}

VectorXd HalfStack::read(const HalfVector &state, const VectorXd &strip_force) const
{
  const StackedRoll &work = stacked[work_roll];
  VectorXd u              = work.flexibility(read_line, strip_line) * strip_force;
  for (const auto &[c, line] : lines_on(work_roll))
    u += work.flexibility(read_line, line) * state.contact[c];
  if (work.motions() > 0)
    u -= work.motion(read_line) * state.motion[work_roll];
  return u;
}

VectorXd HalfStack::read_unloaded() const
{
  return stacked[work_roll].unloaded().offset[read_line];
}

VectorXd HalfStack::read_of_loads(const std::size_t roll, const std::vector<StackLoad> &loads) const
{
  return stacked[work_roll]
      .answer_to(names[work_roll] == roll ? loads : std::vector<StackLoad>())
      .offset[read_line];
}

std::vector<VectorXd> HalfStack::forces_on(const std::size_t roll, const HalfVector &state,
                                           const VectorXd &strip_force) const
{
  std::vector<VectorXd> forces(lines_on(roll).size() + (roll == work_roll ? 2 : 0));
  for (const auto &[c, line] : lines_on(roll))
    forces[line] = state.contact[c];
  if (roll == work_roll)
    forces[strip_line] = strip_force;
  return forces;
}

StackedRoll::Deflection HalfStack::deflection(const std::size_t roll, const HalfVector &state,
                                              const VectorXd &strip_force) const
{
  const std::size_t r = place.at(roll);
  return stacked[r].deflection(forces_on(r, state, strip_force), state.motion[r]);
}

double HalfStack::imbalance(const HalfVector &state, const VectorXd &strip_force) const
{
  double most = 0;
  for (std::size_t r = 0; r < stacked.size(); ++r) {
    if (stacked[r].motions() == 0)
      continue;
    VectorXd left = stacked[r].unloaded().resultant;
    const auto of = forces_on(r, state, strip_force);
    for (std::size_t line = 0; line < of.size(); ++line)
      if (of[line].size() > 0)
        left -= stacked[r].motion(line).transpose() * of[line];
    for (Index i = 0; i < left.size(); i += 2)
      most = std::max(most, std::abs(left[i]));
  }
  return most;
}
}  // namespace mill::fem
