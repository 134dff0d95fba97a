#include "fem/stack/half_stack.h"
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
constexpr double wider              = 1.5;   // b_0 over the one before, where a load needs more

VectorXd mean_departure(const StackRoll &roll, const ContactStations &stations)
{
  return VectorXd::NullaryExpr(stations.size(), [&](const Index k) {
    const double a = stations.from[k], b = stations.to[k], middle = reduce::radius_departure(roll, (a + b) / 2);
    return (reduce::radius_departure(roll, a) + 4 * middle + reduce::radius_departure(roll, b)) / 6;  // Simpson
  });
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
                     const double longest_station)
    : stack(s), names(std::move(rolls)), work_roll(0), at_strip_line(at_strip), at_read_line(read),
      longest(longest_station)
{
  for (const std::size_t r : names) {
    place[r] = stacked.size();
    stacked.emplace_back(stack.rolls[r], kernels[r], planes);
  }
  work_roll = place.at(at_the_strip);
  make_contacts();
  add_lines(std::vector<char>(stacked.size(), 1));
  for (StackedRoll &roll : stacked)
    roll.finish();
  make_nodes();
  double sum = 0;
  for (const StationedContact &c : contacts)
    sum += stacked[c.a].flexibility(c.line_a, c.line_a).diagonal().mean();
  scale = contacts.empty() ? stacked[work_roll].flexibility(strip_line, strip_line).diagonal().mean()
                           : sum / double(contacts.size());
}

// Zones, and an even load to begin with.
void HalfStack::place_stations(StationedContact &contact, const double force) const
{
  const StackContact &drawn = stack.contacts[contact.contact];
  const Index before        = contact.stations.size();
  contact.stations          = stations_in(reduce::contact_zones(stack, drawn), stack.strip, longest);
  if (contact.stations.size() == before)
    return;  // moved a little: the load of before is the better guess
  const VectorXd length = contact.stations.length();
  contact.force         = std::max(force, 1e-3 * stack.strip.force) / length.sum() * length;
  contact.touching.assign(std::size_t(length.size()), 1);
}

void HalfStack::set_width(StationedContact &contact, const double width) const
{
  contact.width = width;
  // A body without orders of its own flattens by the whole of Johnson's law, the parabola's part of it included.
  const std::array<const StackedRoll *, 2> bodies = {&stacked[contact.a], &stacked[contact.b]};
  for (std::size_t i = 0; i < 2; ++i)
    contact.reach[i] =
        bodies[i]->has_surface() ? width * std::exp(0.25) : 4 * contact.law.radius[i] * std::exp(-0.5);
}

// The least of b_0, 1.5 b_0, .. that is at least the half width under the largest line load: far beyond b_0
// the slope of (51.17) takes away more than the flexibility of the rolls has. What a solved state has follows from
// its loads and not from the states before it.
double HalfStack::width_for(const StationedContact &contact) const
{
  const double most       = contact.force.cwiseQuotient(contact.stations.length()).maxCoeff();
  const double least      = reduce::half_width_of(contact.law, std::max(most, 0.));
  const double most_width = std::min(contact.law.radius[0], contact.law.radius[1]);
  double width            = contact.first_width;
  while (width < least && width < most_width)
    width *= wider;
  return width;
}

bool HalfStack::fit_widths(const bool may_shrink)
{
  std::vector<char> again(stacked.size(), 0);
  for (StationedContact &contact : contacts) {
    const double width = width_for(contact);
    if (width <= contact.width && !(may_shrink && width < contact.width))
      continue;
    set_width(contact, width);
    again[contact.a] = again[contact.b] = 1;
  }
  add_again(again);
  return std::find(again.begin(), again.end(), 1) != again.end();
}

void HalfStack::make_contacts()
{
  const auto resultants = stack_resultants(stack, stack.strip.force);
  for (std::size_t c = 0; c < stack.contacts.size(); ++c) {
    const StackContact &drawn = stack.contacts[c];
    if (!holds(drawn.a))
      continue;
    const StackRoll &a = stack.rolls[drawn.a], &b = stack.rolls[drawn.b];
    StationedContact contact;
    contact.contact = c;
    contact.a       = place.at(drawn.a);
    contact.b       = place.at(drawn.b);
    contact.law = reduce::line_law(a.diameter / 2, a.material, b.diameter / 2, b.material, drawn.ring_stiffness);
    // The same whatever the load: the flexibility of the rolls is then one matrix for all settings of a stand.
    contact.first_width = least_radius_share * std::min(a.diameter, b.diameter) / 2;
    contact.least_width = contact.first_width / 50;
    set_width(contact, contact.first_width);
    place_stations(contact, resultants[c].force);
    contact.gap = -mean_departure(a, contact.stations) - mean_departure(b, contact.stations);
    contacts.push_back(std::move(contact));
  }
}

