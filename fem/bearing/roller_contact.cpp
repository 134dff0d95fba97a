#include "fem/bearing/roller_contact.h"
#include "core/base/errors.h"
#include "fem/contact/active_set.h"
#include <Eigen/Dense>
#include <cmath>
#include <string>

namespace mill::fem {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Motions: of the inner back towards the outer one (approach, tilt), and of the roller itself.
enum Motion { approach, tilt, shift, own_tilt };
constexpr double never_touches = 1e-3;  // m

// Depth of a circle below its top, without cancellation.
double sagitta(const double radius, const double x)
{
  return radius == 0 ? 0 : x * x / (radius + std::copysign(std::sqrt(radius * radius - x * x), radius));
}

VectorXd drop_at(const VectorXd &z, const std::function<double(double)> &drop)
{
  VectorXd out = VectorXd::Zero(z.size());
  for (Index k = 0; drop && k < z.size(); ++k) {
    const double d = drop(z[k]);
    out[k]         = std::isfinite(d) ? std::min(d, never_touches) : never_touches;
  }
  return out;
}

contact::Problem make_problem(const CondensedRoller &roller, const PatchGrid &grid,
                              const std::function<double(double)> &drop)
{
  const RollerSetup &s  = roller.setup;
  const VectorXd ground = drop_at(grid.z, drop);
  const Index n         = grid.area.size();
  contact::Problem p;
  p.C = pair_flexibility(roller);
  p.G = MatrixXd::Zero(2 * n, 4);
  p.initial_gap.resize(2 * n);
  for (int k = 0; k < grid.n_z; ++k)
    for (int i = 0; i < grid.n_x; ++i) {
      const Index inner = k * grid.n_x + i, outer = n + inner;
      const double x = grid.x[i], z = grid.z[k], gap = sagitta(0.5 * s.diameter, x) + ground[k];
      p.initial_gap[inner] = gap + sagitta(s.inner_radius, x);
      p.initial_gap[outer] = gap - sagitta(s.outer_radius, x);
      p.G.row(inner) << 1, z, -1, -z;
      p.G.row(outer) << 0, 0, 1, z;
    }
  return p;
}
}  // namespace

struct RollerContact::Implementation {
  Implementation(const CondensedRoller &roller, const std::function<double(double)> &drop)
      : setup(roller.setup), grid(roller.grid), solver(make_problem(roller, grid, drop))
  {
    const double half_length = grid.z[grid.n_z - 1];
    station_length           = axial_weights(grid.z, -half_length, half_length, grid.degree);
  }

  RollerSide side(const VectorXd &nodal, const double raceway_radius) const
  {
    RollerSide out;
    const int n_x = grid.n_x;
    out.pressure.resize(grid.n_z, 2 * n_x - 1);
    out.line_load.resize(grid.n_z);
    for (int k = 0; k < grid.n_z; ++k) {
      for (int i = 0; i < n_x; ++i)
        out.pressure(k, n_x - 1 + i) = out.pressure(k, n_x - 1 - i) = nodal[k * n_x + i] / grid.area[k * n_x + i];
      out.line_load[k] = 2 * nodal.segment(k * n_x, n_x).sum() / station_length[k];
    }
    const double q     = out.line_load.maxCoeff();
    out.half_width     = line_half_width(setup, raceway_radius, q);
    out.peak_pressure  = q > 0 ? 2 * q / (M_PI * out.half_width) : 0;
    out.nodal_pressure = out.pressure.maxCoeff();
    return out;
  }

  // The outermost nodes must stay open: the raceway goes on beyond them.
  void require_inside(const contact::State &state) const
  {
    const Index n = grid.area.size();
    for (int contact = 0; contact < 2; ++contact)
      for (int k = 0; k < grid.n_z; ++k)
        if (state.nodal[contact * n + k * grid.n_x + grid.n_x - 1] > 0)
          throw SolverError({"roller: the contact reaches the edge of its mesh",
                             "load " + std::to_string(2 * state.resultant[approach]) + " N, meshed for " +
                                 std::to_string(setup.largest_load) + " N",
                             "more load on the roller, or on one of its ends, than the mesh was made for",
                             "give a larger load for the mesh", ""});
  }

  // A roller with play everywhere rests somewhere; half way is as good as any place.
  RollerContactState apart(const double by, const double turn) const
  {
    RollerContactState out;
    out.approach     = by;
    out.tilt         = turn;
    out.roller_shift = 0.5 * by;
    out.roller_tilt  = 0.5 * turn;
    out.inner = out.outer = side(VectorXd::Zero(grid.area.size()), 0);
    return out;
  }

  RollerContactState at(const double by, const double turn)
  {
    // Both gaps of a station are least at its middle, and a roller half way between the backs shares them.
    for (int k = 0; k < grid.n_z; ++k)
      if (by + turn * grid.z[k] > 2 * solver.problem().initial_gap[k * grid.n_x])
        return solve(loading(by, turn, true));
    return apart(by, turn);
  }

  static contact::Loading loading(const double first, const double turn, const bool by_approach)
  {
    return {Eigen::Vector4d(first, turn, 0, 0), std::vector<char>{char(by_approach), 1, 0, 0}};
  }

  RollerContactState solve(const contact::Loading &imposed)
  {
    const contact::State state = solver.solve(imposed);
    require_inside(state);
    RollerContactState out;
    out.approach     = state.motion[approach];
    out.tilt         = state.motion[tilt];
    out.load         = 2 * state.resultant[approach];  // the other half, x < 0, carries as much
    out.moment       = 2 * state.resultant[tilt];
    out.roller_shift = state.motion[shift];
    out.roller_tilt  = state.motion[own_tilt];
    // The roller follows freely: of the compliance only the imposed motions count.
    if (state.compliance.topLeftCorner<2, 2>().allFinite())
      out.tangent = 2 * state.compliance.topLeftCorner<2, 2>().inverse();
    const Index n  = grid.area.size();
    out.inner      = side(state.nodal.head(n), setup.inner_radius);
    out.outer      = side(state.nodal.tail(n), -setup.outer_radius);
    out.iterations = state.iterations;
    out.residual   = state.residual;
    return out;
  }

  RollerSetup setup;
  PatchGrid grid;
  VectorXd station_length;  // (n_z) m
  contact::ActiveSet solver;
};

RollerContact::RollerContact(const CondensedRoller &roller, const std::function<double(double)> &drop)
    : self(std::make_unique<Implementation>(roller, drop))
{
}
RollerContact::~RollerContact()                         = default;
RollerContact::RollerContact(RollerContact &&) noexcept = default;

RollerContactState RollerContact::solve(const double approach, const double tilt)
{
  return self->at(approach, tilt);
}
RollerContactState RollerContact::solve_load(const double load, const double tilt)
{
  if (!(load > 0))
    throw InputError("roller: the load must be positive");
  return self->solve(Implementation::loading(0.5 * load, tilt, false));
}
const contact::Problem &RollerContact::problem() const
{
  return self->solver.problem();
}
}  // namespace mill::fem
