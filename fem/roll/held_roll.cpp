#include "fem/roll/held_roll.h"
#include <cmath>
#include <stdexcept>

namespace mill::fem {
namespace {
// One symmetry case about mid-length, on the quarter.  The resultant is the force (even) or the moment (odd).
struct Part {
  Eigen::MatrixXd C, axis;
  Eigen::VectorXd support, axis_support, bend, axis_bend;
};

PatchGrid whole_grid(const PatchGrid &g)
{
  PatchGrid w = g;
  w.whole     = true;
  w.n_z       = 2 * g.n_z - 1;
  w.z.resize(w.n_z);
  w.area.resize(w.n_x * w.n_z);
  for (int k = 0; k < w.n_z; ++k) {
    const int from                   = std::abs(k - (g.n_z - 1));
    w.z[k]                           = k < g.n_z - 1 ? -g.z[from] : g.z[from];
    w.area.segment(k * g.n_x, g.n_x) = (from == 0 ? 2 : 1) * g.area.segment(from * g.n_x, g.n_x);
  }
  return w;
}

// Where row k of the whole comes from, for blocks of `width` rows per station, and the sign of the odd part.
struct Unfolded {
  int from;
  double side;  // -1, 0 (on the plane: the odd part vanishes), 1
};
std::vector<Unfolded> unfold(const int stations, const int width)
{
  std::vector<Unfolded> out;
  for (int k = 1 - stations; k < stations; ++k)
    for (int i = 0; i < width; ++i)
      out.push_back({std::abs(k) * width + i, double((k > 0) - (k < 0))});
  return out;
}

// Response to loads of both sides from the even and the odd one: even/2 +- odd/2.  theory.md (2.10)
Eigen::MatrixXd recombine(const Eigen::MatrixXd &even, const Eigen::MatrixXd &odd,
                          const std::vector<Unfolded> &rows, const std::vector<Unfolded> &cols)
{
  Eigen::MatrixXd out(Eigen::Index(rows.size()), Eigen::Index(cols.size()));
  for (Eigen::Index j = 0; j < out.cols(); ++j)
    for (Eigen::Index i = 0; i < out.rows(); ++i) {
      const auto &[a, sa] = rows[std::size_t(i)];
      const auto &[b, sb] = cols[std::size_t(j)];
      out(i, j)           = 0.5 * (even(a, b) + sa * sb * odd(a, b));
    }
  return out;
}

// One column for the even load, one for the odd load, each of half a unit per side.
Eigen::MatrixXd columns(const Eigen::VectorXd &even, const Eigen::VectorXd &odd, const std::vector<Unfolded> &rows)
{
  Eigen::MatrixXd out(Eigen::Index(rows.size()), 2);
  for (Eigen::Index i = 0; i < out.rows(); ++i) {
    const auto &[a, side] = rows[std::size_t(i)];
    out.row(i) << 0.5 * even[a], 0.5 * side * odd[a];
  }
  return out;
}

HeldRoll assemble(const CondensedRoll &roll, const Extent extent, const Part &even, const Part &odd)
{
  if (extent == Extent::quarter)
    return {roll.grid, roll.axis_z, even.C, even.support, even.axis, even.axis_support, even.bend, even.axis_bend};
  HeldRoll held;
  held.grid        = whole_grid(roll.grid);
  const auto patch = unfold(roll.grid.n_z, roll.grid.n_x), axis = unfold(int(roll.axis_z.size()), 1);
  held.axis_z.resize(Eigen::Index(axis.size()));
  for (std::size_t k = 0; k < axis.size(); ++k)
    held.axis_z[Eigen::Index(k)] = axis[k].side * roll.axis_z[axis[k].from];
  held.flexibility = recombine(even.C, odd.C, patch, patch);
  held.axis        = recombine(even.axis, odd.axis, axis, patch);
  if (even.support.size() > 0) {
    held.support      = columns(even.support, odd.support, patch);
    held.axis_support = columns(even.axis_support, odd.axis_support, axis);
  }
  return held;
}

void require_both_sides(const CondensedRoll &roll, const Extent extent)
{
  if (extent == Extent::whole && !roll.both_sides())
    throw std::logic_error("a load that differs between the sides needs a roll condensed for both");
}

// Contact on one generator: half of symmetric and half of antisymmetric.  theory.md (2.4)
Part one_sided(const CaseFlexibility &symmetric, const CaseFlexibility &antisymmetric)
{
  Part part;
  part.C    = 0.5 * (symmetric.patch + antisymmetric.patch);
  part.axis = 0.5 * antisymmetric.axis;
  return part;
}

// A load of the strip, uniform over the width of the patch: along z uniform with unit force, or linear with unit
// moment about the middle of the strip and no force.
Eigen::VectorXd strip_load(const PatchGrid &grid, const double strip_width, const double centre, const bool linear)
{
  const double end            = grid.z[grid.n_z - 1];
  const Eigen::VectorXd share = axial_weights(grid.z, centre - 0.5 * strip_width, centre + 0.5 * strip_width,
                                              grid.degree),
                        whole = axial_weights(grid.z, end, grid.degree);
  const double middle         = grid.whole ? share.dot(grid.z) / share.sum() : 0;  // of what lies on the barrel
  Eigen::VectorXd strip       = grid.area;
  double total                = 0;
  for (int k = 0; k < grid.n_z; ++k) {
    auto row         = strip.segment(k * grid.n_x, grid.n_x);
    const double arm = linear ? grid.z[k] - middle : 1;
    row *= share[k] / whole[k] * arm;
    total += row.sum() * (linear ? grid.z[k] - centre : 1);
  }
  return strip / total;
}

// Strip on a quarter: its middle is that of the roll.
HeldRoll quarter_on_strip(const CondensedRoll &roll, const double strip_width)
{
  Part p                      = one_sided(roll.symmetric, roll.antisymmetric);
  const Eigen::VectorXd strip = strip_load(roll.grid, strip_width, 0, false);
  p.support                   = 0.5 * (roll.symmetric.patch - roll.antisymmetric.patch) * strip;
  p.axis_support              = -0.5 * roll.antisymmetric.axis * strip;
  p.bend      = -0.5 * roll.antisymmetric.seat_patch - p.support;  // the strip is relieved by as much
  p.axis_bend = -0.5 * roll.antisymmetric.seat_axis - p.axis_support;
  return assemble(roll, Extent::quarter, p, {});
}

HeldRoll whole_on_strip(const CondensedRoll &roll, const double strip_width, const double centre)
{
  const Part even  = one_sided(roll.symmetric, roll.antisymmetric),
             odd   = one_sided(roll.symmetric_odd, roll.antisymmetric_odd);
  HeldRoll held    = assemble(roll, Extent::whole, even, odd);
  const auto patch = unfold(roll.grid.n_z, roll.grid.n_x), axis = unfold(int(roll.axis_z.size()), 1);
  const Eigen::MatrixXd opposite =
      recombine(0.5 * (roll.symmetric.patch - roll.antisymmetric.patch),
                0.5 * (roll.symmetric_odd.patch - roll.antisymmetric_odd.patch), patch, patch);
  Eigen::MatrixXd strip(held.grid.area.size(), 2);
  strip << strip_load(held.grid, strip_width, centre, false), strip_load(held.grid, strip_width, centre, true);
  // Resultants are the force and its moment about the roll's mid-length; the strip carries the rest about its own.
  Eigen::Matrix2d about_strip;
  about_strip << 1, 0, -centre, 1;
  const Eigen::MatrixXd by_strip = opposite * strip, axis_by_strip = -held.axis * strip;
  held.support      = by_strip * about_strip;
  held.axis_support = axis_by_strip * about_strip;
  // Chocks at +- the arm: sum and difference of the two, less what the strip is relieved of.
  Eigen::Matrix2d sides, relief;
  sides << 1, 1, 1, -1;
  relief << 1, 1, roll.seat_lever - centre, -roll.seat_lever - centre;
  held.bend =
      columns(-0.5 * roll.antisymmetric.seat_patch, -0.5 * roll.antisymmetric_odd.seat_patch, patch) * sides -
      by_strip * relief;
  held.axis_bend =
      columns(-0.5 * roll.antisymmetric.seat_axis, -0.5 * roll.antisymmetric_odd.seat_axis, axis) * sides -
      axis_by_strip * relief;
  return held;
}
}  // namespace

HeldRoll held_by_necks(const CondensedRoll &roll, const Extent extent)
{
  require_both_sides(roll, extent);
  const auto part = [&](const CaseFlexibility &symmetric, const CaseFlexibility &antisymmetric,
                        const double lever) {
    Part p         = one_sided(symmetric, antisymmetric);
    p.support      = -0.5 / lever * antisymmetric.seat_patch;
    p.axis_support = -0.5 / lever * antisymmetric.seat_axis;
    return p;
  };
  return assemble(roll, extent, part(roll.symmetric, roll.antisymmetric, 1),
                  extent == Extent::whole ? part(roll.symmetric_odd, roll.antisymmetric_odd, roll.seat_lever)
                                          : Part{});
}

HeldRoll held_by_strip(const CondensedRoll &roll, const double strip_width, const Extent extent,
                       const double strip_centre)
{
  require_both_sides(roll, extent);
  return extent == Extent::quarter ? quarter_on_strip(roll, strip_width)
                                   : whole_on_strip(roll, strip_width, strip_centre);
}

HeldRoll held_by_mirror(const CondensedRoll &roll, const Extent extent)
{
  if (extent == Extent::whole && roll.symmetric_odd.patch.size() == 0)
    throw std::logic_error("both sides between mirrored contacts need the odd symmetric of the roll");
  const auto part = [&](const Eigen::MatrixXd &C) {
    const auto n = C.rows(), n_axis = std::max<Eigen::Index>(1, roll.axis_z.size());
    Part p;
    p.C            = C;
    p.axis         = Eigen::MatrixXd::Zero(n_axis, n);
    p.support      = Eigen::VectorXd::Zero(n);
    p.axis_support = Eigen::VectorXd::Zero(n_axis);
    return p;
  };
  return assemble(roll, extent, part(roll.symmetric.patch),
                  extent == Extent::whole ? part(roll.symmetric_odd.patch) : Part{});
}
}  // namespace mill::fem
