#include "fem/stack/stacked_roll.h"
#include "reduce/stack/strip_flattening.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace mill::fem {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

StackedRoll::StackedRoll(const StackRoll &of, std::shared_ptr<const RollKernel> its_kernel, const int n_planes)
    : roll(of), kernel(std::move(its_kernel)), planes(n_planes)
{
  for (int p = 0; p < planes; ++p) {
    Plane plane;
    for (std::size_t s = 0; s < roll.supports.size(); ++s)
      if (roll.supports[s].stiffness[axis_of(p)] > 0)
        plane.support.push_back(s);
    held = held && plane.support.size() > 1;
    in_plane.push_back(std::move(plane));
  }
}

std::size_t StackedRoll::add_line(const std::array<double, 2> &outward, const ContactStations &stations,
                                  const LinePatch &patch)
{
  Line line{outward, stations, spread_on_roll(stations, kernel->edge, roll.shift), {}, lines.size(), patch, true};
  line.motion.resize(stations.size(), motions());
  for (int p = 0; p < planes && !held; ++p) {
    line.motion.col(2 * p).setConstant(outward[axis_of(p)]);
    line.motion.col(2 * p + 1) = outward[axis_of(p)] * stations.centre();
  }
  lines.push_back(std::move(line));
  return lines.size() - 1;
}

std::size_t StackedRoll::watch_line(const std::size_t next_to, const ContactStations &stations)
{
  const std::size_t added = add_line(lines[next_to].outward, stations, lines[next_to].patch);
  lines[added].next_to    = next_to;
  lines[added].bears      = false;
  return added;
}

void StackedRoll::forget_lines()
{
  lines.clear();
  pairs.clear();
}

MatrixXd StackedRoll::lever_columns() const
{
  const Index M = stations(), P = kernel->point.size();
  MatrixXd B(M + P, 2);
  B.col(0).setOnes();
  B.col(1).head(M) = (kernel->edge.head(M) + kernel->edge.tail(M)) / 2;
  B.col(1).tail(P) = kernel->point;
  B.col(1).array() += roll.shift;
  return B;
}

// (51.15): springs and rigid motions eliminated.
void StackedRoll::hold(Plane &plane, const std::size_t axis) const
{
  const Index M = stations(), n = Index(plane.support.size());
  const MatrixXd &F  = kernel->bending;
  const double scale = F.diagonal().mean();
  const MatrixXd B   = lever_columns();
  MatrixXd K         = MatrixXd::Zero(n + 2, n + 2);
  plane.G.resize(F.rows(), n + 2);
  std::vector<Index> row;
  for (const std::size_t s : plane.support)
    row.push_back(M + kernel->place_of(roll.supports[s].z));
  for (Index i = 0; i < n; ++i) {
    const StackSupport &support = roll.supports[plane.support[std::size_t(i)]];
    plane.G.col(i)              = F.col(row[std::size_t(i)]) / scale;
    for (Index j = 0; j < n; ++j)
      K(i, j) = F(row[std::size_t(i)], row[std::size_t(j)]) / scale;
    K(i, i) += 1 / (support.stiffness[axis] * scale);
    K.block(i, n, 1, 2) = B.row(row[std::size_t(i)]);
    K.block(n, i, 2, 1) = B.row(row[std::size_t(i)]).transpose();
  }
  plane.G.rightCols(2) = B;
  plane.factor.compute(K);
  plane.by_force    = -plane.factor.solve(plane.G.transpose());
  plane.flexibility = F + scale * plane.G * plane.by_force;
}

void StackedRoll::move_feet(Plane &plane, const std::size_t axis) const
{
  const double scale = kernel->bending.diagonal().mean();
  VectorXd foot      = VectorXd::Zero(plane.G.cols());
  for (std::size_t i = 0; i < plane.support.size(); ++i)
    foot[Index(i)] = roll.supports[plane.support[i]].motion[axis] / scale;
  plane.by_supports = plane.factor.solve(foot);
  plane.moved       = scale * plane.G * plane.by_supports;
}

// A beam at the strip flattens as a half space, (51.7).
MatrixXd StackedRoll::half_space(const Line &line, const Line &loaded) const
{
  const Index n = loaded.stations.size();
  reduce::FlattenedRoll flat;
  flat.edges.resize(n + 1);
  flat.edges << loaded.stations.from, loaded.stations.to[n - 1];
  flat.radius   = roll.diameter / 2;
  flat.arc      = 2 * loaded.patch.half_width;
  flat.material = roll.material;
  MatrixXd C(line.stations.size(), n);
  for (Index i = 0; i < C.rows(); ++i)
    C.row(i) = reduce::flattening_between(flat, line.stations.from[i], line.stations.to[i])
                   .cwiseQuotient(loaded.stations.length())
                   .transpose();
  return C;
}

