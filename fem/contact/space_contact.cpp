#include "fem/contact/space_contact.h"
#include "core/base/errors.h"
#include "fem/contact/hertz.h"
#include "fem/contact/row_refinement.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace mill::contact {
namespace {
// Expected half axes of the contact and where its middle lies.
struct Expected {
  double half_x, half_z, middle_z;
  bool point;
};

Expected expected(const SpaceShape &s, const double load, const double tilt)
{
  if (s.is_point(load, tilt)) {
    const auto ellipse = hertz_point(load, s.radius, 1 / s.curvature, s.modulus);
    return {ellipse.semi_x, ellipse.semi_y, tilt / s.curvature, true};
  }
  return {hertz_line(load / s.length, s.radius, s.modulus).half_width, 0.5 * s.length, 0, false};
}

Eigen::VectorXd mirrored(const Eigen::VectorXd &edges)
{
  Eigen::VectorXd both(2 * edges.size() - 1);
  both << -edges.reverse(), edges.tail(edges.size() - 1);
  return both;
}

// Shortest row along a line contact, at the ends of the face.
double shortest_row(const SpaceShape &s, const Expected &e, const int rectangles)
{
  return 12. / rectangles * std::min(e.half_x / 5, s.length / 200);
}

// A grid that reaches `wide` expected half axes.
QuarterGrid grid_for(const SpaceShape &s, const Expected &e, const double wide, const double tilt,
                     const int rectangles)
{
  QuarterGrid grid;
  grid.n_x   = int(std::ceil(wide * rectangles));
  grid.width = e.half_x / rectangles;
  grid.half  = tilt != 0 || !s.symmetric;
  if (e.point) {
    const double reach = wide * e.half_z;
    const double low   = grid.half ? std::max(e.middle_z - reach, -0.5 * s.length) : 0,
                 high  = std::min(e.middle_z + reach, 0.5 * s.length);
    // Half as wide rows as the axes would have it are too many on a half: an ellipse is smooth along its axes.
    const int rows = std::max(4, int(std::ceil((high - low) / e.half_z * rectangles)));
    grid.z         = Eigen::VectorXd::LinSpaced(rows + 1, low, high);
  } else {
    const double in_middle   = 12. / rectangles * s.length / (grid.half ? 36 : 50);
    const Eigen::VectorXd up = graded_edges(e.half_z, in_middle, shortest_row(s, e, rectangles), 1.4);
    grid.z                   = grid.half ? mirrored(up) : up;
  }
  return grid;
}

// Half axis along z by the pressures of the column next to x = 0, on the longer side of the middle.
double half_axis(const HalfSpaceState &s, const double middle)
{
  std::vector<double> z, p;
  for (Eigen::Index j = 0; j < s.z.size(); ++j)
    if (s.z[j] >= middle && s.pressure(0, j) > 0) {
      z.push_back(s.z[j] - middle);
      p.push_back(s.pressure(0, j));
    }
  return fit_pressure(z, p).half_width;
}

struct LoadedRows {
  double length, last;  // m, of all that carry, and of those next to one that does not
};

LoadedRows loaded_rows(const QuarterGrid &grid, const HalfSpaceState &s)
{
  LoadedRows rows{0, 0};
  const Eigen::Index n = s.z.size();
  const auto carries   = [&](const Eigen::Index j) { return s.line_load[j] > 0; };
  for (Eigen::Index j = 0; j < n; ++j)
    if (carries(j)) {
      const double row = grid.z[j + 1] - grid.z[j];
      rows.length += row;
      rows.last += row * ((j > 0 && !carries(j - 1)) + (j + 1 < n && !carries(j + 1)));
    }
  const double sides = grid.half ? 1 : 2;
  return {sides * rows.length, sides * rows.last};
}

int row_of_results(const HalfSpaceState &s, const bool point)
{
  Eigen::Index row = 0;
  if (point)
    s.line_load.maxCoeff(&row);
  else
    s.z.cwiseAbs().minCoeff(&row);
  return int(row);
}

// The rows of a half are mirrored, so that mid-length is the edge of two of them.
void read_row(SpaceAnswer &a, const bool point)
{
  const auto &s       = a.state;
  const int n         = int(s.z.size());
  const bool two_rows = !point && a.grid.half;
  const auto middle   = [&](const Eigen::VectorXd &v) {
    return two_rows ? 0.5 * (v[n / 2 - 1] + v[n / 2]) : v[a.row];
  };
  a.half_width    = middle(s.half_width);
  a.peak_pressure = middle(s.line_load) > 0 ? middle(s.peak_pressure) : not_given;
}

const char *const too_narrow = "half space: the contact is wider than the grid";

// Solves on the grid of the answer and then on finer rows where the line load bends: at the beginning of a relief
// and at the end of the contact, neither of which is known before.  theory.md 33.3
void solve_with_fine_rows(SpaceAnswer &a, const SpaceShape &shape, const double tilt, const double load,
                          const int rectangles, const double least)
{
  constexpr int most_rounds = 6, most_unknowns = 4000;
  const double bend = 0.04 * 12 / rectangles;  // of the largest line load: it is off by less than half of that
  std::optional<HalfSpaceContact> contact;
  for (int round = 0;; ++round) {
    contact.emplace(shape.bodies, a.grid, shape.gap(tilt));
    a.state                     = contact->at_load(load);
    const Eigen::VectorXd finer = refined_rows(a.grid, a.state, bend, least);
    if (round == most_rounds || finer.size() == a.grid.z.size() || a.grid.n_x * finer.size() > most_unknowns)
      break;
    a.grid.z = finer;
  }
  a.tangent = contact->tangent(load);
  a.state   = contact->at_load(load);
}

void solve_on_grid(SpaceAnswer &a, const SpaceShape &shape, const double tilt, const double load)
{
  HalfSpaceContact contact(shape.bodies, a.grid, shape.gap(tilt));
  a.tangent = contact.tangent(load);
  a.state   = contact.at_load(load);
}
}  // namespace

