#include "fem/roll/contact_details.h"
#include "core/numerics/difference.h"
#include "core/numerics/mesh_pair.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::fem {
namespace {
struct Touch {
  double length = 0, edge = 0;  // m; the second of the outermost stations that carry load
  bool middle = false;
};

Touch touch_of(const ContactPair &pair, const double load)
{
  const Eigen::VectorXd q = barrel_profile(pair, solve_load(pair, load)).line_load;
  const int sides         = pair.grid.whole ? 1 : 2;
  const auto open         = [&](const Eigen::Index k) { return k >= 0 && k < q.size() && !(q[k] > 0); };
  Touch touch;
  for (Eigen::Index k = 0; k < q.size(); ++k)
    if (q[k] > 0) {
      touch.length += sides * pair.path[k];
      touch.edge += open(k - 1) || open(k + 1) ? sides * pair.path[k] : 0;
    }
  touch.middle = q[middle_station(pair.grid)] > 0;
  return touch;
}
}  // namespace

LengthAtLoad contact_length(const ContactPairs &pairs, const double load)
{
  const auto [length, edge, middle] = touch_of(pairs.in_stand, load);
  const double coarse               = touch_of(pairs.in_stand_coarse, load).length;
  return {{length, std::max(mesh_pair_error(length, coarse), edge / length), coarse, not_given}, middle};
}

std::optional<PlateauAtLoad> plateau_at(const ContactPairs &pairs, const double load, const double trim)
{
  const auto point  = solve_load(pairs.mirrored, load);
  const auto path   = path_plateau(pairs.mirrored, point, trim);
  const auto second = path_plateau(pairs.coarse, solve_load(pairs.coarse, load), trim);
  if (path.stations == 0)
    return std::nullopt;
  const double scaled = second.mean * path.tributary_length / second.tributary_length;
  return PlateauAtLoad{path, difference(scaled, path.mean), scaled,
                       load / point.approach * path.tributary_length / pairs.closed_form.length};
}

JointAtLoad joint_at(const ContactPairs &pairs, const double load, const double largest)
{
  const auto fitted_joint = [&](const ContactPair &pair) {
    return remembered(pair, fmt::format("joint {:a} {:a}", load, largest),
                      [&] { return fitted_joint_stiffness(pair, load, largest); });
  };
  JointAtLoad out;
  out.value                   = fitted_joint(pairs.whole);
  out.coarse                  = fitted_joint(pairs.whole_coarse);
  const Eigen::MatrixXd exact = remembered(pairs.whole, fmt::format("joint at {:a}", load), [&] {
    return joint_stiffness(pairs.whole, solve_load(pairs.whole, load));
  });
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) {
      const double value     = out.value(row, column);
      out.error(row, column) = value == 0 ? 0
                                          : std::max(mesh_pair_error(value, out.coarse(row, column)),
                                                     difference(exact(row, column), value));
    }
  const double L = pairs.closed_form.length, axes = pairs.whole.radii_sum;
  out.tangent  = reduce::line_contact(pairs.closed_form, load).tangent;
  out.spread   = out.tangent * L * L / 12;
  out.sideways = -load / axes;
  out.crossing = -load * L * L / 12 / axes;
  return out;
}

FrictionAtLoad friction_at(const ContactPairs &pairs, const double friction, const double load, const int steps,
                           const Compared &tangent,
                           const std::function<FrictionEffect(PairMesh mesh, int steps)> &solve)
{
  const auto effect = [&](const ContactPair &pair, const PairMesh mesh, const int n_steps) {
    const Eigen::MatrixXd both =
        remembered(pair, fmt::format("friction {:a} {:a} {}", friction, load, n_steps), [&] {
          const auto made = solve(mesh, n_steps);
          return Eigen::MatrixXd(Eigen::RowVector2d(made.ratio, made.slipping));
        });
    return FrictionEffect{both(0, 0), both(0, 1)};
  };
  FrictionAtLoad out;
  out.fine    = effect(pairs.mirrored, PairMesh::fine, steps);
  out.coarse  = effect(pairs.coarse, PairMesh::coarse, steps);
  out.twice   = effect(pairs.coarse, PairMesh::coarse, 2 * steps);
  out.tangent = tangent.value * out.fine.ratio;
  out.error   = tangent.error + mesh_pair_error(out.fine.ratio, out.coarse.ratio) +
              difference(out.twice.ratio, out.coarse.ratio);
  return out;
}

std::optional<OneSidedness> one_sidedness(const ContactPairs &pairs, const double load)
{
  if (pairs.extent != Extent::whole)
    return std::nullopt;
  const auto fine = solve_load(pairs.in_stand, load), coarse = solve_load(pairs.in_stand_coarse, load),
             mirrored    = solve_load(pairs.mirrored, load);
  const double L         = pairs.closed_form.length;
  const auto compared_by = [&](const double value, const double on_coarse, const double scale) {
    const double error = mesh_pair_safety * std::abs(on_coarse - value) / std::max(std::abs(value), 1e-6 * scale);
    return Compared{value, error, on_coarse, not_given};
  };
  return OneSidedness{compared_by(fine.tilt, coarse.tilt, fine.approach / L),
                      compared_by(fine.moment / load, coarse.moment / load, L), mirrored.tilt,
                      mirrored.moment / load};
}

PeakAtLoad largest_pressure(const ContactPairs &pairs, const double load)
{
  const auto largest = [&](const ContactPair &pair) {
    return pressure_map(pair, solve_load(pair, load)).maxCoeff();
  };
  const double peak = largest(pairs.in_stand), coarse = largest(pairs.in_stand_coarse);
  return {{peak, mesh_pair_error(peak, coarse), coarse, not_given}, largest(pairs.mirrored)};
}
}  // namespace mill::fem
