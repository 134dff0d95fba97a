#include "reduce/stack/moving_stack.h"
#include "reduce/stack/beam_stack.h"
#include "reduce/stack/group_modes.h"
#include "reduce/stack/roll_group.h"
#include "reduce/stack/strip_side.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

namespace mill::reduce {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double no_more    = 1e-3;  // of its size: a shape that the others hold already
constexpr int modes_of_half = 8;     // lowest ones whose shapes the rolls on bearings have

bool is_upper(const StackRoll &roll)
{
  return roll.axis[1] > 0;
}

std::string part_of_roll(const StackRoll &roll)
{
  return std::string(is_upper(roll) ? "upper" : "lower") + " roll " +
         (roll.made_of.empty() ? roll.name : roll.made_of);
}

// Rolls of one drawing have the same shapes; the eigenvalue problem is solved once for each.
class ShapesOfDrawings {
public:
  explicit ShapesOfDrawings(const int bending) : bending_modes(bending) {}
  const MatrixXd &of(const RollGroup::FreeBeam &beam, const VectorXd &z)
  {
    for (const auto &one : known)
      if (one.z.size() == z.size() && ((one.z.array() - one.z[0]) - (z.array() - z[0])).abs().maxCoeff() < 1e-9 &&
          one.mass.isApprox(beam.mass, 1e-12) && one.stiffness.isApprox(beam.stiffness, 1e-12))
        return one.shapes;
    known.push_back({z, beam.stiffness, beam.mass, free_shapes(beam, z, bending_modes)});
    return known.back().shapes;
  }

private:
  struct Known {
    VectorXd z;
    MatrixXd stiffness, mass, shapes;
  };
  int bending_modes;
  std::vector<Known> known;
};

// A shape in addition to those of V, or V itself where these hold it already but for a part `least` of its size.
MatrixXd with_shape(const MatrixXd &V, const MatrixXd &mass, VectorXd shape, const double least)
{
  const double whole = shape.dot(mass * shape);
  for (int twice = 0; twice < 2; ++twice)
    shape -= V * (V.transpose() * (mass * shape));
  const double rest = shape.dot(mass * shape);
  if (!(rest > least * least * whole))
    return V;
  MatrixXd more(V.rows(), V.cols() + 1);
  more << V, shape / std::sqrt(rest);
  return more;
}

// The springs of rows sqrt(k) r as few: rows of few unknowns have the same stiffness in its principal directions.
Connection in_fewest_springs(const std::string &name, const MatrixXd &all)
{
  std::vector<Index> moved;
  for (Index k = 0; k < all.cols(); ++k)
    if (all.col(k).cwiseAbs().maxCoeff() > 0)
      moved.push_back(k);
  const Index n = Index(moved.size());
  if (all.rows() <= n)
    return {name, all, VectorXd::Ones(all.rows())};
  MatrixXd of_moved(all.rows(), n);
  for (Index k = 0; k < n; ++k)
    of_moved.col(k) = all.col(moved[std::size_t(k)]);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> principal(of_moved.transpose() * of_moved);
  Connection few{name, MatrixXd::Zero(n, all.cols()), principal.eigenvalues().cwiseMax(0)};
  for (Index k = 0; k < n; ++k)
    few.rows.col(moved[std::size_t(k)]) = principal.eigenvectors().row(k).transpose();
  return few;
}

// Assembles the model unknown by unknown: the motion of each group is T times those of its columns.
class MotionOfBeams {
public:
  MotionOfBeams(const BeamStack &solved, const int bending_modes) : parts(solved.parts()), shapes(bending_modes)
  {
    for (std::size_t side = 0; side < parts.sides.size(); ++side)
      add_rolls(parts.sides[side], parts.load / parts.stack.strip.force);
    set_matrices();
    add_contacts();
    add_supports();
    add_places();
    add_strip();
  }
  MovingStack out;

private:
  struct Block {  // of one roll in one plane
    std::size_t side;
    std::vector<Index> unknown;  // of the group
    MatrixXd shapes, mass, stiffness;
    Index first;  // of the model
  };