SpaceAnswer solve_in_space(const SpaceShape &shape, const double load, const double tilt, const int rectangles,
                           const SpaceRows rows)
{
  const Expected e = expected(shape, load, tilt);
  // Tilt, sharp ends and reliefs gather the load: the contact is wider there than under an even load.
  for (const double wide : {1.25, 1.7, 2.4, 3.4, 5., 8.}) {
    SpaceAnswer a;
    a.grid = grid_for(shape, e, wide, tilt, rectangles);
    try {
      if (rows == SpaceRows::refined && !e.point && shape.relieved)
        solve_with_fine_rows(a, shape, tilt, load, rectangles, shortest_row(shape, e, rectangles));
      else
        solve_on_grid(a, shape, tilt, load);
    } catch (const SolverError &error) {
      if (std::string(error.what()).find(too_narrow) == std::string::npos || wide == 8.)
        throw;
      continue;
    }
    const bool at_face = a.grid.z.tail(1)[0] >= 0.5 * shape.length * (1 - 1e-9);
    if (a.state.reaches_end && !at_face)
      continue;
    a.cut = a.state.reaches_end;
    a.row = row_of_results(a.state, e.point);
    read_row(a, e.point);
    const auto rows = loaded_rows(a.grid, a.state);
    a.length        = rows.length;
    a.length_step   = rows.last;
    if (e.point)
      if (const double half = half_axis(a.state, e.middle_z); std::isfinite(half)) {
        a.length      = 2 * half;
        a.length_step = 0;
      }
    return a;
  }
  throw SolverError({"contact in space: no grid holds the contact",
                     "eight times the expected half axes were tried",
                     "a tilt or a profile that leaves a contact unlike a line or an ellipse",
                     "check tilt, crown_radius and profile, or lower contact.space.loads", ""});
}

bool singular_end(const SpaceShape &shape, const SpaceAnswer &answer, const double tilt)
{
  return answer.cut && has_singular_end(shape.bodies, answer.grid, shape.gap(tilt), answer.state.load);
}