// Of each roll in the order of its contacts, then the strip.
void HalfStack::add_lines(const std::vector<char> &of_roll)
{
  for (StationedContact &contact : contacts) {
    const auto outward = reduce::direction_of(stack, stack.contacts[contact.contact]);
    const LinePatch patch{contact.width, PatchPressure::semi_ellipse};
    if (of_roll[contact.a])
      contact.line_a = stacked[contact.a].add_line(outward, contact.stations, patch);
    if (of_roll[contact.b])
      contact.line_b = stacked[contact.b].add_line({-outward[0], -outward[1]}, contact.stations, patch);
  }
  if (!of_roll[work_roll])
    return;
  strip_line = stacked[work_roll].add_line({0, names[work_roll] == stack.upper ? -1. : 1.}, at_strip_line,
                                           {stack.strip.arc / 2, PatchPressure::uniform});
  read_line  = stacked[work_roll].watch_line(strip_line, at_read_line);
}

bool HalfStack::follow(const Stack &before)
{
  std::vector<char> again(stacked.size(), 0);
  const auto shifted = [&](const std::size_t r) {
    return stack.rolls[names[r]].shift != before.rolls[names[r]].shift;
  };
  for (std::size_t r = 0; r < stacked.size(); ++r) {
    const auto &now = stack.rolls[names[r]].supports, &was = before.rolls[names[r]].supports;
    again[r] = shifted(r) || !std::equal(now.begin(), now.end(), was.begin(), was.end(),
                                         [](const StackSupport &one, const StackSupport &other) {
                                           return one.z == other.z && one.stiffness == other.stiffness;
                                         });
  }
  const auto resultants = stack_resultants(stack, stack.strip.force);
  for (StationedContact &c : contacts) {
    if (shifted(c.a) || shifted(c.b)) {
      again[c.a] = again[c.b] = 1;
      place_stations(c, resultants[c.contact].force);
    }
    c.gap =
        -mean_departure(stack.rolls[names[c.a]], c.stations) - mean_departure(stack.rolls[names[c.b]], c.stations);
  }
  add_again(again);
  for (std::size_t r = 0; r < stacked.size(); ++r)
    if (!again[r])
      stacked[r].take_loads();
  return std::find(again.begin(), again.end(), 1) != again.end();
}

// All lines of some rolls as their contacts are now.
void HalfStack::add_again(const std::vector<char> &rolls)
{
  for (std::size_t r = 0; r < stacked.size(); ++r)
    if (rolls[r])
      stacked[r].forget_lines();
  add_lines(rolls);
  for (std::size_t r = 0; r < stacked.size(); ++r)
    if (rolls[r])
      stacked[r].finish();
}

void HalfStack::make_nodes()
{
  for (std::size_t c = 0; c < contacts.size(); ++c)
    nodes.push_back({true, c, {}});
  for (std::size_t r = 0; r < stacked.size(); ++r) {
    const Index motions = stacked[r].motions();
    if (motions == 0)
      continue;
    if (std::none_of(contacts.begin(), contacts.end(), [&](const StationedContact &c) { return c.a == r; }))
      not_held(r);
    Unknowns of_roll{false, r, {}};
    for (Index m = 0; m < motions; ++m)
      of_roll.entry.push_back(m);
    nodes.push_back(std::move(of_roll));
  }
  std::vector<char> positive;
  for (const Unknowns &node : nodes)
    positive.push_back(node.is_force);
  positive.push_back(1);
  factors = BlockFactors(graph(), std::move(positive), order_of_elimination());
}

std::vector<VectorXd> HalfStack::nothing() const
{
  std::vector<VectorXd> x;
  for (const Unknowns &node : nodes)
    x.push_back(VectorXd::Zero(node.size()));
  x.push_back(VectorXd::Zero(by_strip.rows()));
  return x;
}

void HalfStack::put(const std::vector<VectorXd> &x, HalfVector &to) const
{
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].is_force)
      to.contact[nodes[i].item](nodes[i].entry) += x[i];
    else
      to.motion[nodes[i].item] += scale * x[i];
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
  std::vector<VectorXd> x = nothing();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    x[i] = nodes[i].is_force ? VectorXd(-right.contact[nodes[i].item](nodes[i].entry) / scale)
                             : VectorXd(-right.motion[nodes[i].item]);
  factors.forward(x);
  HalfVector solution = zero();
  solution.strip      = right.strip - scale * x.back();
  x.back().setZero();
  factors.backward(x);
  put(x, solution);
  return solution;
}

void HalfStack::add_strip(HalfVector &solution, const VectorXd &strip_force) const
{
  std::vector<VectorXd> x = nothing();
  x.back()                = strip_force;
  factors.backward(x);
  put(x, solution);
  solution.strip += by_strip * strip_force;
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
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto &touching = contacts[c].touching;
    if (std::find(touching.begin(), touching.end(), 0) == touching.end()) {
      open[c].setZero();
      continue;
    }
    for (const auto &[roll, line] :
         {std::pair(contacts[c].a, contacts[c].line_a), std::pair(contacts[c].b, contacts[c].line_b)}) {
      for (const auto &[d, its] : lines_on(roll))
        open[c] += stacked[roll].flexibility(line, its) * state.contact[d];
      if (roll == work_roll)
        open[c] += stacked[roll].flexibility(line, strip_line) * strip_force;
      if (stacked[roll].motions() > 0)
        open[c] -= stacked[roll].motion(line) * state.motion[roll];
    }
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