void StackedRoll::finish()
{
  for (int p = 0; p < planes; ++p)
    if (held)
      hold(in_plane[std::size_t(p)], axis_of(p));
    else
      in_plane[std::size_t(p)].flexibility = kernel->bending;
  const Index M = stations();
  pairs.resize(lines.size() * lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = 0; j < lines.size(); ++j) {
      if (!lines[j].bears)
        continue;
      MatrixXd &pair = pairs[i * lines.size() + j];
      if (j < i && lines[i].bears) {
        pair = flexibility(j, i).transpose();
        continue;
      }
      const auto &a = lines[i].outward, &b = lines[j].outward;
      const double along = a[0] * b[0] + a[1] * b[1];
      MatrixXd whole     = lines[i].next_to == j
                               ? kernel->under_itself(lines[j].patch.half_width, lines[j].patch.pressure)
                               : kernel->around(std::acos(std::clamp(along, -1., 1.)));
      if (held)
        for (int p = 0; p < planes; ++p)
          whole += a[axis_of(p)] * b[axis_of(p)] * in_plane[std::size_t(p)].flexibility.topLeftCorner(M, M);
      else
        whole += (planes == 2 ? along : a[1] * b[1]) * kernel->bending.topLeftCorner(M, M);
      pair = lines[i].spread.transpose() * (whole * lines[j].spread);
      if (!has_surface() && lines[i].next_to == j && lines[j].patch.pressure == PatchPressure::uniform)
        pair += half_space(lines[i], lines[j]);
    }
  take_loads();
}

void StackedRoll::take_loads()
{
  by_loads = answer_to(roll.loads);
  if (!held)
    return;
  for (int p = 0; p < planes; ++p)
    move_feet(in_plane[std::size_t(p)], axis_of(p));
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (int p = 0; p < planes; ++p)
      by_loads.offset[i] -= lines[i].outward[axis_of(p)] *
                            (lines[i].spread.transpose() * in_plane[std::size_t(p)].moved.head(stations()));
}

RollAnswer StackedRoll::answer_to(const std::vector<StackLoad> &loads) const
{
  RollAnswer answer;
  answer.resultant = VectorXd::Zero(motions());
  for (const Line &line : lines)
    answer.offset.push_back(VectorXd::Zero(line.spread.cols()));
  for (const StackLoad &load : loads) {
    const Index point = stations() + kernel->place_of(load.z);
    for (int p = 0; p < planes; ++p) {
      const double force = load.force[axis_of(p)];
      if (!held)
        answer.resultant.segment<2>(2 * p) += force * Eigen::Vector2d(1, load.z + roll.shift);
      for (std::size_t i = 0; i < lines.size(); ++i)
        answer.offset[i] -=
            lines[i].outward[axis_of(p)] * force *
            (lines[i].spread.transpose() * in_plane[std::size_t(p)].flexibility.col(point).head(stations()));
    }
  }
  return answer;
}

StackedRoll::Deflection StackedRoll::deflection(const std::vector<VectorXd> &force, const VectorXd &motion) const
{
  const Index M    = stations();
  const MatrixXd B = lever_columns();
  Deflection out;
  out.z = B.col(1).head(M);
  out.x = out.y = VectorXd::Zero(M);
  out.reactions.assign(roll.supports.size(), 0);
  out.across.assign(roll.supports.size(), 0);
  for (int p = 0; p < planes; ++p) {
    const Plane &plane = in_plane[std::size_t(p)];
    VectorXd all       = VectorXd::Zero(kernel->bending.rows());
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i].bears)
        all.head(M) -= lines[i].outward[axis_of(p)] * (lines[i].spread * force[i]);
    for (const StackLoad &load : roll.loads)
      all[M + kernel->place_of(load.z)] += load.force[axis_of(p)];
    Eigen::Vector2d rigid;
    if (held) {
      const VectorXd added = plane.by_force * all + plane.by_supports;
      const Index n        = Index(plane.support.size());
      for (Index i = 0; i < n; ++i) {
        const std::size_t s = plane.support[std::size_t(i)];
        all[M + kernel->place_of(roll.supports[s].z)] += added[i];
        (axis_of(p) == 1 ? out.reactions : out.across)[s] = added[i];
      }
      rigid = kernel->bending.diagonal().mean() * added.tail<2>();
    } else
      rigid = motion.segment<2>(2 * p);
    (axis_of(p) == 1 ? out.y : out.x) = kernel->axis * all + B.topRows(M) * rigid;
  }
  return out;
}
}  // namespace mill::fem