namespace {
// The part of the contact that symmetry leaves, in equal rectangles.
RectangleGrid slip_grid(const SpaceShape &shape, const SpaceContactSettings &c, const SpaceAnswer &pressed,
                        const int cells)
{
  const bool coupled = shape.bodies.coupling != 0, along = c.tangential_direction == TangentialDirection::along;
  RectangleGrid g;
  g.along     = along;
  g.mirror_x  = !coupled || along;
  g.mirror_z  = !pressed.grid.half && (!coupled || !along);
  g.half_x    = pressed.grid.width * pressed.grid.n_x;
  double high = 0;
  for (Eigen::Index j = 0; j < pressed.state.z.size(); ++j)
    if (pressed.state.line_load[j] > 0)
      high = std::max({high, std::abs(pressed.grid.z[j]), std::abs(pressed.grid.z[j + 1])});
  g.half_z = std::min(1.05 * high, 0.5 * shape.length);
  // Where the widest row ends, and no further.
  double widest = 0;
  for (Eigen::Index i = 0; i < pressed.state.pressure.rows(); ++i)
    if (pressed.state.pressure.row(i).maxCoeff() > 0)
      widest = pressed.grid.width * double(i + 1);
  g.half_x = std::min(g.half_x, 1.1 * widest);
  g.n_x    = g.mirror_x ? cells : 2 * cells;
  g.n_z    = g.mirror_z ? cells : 2 * cells;
  if (!g.mirror_x && !g.mirror_z) {  // four times as many unknowns as a quarter has: coarser
    g.n_x = 3 * cells / 2;
    g.n_z = 3 * cells / 2;
  }
  return g;
}
}  // namespace

SpaceSlip slip_in_space(const SpaceShape &shape, const SpaceContactSettings &c, const SpaceAnswer &pressed,
                        const int cells)
{
  const auto grid = slip_grid(shape, c, pressed, cells);
  SpaceSlip s;
  s.contact = rectangle_contact(shape.bodies, shape.gap(c.tilt), grid, c.friction);
  FrictionSolver solver(s.contact.problem);
  const double P = c.at * s.contact.share, Q = c.tangential_load * s.contact.share;
  const auto along = [&](const FrictionState &state) {
    return 1 / state.stiffness.inverse()(1, 1) / s.contact.share;
  };
  const auto &start     = solver.advance({Eigen::Vector2d(P, 0), {}});
  s.first_stiffness     = along(start);
  const double undriven = start.motion[1];
  const int steps       = shape.bodies.coupling == 0 ? 1 : 4;
  for (int i = 1; i <= steps; ++i)
    solver.advance({Eigen::Vector2d(P, Q * i / steps), {}});
  s.state        = solver.state();
  s.displacement = s.state.motion[1] - undriven;
  s.tangent      = along(s.state);
  // Distances in the row of the scalar results.
  const Expected e = expected(shape, c.at, c.tilt);
  Eigen::VectorXd distance(s.contact.place.rows());
  const Eigen::VectorXd off = (s.contact.place.col(1).array() - pressed.state.z[pressed.row]).abs();
  for (Eigen::Index i = 0; i < distance.size(); ++i)
    if (e.point)
      distance[i] = std::hypot(s.contact.place(i, 0), (s.contact.place(i, 1) - e.middle_z) * e.half_x / e.half_z);
    else
      distance[i] = off[i] <= off.minCoeff() * (1 + 1e-9) ? std::abs(s.contact.place(i, 0)) : -1;
  if (shape.bodies.coupling == 0) {
    s.stick_half_width =
        stick_edge(s.state, distance, along_motion(s.contact, s.state), c.friction, s.contact.area).stick;
    return s;
  }
  // Unlike materials leave a stuck zone off the middle, of another shape: its rectangles in the row are counted.
  int stuck = 0;
  for (Eigen::Index i = 0; i < off.size(); ++i)
    stuck += off[i] <= off.minCoeff() * (1 + 1e-9) && s.state.status[std::size_t(i)] == Status::stick;
  s.stick_step       = s.contact.width * (grid.mirror_x ? 1 : 0.5);
  s.stick_half_width = stuck * s.stick_step;
  return s;
}
}  // namespace mill::contact
