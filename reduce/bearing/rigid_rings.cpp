#include "reduce/bearing/rigid_rings.h"
#include "reduce/bearing/clearance.h"
#include "reduce/bearing/geometry.h"
#include "reduce/bearing/roller_law.h"
#include "reduce/bearing/roller_set.h"
#include <cmath>
#include <sstream>

namespace mill::bearing {
namespace {
/// What stays the same while the ring moves.
struct RigidRings {
  RollerLaw law;
  double cosine;          ///< of the cup contact angle
  double half_clearance;  ///< m, radial; negative with interference or preload
  double tilt;            ///< rad
  Eigen::VectorXd
      lever;  ///< (rows) m, radial travel of a row's raceways, seen along their normal, for a unit tilt
  Eigen::VectorXd azimuth;  ///< (rollers) rad
  bool rows_equal;          ///< no tilt: one row is computed and stands for all
};

// z - R s tan(alpha): the row's distance, and the axial motion of its rim.
Eigen::VectorXd levers(const RollerBearing &b)
{
  const double rim      = pitch_diameter(b) / 2 * std::tan(b.cup_angle);
  Eigen::VectorXd lever = row_positions(b);
  for (Eigen::Index r = 0; r < lever.size(); ++r)
    lever[r] -= rim * (b.arrangement.at(std::size_t(r) % b.arrangement.size()) == '+' ? 1 : -1);
  return lever;
}

RigidRings rigid_rings(const RollerBearing &b, const double tilt)
{
  require_closed_apex(b);
  const RollerLaw law = roller_law(b);
  const double cosine = std::cos(b.cup_angle);
  RigidRings rings{law, cosine, -approach_offset(b, law) / cosine, tilt, levers(b), roller_azimuths(b), tilt == 0};
  if (!rings.rows_equal && !rings.lever.allFinite())
    throw InputError(
        "bearing." + b.name +
        ": a tilted ring needs the width and the pitch diameter of the bearing, from which the places "
        "of the rollers follow");
  return rings;
}

/// Approach of a roller's middle, normal to the raceway, (5.11).
double approach(const RigidRings &rings, const double displacement, const Eigen::Index row, const double azimuth)
{
  const double lever = rings.rows_equal ? 0 : rings.lever[row];
  return rings.cosine * ((displacement + lever * rings.tilt) * std::cos(azimuth) - rings.half_clearance);
}

/// Tilt of a roller in its axial plane, (5.12).
double roller_tilt(const RigidRings &rings, const double azimuth)
{
  return std::atan(std::tan(rings.tilt) * std::cos(azimuth));
}

struct RadialForce {
  double force     = 0;  ///< N
  double stiffness = 0;  ///< N/m
};

/// Radial force of one row and its slope, (5.13) and (5.14).
RadialForce row_force(const RigidRings &rings, const double displacement, const Eigen::Index row)
{
  RadialForce sum;
  for (const double phi : rings.azimuth) {
    const RollerLoad roller =
        roller_load(rings.law, approach(rings, displacement, row, phi), roller_tilt(rings, phi));
    const double direction = rings.cosine * std::cos(phi);
    sum.force += roller.load * direction;
    sum.stiffness += roller.stiffness * direction * direction;
  }
  return sum;
}

RadialForce bearing_force(const RigidRings &rings, const double displacement)
{
  const auto rows = rings.lever.size();
  RadialForce sum;
  if (rings.rows_equal) {
    const RadialForce one = row_force(rings, displacement, 0);
    return {double(rows) * one.force, double(rows) * one.stiffness};
  }
  for (Eigen::Index r = 0; r < rows; ++r) {
    const RadialForce one = row_force(rings, displacement, r);
    sum.force += one.force;
    sum.stiffness += one.stiffness;
  }
  return sum;
}

/// A displacement at which the bearing carries more than `load`: clearance and profile taken up, then doubled.
double beyond(const RigidRings &rings, const double load)
{
  double displacement = std::abs(rings.half_clearance) + roller_approach(rings.law, load) / rings.cosine;
  for (int i = 0; i < 100; ++i, displacement *= 2)
    if (bearing_force(rings, displacement).force > load)
      return displacement;
  throw SolverError({"bearing: no displacement carries the load", "stopped after 100 doublings",
                     "a dimension, angle or clearance of the bearing is not a number",
                     "check the [bearing] section", ""});
}

/// Newton's method inside a bracket that only shrinks; where Newton leaves it, the bracket is halved.
double equilibrium(const RigidRings &rings, const double load)
{
  double low = rings.rows_equal
                   ? 0
                   : -(rings.lever * rings.tilt).maxCoeff(),  // where no row is pressed along the load
      high   = beyond(rings, load);
  double x   = high;
  for (int i = 0; i < 200; ++i) {
    const RadialForce roller_state           = bearing_force(rings, x);
    (roller_state.force > load ? high : low) = x;
    double next                              = x - (roller_state.force - load) / roller_state.stiffness;
    if (!(next > low && next < high))
      next = (low + high) / 2;
    if (std::abs(next - x) <= 4e-16 * high || next == low || next == high)
      return next;
    x = next;
  }
  std::ostringstream stood;
  stood << "displacement between " << low * 1e6 << " and " << high * 1e6 << " um after 200 steps";
  throw SolverError({"bearing: no equilibrium found", stood.str(), "an input of the bearing is not a number",
                     "check the [bearing] section", ""});
}

/// Loads of all rollers at a displacement, and the state they make.
BearingState state_at(const RigidRings &rings, const double load, const double displacement)
{
  const auto rows = rings.lever.size(), rollers = rings.azimuth.size();
  BearingState state;
  state.load         = load;
  state.tilt         = rings.tilt;
  state.displacement = displacement;
  state.secant       = load / displacement;
  state.tangent      = bearing_force(rings, displacement).stiffness;
  state.azimuth      = rings.azimuth;
  state.roller_load.resize(rows, rollers);
  state.row_share.resize(rows);
  for (Eigen::Index r = 0; r < rows; ++r) {
    state.row_share[r] = row_force(rings, displacement, r).force / load;
    for (Eigen::Index j = 0; j < rollers; ++j)
      state.roller_load(r, j) = roller_load(rings.law, approach(rings, displacement, r, rings.azimuth[j]),
                                            roller_tilt(rings, rings.azimuth[j]))
                                    .load;
  }
  Eigen::Index r, j;
  state.roller_max = state.roller_load.maxCoeff(&r, &j);
  state.loaded_rollers =
      state.roller_load.unaryExpr([&](const double Q) { return int(carries(Q, state.roller_max)); })
          .rowwise()
          .sum();
  state.roller_approach = approach(rings, displacement, r, rings.azimuth[j]);
  state.roller_secant   = state.roller_max / state.roller_approach;
  state.roller_tangent =
      roller_load(rings.law, state.roller_approach, roller_tilt(rings, rings.azimuth[j])).stiffness;
  return state;
}

void require_load(const RollerBearing &b, const double load)
{
  if (load > 0 && std::isfinite(load))
    return;
  std::ostringstream text;
  text << "bearing." << b.name << ": radial load " << load / 1e3 << " kN; ";
  if (diametral_clearance(b) > 0 && preloaded_roller(b) == 0)
    text << "with a clearance of " << diametral_clearance(b) * 1e6
         << " um no roller is loaded without load, so a stiffness does not exist";
  else
    text << "the stiffness of rollers grows with load from zero, so a positive load is needed";
  throw InputError(text.str());
}
}  // namespace

BearingState solve_bearing(const RollerBearing &bearing, const double radial_load, const double tilt)
{
  require_load(bearing, radial_load);
  const RigidRings rings = rigid_rings(bearing, tilt);
  return state_at(rings, radial_load, equilibrium(rings, radial_load));
}
}  // namespace mill::bearing