  // Shape under a unit rolling force, at the factors of the solved state.
  void add_rolls(const StripSide &side, const VectorXd &per_force)
  {
    const RollGroup &group  = side.group;
    const VectorXd deflects = side.respond(VectorXd::Zero(group.size()), per_force);
    const GroupModes lowest = lowest_modes(group, modes_of_half);
    const std::size_t s     = std::size_t(&side - parts.sides.data());
    for (std::size_t r = 0; r < parts.stack.rolls.size(); ++r) {
      if (!group.holds(r))
        continue;
      const RollGroup::FreeBeam beam = group.free_beam(r);
      const VectorXd z               = group.places(r);
      const auto part                = out.model.parts.size();
      out.model.parts.push_back(part_of_roll(parts.stack.rolls[r]));
      for (const std::size_t axis : group.planes()) {
        Block block{s, group.unknowns(r, axis), {}, beam.mass, beam.stiffness, Index(out.moved.size())};
        const auto part_of_group = [&](const auto &motion) {
          return VectorXd::NullaryExpr(Index(block.unknown.size()),
                                       [&](const Index i) { return motion[block.unknown[std::size_t(i)]]; })
              .eval();
        };
        block.shapes = with_shape(shapes.of(beam, z), beam.mass, part_of_group(deflects), 1e-8);
        // A shaft on saddles bends between them, which shapes of a free roll resolve slowly.
        if (!parts.stack.rolls[r].supports.empty())
          for (Index k = 0; k < lowest.shape.cols(); ++k)
            block.shapes =
                with_shape(block.shapes, beam.mass, part_of_group(VectorXd(lowest.shape.col(k))), no_more);
        for (Index k = 0; k < block.shapes.cols(); ++k) {
          using Motion = MovedRoll::Motion;
          out.moved.push_back({r, axis,
                               k == 0   ? Motion::translation
                               : k == 1 ? Motion::tilting
                                        : Motion::bending});
          out.model.part_of.push_back(int(part));
          const char *what = k == 0 ? "translation" : k == 1 ? "tilting" : "bending";
          out.model.unknowns.push_back({std::string(what) + (axis == 1 ? " y" : " x"),
                                        std::numeric_limits<double>::quiet_NaN(), "kg^0.5 m"});
        }
        blocks.push_back(std::move(block));
      }
    }
  }

  Index size() const
  {
    return Index(out.moved.size());
  }

  void set_matrices()
  {
    StandModel &m = out.model;
    m.name        = "stack";
    m.M = m.K_parts = MatrixXd::Zero(size(), size());
    for (const Block &b : blocks) {
      const Index n                     = b.shapes.cols();
      m.M.block(b.first, b.first, n, n) = symmetric_part(b.shapes.transpose() * b.mass * b.shapes);
      MatrixXd bends                    = symmetric_part(b.shapes.transpose() * b.stiffness * b.shapes);
      bends.topRows(2).setZero();  // rigid motions
      bends.leftCols(2).setZero();
      m.K_parts.block(b.first, b.first, n, n) = bends;
    }
    for (std::size_t side = 0; side < parts.sides.size(); ++side)
      transforms.push_back(transform(side));
    m.b = VectorXd::Zero(size());
    for (std::size_t side = 0; side < parts.sides.size(); ++side)
      for (std::size_t i = 0; i < parts.sides[side].rows.size(); ++i)
        m.b += parts.load[Index(i)] / parts.stack.strip.force * row_of(side, parts.sides[side].rows[i]);
  }

  // (unknowns of the group, unknowns of the model), row by row.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> transform(const std::size_t side) const
  {
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> T =
        MatrixXd::Zero(parts.sides[side].group.size(), size());
    for (const Block &b : blocks)
      if (b.side == side)
        for (std::size_t i = 0; i < b.unknown.size(); ++i)
          T.row(b.unknown[i]).segment(b.first, b.shapes.cols()) = b.shapes.row(Index(i));
    return T;
  }

