#include "core/laws/friction_law.h"
#include "fem/strip/rigid_plastic/strip_flow_equations.h"
#include <algorithm>
#include <cmath>

// Roll and strip: pressure, friction, shape of the roll, equations of the whole bite.  theory.md 18.4, 18.5
namespace mill::fem {
namespace {
using bite::Dual;

// Integrals over an edge: N_i dN_k/dxi, and N_i.
constexpr double turning[3][3] = {{-0.5, 2. / 3, -1. / 6}, {-2. / 3, 0, 2. / 3}, {1. / 6, -2. / 3, 0.5}};
constexpr double share[3]      = {1. / 3, 4. / 3, 1. / 3};

template <class T> T spine_place(const StripGrid &grid, const int i, const T &entry, const T &exit)
{
  const auto corner = [&](const int I) {
    const auto &s = grid.spine[I];
    return s[0] * entry + s[1] * exit + s[2];
  };
  return i % 2 == 0 ? T(corner(i / 2)) : T(0.5 * (corner(i / 2) + corner(i / 2 + 1)));
}

}  // namespace

void StripAssembly::contact()
{
  using Node          = Dual<16>;
  const Friction &law = pass.bite->strip.friction;
  const int top       = 2 * grid.n_through;
  out.nodes           = Eigen::MatrixXd::Zero(grid.last - grid.first + 1, 6);
  for (int i = grid.first; i <= grid.last; ++i) {
    std::array<int, 16> columns;
    columns.fill(-1);
    columns[0] = grid.whole(Whole::entry);
    columns[1] = grid.whole(Whole::exit);
    columns[2] = grid.velocity(i, top, 0);
    columns[3] = grid.velocity(i, top, 1);
    columns[4] = grid.contact(i);
    for (int d = -2; d <= 2; ++d)
      if (i + d >= grid.first && i + d <= grid.last && std::abs(d) <= 2 - i % 2)
        columns[7 + d] = grid.height(i + d, grid.n_through);
    columns[10] = grid.strain(i / 2, grid.n_through - 1, 2);  // of the Gauss row next to the surface
    columns[11] = i % 2 ? grid.strain(i / 2 + 1, grid.n_through - 1, 2) : -1;
    columns[12] = grid.whole(Whole::friction);
    columns[13] = grid.input(bite::Input::flow_stress);
    columns[14] = grid.input(bite::Input::gap_rate);
    columns[15] = grid.input(bite::Input::roll_speed);
    Node unknown_of_spine[16];
    for (int m = 0; m < 16; ++m)
      unknown_of_spine[m] = Node::variable(value(columns[m]), m);
    const Node &entry = unknown_of_spine[0], &exit = unknown_of_spine[1], &pressure = unknown_of_spine[4];
    // Outward normal times the share of the surface, of the edges in contact on both sides.
    Node nx(0.), ny(0.);
    const auto add_edge = [&](const int I, const int a) {
      const Node half = 0.5 * (spine_place(grid, 2 * I + 2, entry, exit) - spine_place(grid, 2 * I, entry, exit));
      for (int b = 0; b < 3; ++b)
        nx -= turning[a][b] * unknown_of_spine[7 + 2 * I + b - i];
      ny += share[a] * half;
    };
    if (i % 2)
      add_edge(i / 2, 1);
    if (i % 2 == 0 && i > grid.first)
      add_edge(i / 2 - 1, 2);
    if (i % 2 == 0 && i < grid.last)
      add_edge(i / 2, 0);
    const Node size = sqrt(nx * nx + ny * ny), tx = ny / size, ty = -(nx / size);
    const Node rise =
        unknown_of_spine[3] -
        0.5 * unknown_of_spine[14] / unknown_of_spine[15];  // relative to a roll that moves with half the gap rate
    const Node slip         = unknown_of_spine[2] * tx + rise * ty - 1.0;
    const Node strain       = i % 2 ? 0.5 * (unknown_of_spine[10] + unknown_of_spine[11]) : unknown_of_spine[10];
    const Node flow_stress  = unknown_of_spine[13] * scaled_flow_stress(pass, strain),
               shear_yield  = 0.5 * flow_stress;
    const auto traction_law = bite::traction_of(law, unknown_of_spine[12]);
    Node limit = bite::traction_limit(traction_law, pressure.value > 0 ? pressure : Node(0.), flow_stress,
                                      slip.value < 0 ? 1 : -1);  // (18.11)
    if (stage.picard)
      limit = traction_law.slides
                  ? Node(std::min(1.2 * unknown_of_spine[12].value * flow_stress.value, shear_yield.value))
                  : Node(limit.value);
    const Node regularised = sqrt(slip * slip + stage.cutoff_slip * stage.cutoff_slip);
    double direction       = slip.value / regularised.value;
    if (before) {  // as in the bulk
      const auto old = before->slip.col(i - grid.first);
      direction =
          old[1] == 0 ? old[2] : slip.value / old[1] - old[2] * old[0] * (slip.value - old[0]) / (old[1] * old[1]);
      direction = std::clamp(direction, -1., 1.);
    }
    after.slip.col(i - grid.first) << slip.value, regularised.value, direction;
    Node sense(slip.value / regularised.value);
    for (int m = 0; m < 16; ++m)
      sense.by[m] = (slip.by[m] - direction * regularised.by[m]) / regularised.value;
    const Node traction = -(limit * sense);
    const Node fx = pressure * nx - traction * size * tx, fy = pressure * ny - traction * size * ty;
    add(columns[2], fx, columns);
    add(columns[3], fy, columns);
    add(grid.contact(i), unknown_of_spine[2] * nx + rise * ny, columns);
    add(out.force, fy, columns);
    add(out.traction, traction * size, columns);
    out.force_x -= fx.value;
    out.friction_power += std::abs(traction.value * slip.value) * size.value;
    out.nodes.row(i - grid.first) << spine_place(grid, i, entry, exit).value, pressure.value, traction.value,
        slip.value, size.value,
        (traction_law.slides ? unknown_of_spine[12].value * pressure.value : limit.value) / shear_yield.value;
  }
}

void StripAssembly::roll_shape()
{
  using Height  = Dual<6>;
  const int top = grid.n_through;
  for (int i = grid.first; i <= grid.last; ++i) {
    const std::array<int, 6> columns{grid.height(i, top),       grid.whole(Whole::entry),
                                     grid.whole(Whole::exit),   grid.whole(Whole::offset),
                                     grid.whole(Whole::radius), grid.input(bite::Input::exit_thickness)};
    Height unknown_of_spine[6];
    for (int m = 0; m < 6; ++m)
      unknown_of_spine[m] = Height::variable(value(columns[m]), m);
    add(columns[0],
        unknown_of_spine[0] - circle_height(unknown_of_spine[5], unknown_of_spine[3], unknown_of_spine[4],
                                            spine_place(grid, i, unknown_of_spine[1], unknown_of_spine[2])),
        columns);
  }
  if (!pass.flexibility || stage.flexibility == 0)
    return;
  const FlattenedArc arc = flattened_arc(pass, grid, unknowns);
  for (int i = grid.first; i <= grid.last; ++i) {
    const int row = grid.height(i, top), n = i - grid.first;
    add(row, -stage.flexibility * arc.displacement[n]);
    if (stage.arc_held) {  // the shape stays, the spine moves along it
      const auto place = spine_place(grid, i, Dual<2>::variable(value(grid.whole(Whole::entry)), 0),
                                     Dual<2>::variable(value(grid.whole(Whole::exit)), 1));
      add(row, grid.whole(Whole::entry), -stage.flexibility * arc.slope[n] * place.by[0]);
      add(row, grid.whole(Whole::exit), -stage.flexibility * arc.slope[n] * place.by[1]);
      continue;
    }
    add(row, grid.whole(Whole::entry), -stage.flexibility * arc.by_ends(n, 0));
    add(row, grid.whole(Whole::exit), -stage.flexibility * arc.by_ends(n, 1));
    for (int j = grid.first; j <= grid.last; ++j)
      add(row, grid.contact(j), -stage.flexibility * arc.by_pressure(n, j - grid.first));
  }
}

FlattenedArc flattened_arc(const StripPass &pass, const StripGrid &grid, const Eigen::VectorXd &unknowns)
{
  using Place                     = Dual<2>;
  const auto &flexibility         = *pass.flexibility;
  const Eigen::VectorXd positions = flexibility.position / pass.length;
  const int n = grid.last - grid.first + 1, m = int(positions.size());
  const Place entry = Place::variable(unknowns[grid.whole(Whole::entry)], 0);
  const Place exit  = Place::variable(unknowns[grid.whole(Whole::exit)], 1);
  std::vector<Place> place(n);  // towards the entry, in the order of the flexibility: falls with the spine
  Eigen::VectorXd pressure(n);
  for (int i = 0; i < n; ++i) {
    place[i]    = -spine_place(grid, grid.first + i, entry, exit);
    pressure[i] = unknowns[grid.contact(grid.first + i)];
  }
  if (!(place[0].value <= positions[m - 1] && place[n - 1].value >= positions[0])) {  // a step too far
    const Eigen::VectorXd nothing = Eigen::VectorXd::Constant(n, not_given);
    return {nothing, nothing, Eigen::MatrixXd::Constant(n, 2, not_given),
            Eigen::MatrixXd::Constant(n, n, not_given)};
  }
  // Pressures of the flexibility with the same resultant and moment as those of the nodes, (18.13).
  Eigen::MatrixXd gather = Eigen::MatrixXd::Zero(m, n), gather_by[2] = {gather, gather};
  int k = 0;
  for (int i = n - 1; i > 0; --i) {
    const Place &from = place[i], &to = place[i - 1];
    while (k > 0 && positions[k] > from.value)
      --k;
    while (k < m - 2 && positions[k + 1] <= from.value)
      ++k;
    for (int cell = k; cell < m - 1 && positions[cell] < to.value; ++cell) {
      const Place low  = from.value > positions[cell] ? from : Place(positions[cell]);
      const Place high = to.value < positions[cell + 1] ? to : Place(positions[cell + 1]);
      for (int q = 0; q < 3; ++q) {  // Simpson's rule: exact for the product of two straight lines
        const Place x      = q == 0 ? low : q == 2 ? high : 0.5 * (low + high);
        const Place weight = (high - low) * (q == 1 ? 4. / 6 : 1. / 6);
        const Place right  = (x - positions[cell]) / (positions[cell + 1] - positions[cell]),
                    there  = (x - from) / (to - from);
        for (const bool up : {false, true})
          for (const bool ahead : {false, true}) {
            const Place c = weight * (up ? right : 1.0 - right) * (ahead ? there : 1.0 - there);
            const int r = cell + up, s = ahead ? i - 1 : i;
            gather(r, s) += c.value;
            gather_by[0](r, s) += c.by[0];
            gather_by[1](r, s) += c.by[1];
          }
      }
    }
  }
  for (int r = 0; r < m; ++r) {
    const double width =
        0.5 * ((r > 0 ? positions[r] - positions[r - 1] : 0) + (r < m - 1 ? positions[r + 1] - positions[r] : 0));
    gather.row(r) /= width;
    gather_by[0].row(r) /= width;
    gather_by[1].row(r) /= width;
  }
  const double scale            = pass.stress / pass.length;
  const Eigen::MatrixXd answer  = scale * flexibility.influence * gather;
  const Eigen::VectorXd u       = answer * pressure;
  const Eigen::VectorXd u_by[2] = {scale * (flexibility.influence * (gather_by[0] * pressure)),
                                   scale * (flexibility.influence * (gather_by[1] * pressure))};
  FlattenedArc out{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::MatrixXd(n, 2), Eigen::MatrixXd(n, n)};
  for (int i = 0; i < n; ++i) {
    const auto *begin  = positions.data();
    const int cell     = std::clamp(int(std::upper_bound(begin, begin + m, place[i].value) - begin) - 1, 0, m - 2);
    const double t     = (place[i].value - positions[cell]) / (positions[cell + 1] - positions[cell]);
    const double slope = (u[cell + 1] - u[cell]) / (positions[cell + 1] - positions[cell]);
    out.displacement[i]    = (1 - t) * u[cell] + t * u[cell + 1];
    out.slope[i]           = -slope;  // along the strip
    out.by_pressure.row(i) = (1 - t) * answer.row(cell) + t * answer.row(cell + 1);
    for (const int e : {0, 1})
      out.by_ends(i, e) = slope * place[i].by[e] + (1 - t) * u_by[e][cell] + t * u_by[e][cell + 1];
  }
  return out;
}

void StripAssembly::whole()
{
  using bite::Input;
  const auto row     = [&](const Whole w) { return grid.whole(w); };
  const auto at_rest = [&](const Whole w) {  // keeps its value
    add(row(w), unknowns[row(w)]);
    add(row(w), row(w), 1);
  };
  if (!stage.free_surface) {  // where the circle reaches the entry thickness
    using Entry = Dual<4>;
    const std::array<int, 4> columns{row(Whole::entry), row(Whole::radius), grid.input(Input::entry_thickness),
                                     grid.input(Input::exit_thickness)};
    const Entry R = Entry::variable(value(columns[1]), 1), h1 = Entry::variable(value(columns[2]), 2),
                h2 = Entry::variable(value(columns[3]), 3), centre = R - 0.5 * (h1 - h2);
    add(row(Whole::entry), Entry::variable(value(columns[0]), 0) + sqrt(R * R - centre * centre), columns);
  }
  if (stage.release) {
    const int last = grid.contact(grid.last);
    add(row(Whole::exit), unknowns[last] - stage.end_pressure);
    add(row(Whole::exit), last, 1);
  } else {
    at_rest(Whole::exit);
  }
  at_rest(Whole::radius);
  const int R = grid.input(Input::arc_radius);
  if (pass.model.arc == bite::Arc::hitchcock && !stage.arc_held) {  // (8.9), both thicknesses among the inputs
    const double nu = pass.bite->roll.poisson_ratio;
    const double C  = 16 * (1 - nu * nu) / (M_PI * pass.bite->roll.youngs_modulus) * pass.stress;
    using Reduction = Dual<3>;
    const std::array<int, 3> columns{R, grid.input(Input::entry_thickness), grid.input(Input::exit_thickness)};
    const Reduction radius = Reduction::variable(value(R), 0),
                    by     = C * radius /
                         (Reduction::variable(value(columns[1]), 1) - Reduction::variable(value(columns[2]), 2));
    add(row(Whole::radius),
        -((1 - stage.flexibility) * pass.start_radius + stage.flexibility * (radius + out.force.value * by)),
        columns);
    for (int c = 0; c < grid.n_unknowns + bite::n_inputs; ++c)
      if (out.force.by[c] != 0)
        add(row(Whole::radius), c, -stage.flexibility * by.value * out.force.by[c]);
  } else {
    add(row(Whole::radius), -value(R));
    add(row(Whole::radius), R, -1);
  }
  if (pass.flexibility && stage.free_surface && !stage.arc_held) {  // the strip leaves with its exit thickness
    const int surface = grid.height(2 * grid.n_along, grid.n_through), h2 = grid.input(Input::exit_thickness);
    add(row(Whole::offset), unknowns[surface] - 0.5 * value(h2));
    add(row(Whole::offset), surface, 1);
    add(row(Whole::offset), h2, -0.5);
  } else if (stage.arc_held) {
    add(row(Whole::offset), row(Whole::offset), 1);
  } else {
    at_rest(Whole::offset);
  }
  friction();
  if (std::isnan(pass.model.exit_speed)) {
    at_rest(Whole::tension);
    add(row(Whole::tension), -stage.tension * value(grid.input(Input::exit_tension)));
    add(row(Whole::tension), grid.input(Input::exit_tension), -stage.tension);
  } else {
    const int drawn = grid.velocity(2 * grid.n_along, 0, 0);
    add(row(Whole::tension), unknowns[drawn] - pass.model.exit_speed);
    add(row(Whole::tension), drawn, 1);
  }
}

void StripAssembly::friction()
{
  using bite::Input;
  using Speed        = Dual<8>;
  const Strip &strip = pass.bite->strip;
  const std::array<int, 8> columns{
      grid.whole(Whole::friction), grid.input(Input::friction),           grid.input(Input::roll_speed),
      grid.velocity(0, 0, 0),      grid.velocity(2 * grid.n_along, 0, 0), grid.whole(Whole::radius),
      grid.whole(Whole::entry),    grid.input(Input::entry_tension)};
  Speed unknown_of_spine[8];
  for (int m = 0; m < 8; ++m)
    unknown_of_spine[m] = Speed::variable(value(columns[m]), m);
  Speed coefficient(0.);
  if (slides(strip.friction)) {
    const Speed roll = pass.speed * unknown_of_spine[2];
    coefficient      = bite::coulomb_coefficient(
             strip.friction,
             bite::Inlet<Speed>{roll, unknown_of_spine[3] * roll, unknown_of_spine[4] * roll,
                                pass.length * unknown_of_spine[5], -pass.length * unknown_of_spine[6],
                                pass.stress * (scaled_flow_stress(pass, Speed(0.)) - unknown_of_spine[7])});
  }
  if (slides(strip.friction))
    coefficient *= stage.friction;
  else  // a law of factors: what is added to both
    coefficient += (stage.friction - 1) * std::max(strip.friction.entry_factor, strip.friction.exit_factor);
  add(columns[0], unknown_of_spine[0] - coefficient - unknown_of_spine[1], columns);
}
}  // namespace mill::fem