  VectorXd row_of(const std::size_t side, const UnknownRow &row) const
  {
    VectorXd r = VectorXd::Zero(size());
    for (std::size_t i = 0; i < row.unknown.size(); ++i)
      r += row.factor[i] * transforms[side].row(row.unknown[i]).transpose();
    return r;
  }

  void add_contacts()
  {
    for (std::size_t c = 0; c < parts.stack.contacts.size(); ++c) {
      const StackContact &contact = parts.stack.contacts[c];
      const std::size_t side      = parts.sides[0].group.holds(contact.a) ? 0 : 1;
      std::vector<VectorXd> rows;
      std::vector<double> stiffness;
      for (const ContactElement &e : parts.sides[side].group.contacts)
        for (int g = 0; e.contact == c && g < UnitGauss::n; ++g) {
          UnknownRow row{e.unknown, {}};
          for (Index i = 0; i < e.row.rows(); ++i)
            row.factor.push_back(e.row(i, g));
          rows.push_back(row_of(side, row));
          stiffness.push_back(e.weight[g] * e.tangent[g]);
        }
      add_connection(parts.stack.rolls[contact.a].name + "-" + parts.stack.rolls[contact.b].name, rows, stiffness);
    }
  }

  void add_connection(const std::string &name, const std::vector<VectorXd> &rows,
                      const std::vector<double> &stiffness)
  {
    MatrixXd all(Index(rows.size()), size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      all.row(Index(i)) = std::sqrt(stiffness[i]) * rows[i].transpose();
    out.model.connections.push_back(in_fewest_springs(name, all));
  }

  std::size_t side_of(const std::size_t roll) const
  {
    return parts.sides[0].group.holds(roll) ? 0 : 1;
  }
  VectorXd deflection(const std::size_t roll, const double z, const std::size_t axis) const
  {
    const std::size_t side = side_of(roll);
    return row_of(side, parts.sides[side].group.deflection_at(roll, z, axis));
  }

  // The load cell stands above the strip: it shows what the supports of the upper half take up.
  void add_supports()
  {
    out.model.load_cell = VectorXd::Zero(size());
    for (std::size_t r = 0; r < parts.stack.rolls.size(); ++r) {
      const StackRoll &roll = parts.stack.rolls[r];
      std::vector<VectorXd> rows;
      std::vector<double> stiffness;
      for (const StackSupport &support : roll.supports)
        for (const std::size_t axis : parts.sides[side_of(r)].group.planes())
          if (support.stiffness[axis] > 0) {
            rows.push_back(deflection(r, support.z + roll.shift, axis));
            stiffness.push_back(support.stiffness[axis]);
            if (axis == 1 && is_upper(roll))
              out.model.load_cell += support.stiffness[axis] * rows.back();
          }
      if (!rows.empty())
        add_connection("bearings of " + part_of_roll(roll), rows, stiffness);
    }
  }

  // Mean over the bearings and saddles of a half.
  VectorXd at_bearings(const bool upper) const
  {
    VectorXd sum = VectorXd::Zero(size());
    double held  = 0;
    for (std::size_t r = 0; r < parts.stack.rolls.size(); ++r)
      for (const StackSupport &support : parts.stack.rolls[r].supports)
        if (is_upper(parts.stack.rolls[r]) == upper) {
          sum += deflection(r, support.z + parts.stack.rolls[r].shift, 1);
          held += 1;
        }
    return sum / std::max(held, 1.);
  }

  VectorXd middle(const std::size_t roll, const std::size_t axis) const
  {
    return deflection(roll, parts.stack.rolls[roll].shift, axis);
  }

  // What carries a work roll: its neighbours, weighted by the vertical part of what their contacts carry.
  VectorXd carrier(const std::size_t work_roll) const
  {
    VectorXd sum = VectorXd::Zero(size());
    double whole = 0;
    for (std::size_t c = 0; c < parts.stack.contacts.size(); ++c) {
      const StackContact &contact = parts.stack.contacts[c];
      if (contact.a != work_roll)
        continue;
      double force = 0;
      for (const ContactElement &e : parts.sides[side_of(work_roll)].group.contacts)
        if (e.contact == c)
          force += (e.weight * e.load).sum();
      force *= std::abs(direction_of(parts.stack, contact)[1]);
      sum += force * middle(contact.b, 1);
      whole += force;
    }
    return whole > 0 ? (sum / whole).eval() : middle(work_roll, 1);
  }

  void add_places()
  {
    const Stack &stack = parts.stack;
    out.model.points   = {{"upper bearings", at_bearings(true)},       {"upper backup roll", carrier(stack.upper)},
                          {"upper work roll", middle(stack.upper, 1)}, {"lower work roll", middle(stack.lower, 1)},
                          {"lower backup roll", carrier(stack.lower)}, {"lower bearings", at_bearings(false)}};
    for (std::size_t r = 0; r < stack.rolls.size(); ++r) {
      const RollGroup &group = parts.sides[side_of(r)].group;
      for (const std::size_t axis : group.planes())
        if (axis == 0 || (r != stack.upper && r != stack.lower))
          out.model.points.push_back({stack.rolls[r].name + (axis == 1 ? " y" : " x"), middle(r, axis)});
      StandLine line{stack.rolls[r].name, group.places(r), {}};
      line.rows.resize(line.z.size(), size());
      for (Index i = 0; i < line.z.size(); ++i)
        line.rows.row(i) = deflection(r, line.z[i], 1).transpose();
      out.model.lines.push_back(std::move(line));
    }
  }

  // An opening of the axes by o changes the line load by -(1/k_o + C)^-1 o: the strip in series with the
  // flattening of both rolls, (51.9).  In its principal directions these are springs.
  void add_strip()
  {
    out.strip.name   = "strip";
    const double k_o = opening_factor(parts.stack.strip);
    if (!(k_o > 0))
      return;
    std::vector<Index> pressed;
    for (Index i = 0; i < parts.load.size(); ++i)
      if (parts.load[i] > 0)
        pressed.push_back(i);
    const Index n = Index(pressed.size());
    MatrixXd flexibility(n, n), rows = MatrixXd::Zero(n, size());
    VectorXd length(n);
    for (Index i = 0; i < n; ++i) {
      const Index index = pressed[std::size_t(i)];
      length[i]         = parts.length[index];
      for (Index j = 0; j < n; ++j)
        flexibility(i, j) = parts.flattening(index, pressed[std::size_t(j)]) + (i == j ? 1 / k_o : 0);
      for (std::size_t side = 0; side < 2; ++side)
        rows.row(i) += row_of(side, parts.sides[side].rows[std::size_t(index)]).transpose() / length[i];
    }
    const MatrixXd springs = symmetric_part(length.asDiagonal() * flexibility.inverse());
    out.strip_stiffness    = springs.sum();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> principal(springs);
    out.strip.rows      = principal.eigenvectors().transpose() * rows;
    out.strip.stiffness = principal.eigenvalues().cwiseMax(0);
  }

  BeamStackParts parts;
  ShapesOfDrawings shapes;
  std::vector<Block> blocks;
  std::vector<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> transforms;
};

double mass_of(const StackRoll &roll)
{
  double mass = 0;
  for (const StackSection &section : roll.sections)
    mass += roll.material.density * M_PI * section.diameter * section.diameter / 4 * (section.to - section.from);
  for (const StackLump &lump : roll.lumps)
    mass += lump.mass;
  return mass;
}
}  // namespace

MovingStack moving_stack(const BeamStack &solved, const int bending_modes)
{
  return std::move(MotionOfBeams(solved, bending_modes).out);
}

MovingStack lumped_stack(const BeamStack &solved, const StackState &state)
{
  const Stack &stack                     = solved.parts().stack;
  const std::vector<std::size_t> &planes = solved.parts().groups.front().planes();
  const std::size_t per_roll             = planes.size();
  const Index n                          = Index(per_roll * stack.rolls.size());
  MovingStack lumped;
  StandModel &m = lumped.model;
  m.name        = "stack-lumped";
  m.M = m.K_parts = MatrixXd::Zero(n, n);
  m.b = m.load_cell  = VectorXd::Zero(n);
  const auto unknown = [&](const std::size_t roll, const std::size_t axis) {
    return Index(per_roll * roll + std::size_t(std::find(planes.begin(), planes.end(), axis) - planes.begin()));
  };
  for (std::size_t r = 0; r < stack.rolls.size(); ++r) {
    const StackRoll &roll = stack.rolls[r];
    m.parts.push_back(part_of_roll(roll));
    Connection held{"bearings of " + part_of_roll(roll), MatrixXd::Zero(Index(per_roll), n),
                    VectorXd::Zero(Index(per_roll))};
    for (std::size_t k = 0; k < per_roll; ++k) {
      const Index i = unknown(r, planes[k]);
      m.M(i, i)     = mass_of(roll);
      m.part_of.push_back(int(r));
      m.unknowns.push_back({planes[k] == 1 ? "roll y" : "roll x", 0, "m"});
      lumped.moved.push_back({r, planes[k], MovedRoll::Motion::translation});
      held.rows(Index(k), i) = 1;
      for (const StackSupport &support : roll.supports)
        held.stiffness[Index(k)] += support.stiffness[planes[k]];
      if (planes[k] == 1 && is_upper(roll))
        m.load_cell[i] = held.stiffness[Index(k)];
    }
    if (held.stiffness.maxCoeff() > 0)
      m.connections.push_back(std::move(held));
  }
  for (std::size_t c = 0; c < stack.contacts.size(); ++c) {
    const StackContact &contact = stack.contacts[c];
    const auto direction        = direction_of(stack, contact);
    Connection pair{stack.rolls[contact.a].name + "-" + stack.rolls[contact.b].name, MatrixXd::Zero(1, n),
                    VectorXd::Constant(1, state.pairs[c].uniform_tangent)};
    for (const std::size_t axis : planes) {
      pair.rows(0, unknown(contact.a, axis)) = direction[axis];
      pair.rows(0, unknown(contact.b, axis)) = -direction[axis];
    }
    m.connections.push_back(std::move(pair));
  }
  const auto row_of = [&](const std::vector<std::size_t> &rolls) {
    VectorXd row = VectorXd::Zero(n);
    for (const std::size_t roll : rolls)
      row[unknown(roll, 1)] = 1. / double(rolls.size());
    return row;
  };
  const auto held_rolls = [&](const bool upper) {
    std::vector<std::size_t> rolls;
    for (std::size_t r = 0; r < stack.rolls.size(); ++r)
      if (is_upper(stack.rolls[r]) == upper && !stack.rolls[r].supports.empty())
        rolls.push_back(r);
    return rolls;
  };
  const auto carriers = [&](const std::size_t work_roll) {
    std::vector<std::size_t> rolls;
    for (const StackContact &contact : stack.contacts)
      if (contact.a == work_roll)
        rolls.push_back(contact.b);
    return rolls.empty() ? std::vector<std::size_t>{work_roll} : rolls;
  };
  m.points = {
      {"upper bearings", row_of(held_rolls(true))},         {"upper backup roll", row_of(carriers(stack.upper))},
      {"upper work roll", row_of({stack.upper})},           {"lower work roll", row_of({stack.lower})},
      {"lower backup roll", row_of(carriers(stack.lower))}, {"lower bearings", row_of(held_rolls(false))}};
  m.b[unknown(stack.upper, 1)] = 1;
  m.b[unknown(stack.lower, 1)] = -1;
  return lumped;
}

StandModel with_strip(const MovingStack &stack)
{
  StandModel rolling = stack.model;
  if (stack.strip.stiffness.size() > 0)
    rolling.connections.push_back(stack.strip);
  return rolling;
}
}  // namespace mill::reduce
